#include "core/generate/dart_sampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "core/parallel.h"

namespace wellspaced {
namespace {

constexpr double darts_a_cell = 0.5;  // a cell that is missed is halved, which finds its gap faster
constexpr std::size_t batch = 64;
constexpr std::size_t darts_between_checks = 1 << 14;
constexpr int most_draws = 16;
constexpr std::int64_t largest_single_tile = 1 << 16;  // cells; its samples fill a second-level cache

/// Tiles are for samples that cover no more than they conflict with: others may end up in another tile.
bool in_one_tile(const SampleGrid& grid, const DiskRadii& radii) {
  return radii.conflict < radii.coverage || grid.x.cells * grid.y.cells <= largest_single_tile;
}

constexpr int rounds_in_tiles = 8;  // then fewer than two of a hundred cells are left

int passes_of(int round) { return round == 0 ? 4 : round < 3 ? 2 : 1; }

}  // namespace

DartSampler::DartSampler(const Torus& torus, const DiskRadii& radii, Rng& rng, Control& control)
    : grid_(torus, radii, control),
      radii_(radii),
      tiles_x_(grid_.x.cells, in_one_tile(grid_, radii)),
      tiles_y_(grid_.y.cells, in_one_tile(grid_, radii)),
      rng_(rng),
      control_(control),
      blocks_(static_cast<std::size_t>(tiles_x_.blocks() * tiles_y_.blocks())),
      level_{0, 0, {grid_.x.side, grid_.y.side}} {}

void DartSampler::run() {
  fill();
  int round = 0;
  for (; round < rounds_in_tiles && active() > 0; ++round) {
    if (round > 0) go_down();
    throw_in_passes(round);
    report(round);
  }
  take_together();
  finish(round);
}

PointSet DartSampler::samples(const std::shared_ptr<const Torus>& torus) const {
  const auto rows = static_cast<std::size_t>(grid_.y.cells);
  std::vector<std::size_t> first(rows + 1, 0);  // sample of each row, and the end
  const auto for_each_row = [&](const auto& work) {
    parallel_blocks(rows, 1, control_, [&](std::size_t row, std::size_t) {
      for (std::int64_t i = 0; i < grid_.x.cells; ++i)
        if (grid_.taken(i, static_cast<std::int64_t>(row))) work(row, i);
    });
  };
  for_each_row([&](std::size_t row, std::int64_t) { ++first[row + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  PointSet points = points_to_set(torus, first.back(), control_);
  for_each_row([&](std::size_t row, std::int64_t i) {
    const Vec2 p = grid_.sample(i, static_cast<std::int64_t>(row));
    const std::size_t at = 2 * first[row]++;
    points.coordinates[at] = p.x;
    points.coordinates[at + 1] = p.y;
  });
  return points;
}

/// All base cells are active.
void DartSampler::fill() {
  const auto columns = static_cast<std::size_t>(tiles_x_.blocks());
  parallel_blocks(blocks_.size(), 1, control_, [&](std::size_t b, std::size_t) {
    const auto bx = static_cast<std::int64_t>(b % columns), by = static_cast<std::int64_t>(b / columns);
    for (std::int64_t j = tiles_y_.first_cell(by); j < tiles_y_.first_cell(by + 1); ++j)
      for (std::int64_t i = tiles_x_.first_cell(bx); i < tiles_x_.first_cell(bx + 1); ++i)
        blocks_[b].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
  });
}

/// To the next level. Long cells, which only thin tori have, are halved across; quarters of them would stay
/// as long, and follow the rim of a disk in very many pieces.
void DartSampler::go_down() {
  above_ = level_;
  const Vec2 size = level_.side;
  if (size.x * 2 > size.y) level_.x += 1;
  if (size.y * 2 > size.x) level_.y += 1;
  level_.side = {grid_.x.side / static_cast<double>(std::int64_t{1} << level_.x),
                 grid_.y.side / static_cast<double>(std::int64_t{1} << level_.y)};
}

void DartSampler::report(int round) { control_.report({1 - 1.0 / (2 + round)}); }

void DartSampler::throw_in_passes(int round) {
  const int passes = blocks_.size() > 1 ? passes_of(round) : 1;
  for (int k = 0; k < passes; ++k) {
    Pass pass{darts_a_cell / passes, round > 0 && k == 0, 0, 0, 0};
    pass.offset_x = static_cast<std::int64_t>(rng_.below(static_cast<std::uint64_t>(tiles_x_.blocks())));
    pass.offset_y = static_cast<std::int64_t>(rng_.below(static_cast<std::uint64_t>(tiles_y_.blocks())));
    pass.seed = rng_.next();
    run_pass(pass);
  }
}

/// Tiles of one color don't touch each other.
void DartSampler::run_pass(const Pass& pass) {
  constexpr std::size_t worth_a_thread = 1 << 16;
  const bool together = active() > worth_a_thread;
  for (int color = 0; color < 4; ++color) {
    std::vector<std::pair<std::int64_t, std::int64_t>> tiles;
    for (std::int64_t ty = color / 2; ty < tiles_y_.tiles(); ty += 2)
      for (std::int64_t tx = color % 2; tx < tiles_x_.tiles(); tx += 2) tiles.push_back({tx, ty});
    if (tiles.empty()) continue;
    parallel_blocks(tiles.size(), together ? 1 : tiles.size(), control_,
                    [&](std::size_t begin, std::size_t end) {
                      for (std::size_t t = begin; t < end; ++t)
                        work_on_tile(tiles[t].first, tiles[t].second, pass);
                    });
  }
}

void DartSampler::work_on_tile(std::int64_t tile_x, std::int64_t tile_y, const Pass& pass) {
  const Lists<ActiveCell> blocks = blocks_of(tile_x, tile_y, pass);
  if (pass.halves) {
    std::vector<ActiveCell> scratch;
    for (auto* cells : blocks) halve_all(*cells, grid_.coverage2(), scratch);
  }
  Rng rng(pass.seed, static_cast<std::uint64_t>(tile_y * tiles_x_.tiles() + tile_x));
  throw_into(blocks, pass.darts_a_cell, rng);
}

DartSampler::Lists<ActiveCell> DartSampler::blocks_of(std::int64_t tile_x, std::int64_t tile_y,
                                                      const Pass& pass) {
  Lists<ActiveCell> blocks;
  const std::int64_t columns = tiles_x_.blocks(), rows = tiles_y_.blocks();
  for (auto y = tiles_y_.first_block(tile_y, pass.offset_y);
       y < tiles_y_.first_block(tile_y + 1, pass.offset_y); ++y)
    for (auto x = tiles_x_.first_block(tile_x, pass.offset_x);
         x < tiles_x_.first_block(tile_x + 1, pass.offset_x); ++x)
      blocks.push_back(&blocks_[static_cast<std::size_t>(y % rows * columns + x % columns)]);
  return blocks;
}

void DartSampler::take_together() {
  for (auto& cells : blocks_) {
    for (const ActiveCell c : cells) deep_.push_back({c.i, c.j});
    std::vector<ActiveCell>().swap(cells);
  }
}

/// Cells at a corner where three disks all but meet stay active until they are as small as what is missing.
/// Gaps too small to matter are let go.
void DartSampler::finish(int round) {
  constexpr double negligible = 4e-10;
  const double coverage2 = grid_.coverage2() * (1 + 2 * negligible);
  std::vector<DeepCell> scratch;
  for (; !deep_.empty(); ++round) {
    const bool last = std::max(level_.side.x, level_.side.y) < negligible / 2 * radii_.coverage;
    last ? fill_centers() : throw_into<DeepCell>({&deep_}, darts_a_cell, rng_);
    go_down();
    halve_all(deep_, coverage2, scratch);
    report(round);
  }
}

/// A cell this small is covered if its center is: at once, by a sample there.
void DartSampler::fill_centers() {
  for (const DeepCell c : deep_) {
    const Dart dart{
        static_cast<std::int64_t>(c.i >> level_.x),
        static_cast<std::int64_t>(c.j >> level_.y),
        {(static_cast<double>(c.i) + 0.5) * level_.side.x, (static_cast<double>(c.j) + 0.5) * level_.side.y}};
    throw_darts(grid_, {&dart, 1});
  }
}

template <class Cell>
void DartSampler::halve_all(std::vector<Cell>& cells, double coverage2, std::vector<Cell>& scratch) const {
  scratch.clear();
  for (std::size_t begin = 0; begin < cells.size(); begin += darts_between_checks) {
    control_.check();
    const std::size_t n = std::min(darts_between_checks, cells.size() - begin);
    halve(grid_, std::span<const Cell>(cells).subspan(begin, n), above_, level_, coverage2, scratch);
  }
  cells.assign(scratch.begin(), scratch.end());
}

/// Darts are drawn some time before they are thrown, so that memory can be fetched in between.
template <class Cell>
void DartSampler::throw_into(const Lists<Cell>& blocks, double rate, Rng& rng) {
  std::size_t total = 0, fullest = 0;
  for (const auto* cells : blocks) {
    total += cells->size();
    fullest = std::max(fullest, cells->size());
  }
  if (total == 0) return;
  const auto darts = static_cast<std::size_t>(rate * static_cast<double>(total) + rng.uniform());
  std::array<Dart, batch> drawn;
  for (std::size_t begin = 0; begin < darts; begin += batch) {
    if (begin % darts_between_checks == 0) control_.check();
    const std::size_t n = draw_batch(blocks, fullest, std::min(batch, darts - begin), rng, drawn.data());
    if (radii_.conflict < radii_.coverage)
      for (std::size_t k = 0; k < n; ++k) throw_around(drawn[k], rng);
    else
      throw_darts(grid_, std::span(drawn).first(n));
  }
}

/// Draws n darts and returns how many of them are inside: rounding may lift those of the last cells onto the
/// period.
template <class Cell>
std::size_t DartSampler::draw_batch(const Lists<Cell>& blocks, std::size_t fullest, std::size_t n, Rng& rng,
                                    Dart* darts) const {
  std::array<const Cell*, batch> cells;
  for (std::size_t k = 0; k < n;) {
    const auto [block, slot] = rng.below(blocks.size(), fullest);
    if (slot >= blocks[block]->size()) continue;
    cells[k] = &(*blocks[block])[slot];
    __builtin_prefetch(cells[k++]);
  }
  std::size_t inside = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Cell c = *cells[k];
    const auto [u, v] = rng.uniform_pair();
    const Vec2 p{(static_cast<double>(c.i) + u) * level_.side.x,
                 (static_cast<double>(c.j) + v) * level_.side.y};
    if (!(p.x < grid_.x.period && p.y < grid_.y.period)) continue;
    darts[inside] = {static_cast<std::int64_t>(c.i >> level_.x), static_cast<std::int64_t>(c.j >> level_.y),
                     p};
    grid_.prefetch(darts[inside].i, darts[inside].j);
    ++inside;
  }
  return inside;
}

/// A dart aims at a place that no sample covers; the sample is drawn around it.
void DartSampler::throw_around(const Dart& dart, Rng& rng) {
  if (grid_.taken(dart.i, dart.j) || any_within(grid_.window(dart.i, dart.j), dart.at, grid_.coverage2()))
    return;
  const Vec2 p = drawn_near(dart.at, rng);
  const auto [i, j] = grid_.cell_of(p);
  grid_.put(i, j, p);
}

/// A point that covers the uncovered place and conflicts with no sample; at worst the place itself.
Vec2 DartSampler::drawn_near(Vec2 place, Rng& rng) const {
  for (int draw = 0; draw < most_draws; ++draw) {
    const double u = 2 * rng.uniform() - 1, v = 2 * rng.uniform() - 1;
    if (u * u + v * v >= 1) continue;
    const Vec2 p{wrap(place.x + u * radii_.coverage, grid_.x.period),
                 wrap(place.y + v * radii_.coverage, grid_.y.period)};
    const auto [i, j] = grid_.cell_of(p);
    if (!grid_.taken(i, j) && !any_within(grid_.window_near(i, j), p, grid_.conflict2())) return p;
  }
  return place;
}

std::size_t DartSampler::active() const {
  std::size_t sum = 0;
  for (const auto& cells : blocks_) sum += cells.size();
  return sum;
}

}  // namespace wellspaced

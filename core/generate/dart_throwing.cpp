#include "core/generate/dart_throwing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/generate/disk_tests.h"
#include "core/generate/farthest_point.h"
#include "core/generate/row_order.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

constexpr double empty = std::numeric_limits<double>::quiet_NaN();

/// One axis of the background grid: `cells` base cells and `reach` ghost cells on either side, within which
/// everything lies that can cover a part of a cell, and within `near` what can conflict with a point of it.
struct GridAxis {
  double period, side;
  std::int64_t cells, near, reach, stride;

  GridAxis(double length, const DiskRadii& radii)
      : period(length),
        side(0),
        cells(background_cells(length, radii.conflict)),
        near(0),
        reach(0),
        stride(0) {
    side = period / static_cast<double>(cells);
    near = static_cast<std::int64_t>(std::ceil(radii.conflict / side * (1 + 1e-12)));
    reach = static_cast<std::int64_t>(std::ceil(radii.coverage / side * (1 + 1e-12)));
    stride = cells + 2 * reach;
  }
};

/// Base cells with at most one sample each. Ghost cells hold images shifted by whole periods, so a query
/// never wraps; an empty cell holds NaN, which fails every comparison, so a query never branches on it.
class SampleGrid {
 public:
  SampleGrid(const Torus& torus, const DiskRadii& radii)
      : x(torus.width(), radii),
        y(torus.height(), radii),
        table_x_(static_cast<std::size_t>(x.stride * y.stride) + CellWindow::readable_beyond, empty),
        table_y_(table_x_) {
    // Images are rounded copies: the radii are widened by what that can hide.
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(x.period, y.period);
    conflict2_ = (radii.conflict + rounding) * (radii.conflict + rounding);
    coverage2_ = (radii.coverage + rounding) * (radii.coverage + rounding);
  }

  const GridAxis x, y;

  bool taken(std::int64_t i, std::int64_t j) const { return !std::isnan(table_x_[index(i, j)]); }
  Vec2 sample(std::int64_t i, std::int64_t j) const { return {table_x_[index(i, j)], table_y_[index(i, j)]}; }

  void put(std::int64_t i, std::int64_t j, Vec2 p) {
    for (std::int64_t gj = j - y.cells * ((j + y.reach) / y.cells); gj < y.cells + y.reach; gj += y.cells)
      for (std::int64_t gi = i - x.cells * ((i + x.reach) / x.cells); gi < x.cells + x.reach; gi += x.cells)
        put_image(index(gi, gj), {p.x + static_cast<double>((gi - i) / x.cells) * x.period,
                                  p.y + static_cast<double>((gj - j) / y.cells) * y.period});
  }

  /// Whether a point of base cell (i, j) is nearer than the conflict radius to a sample.
  bool conflicts(std::int64_t i, std::int64_t j, Vec2 p) const {
    return any_within(window(i, j, x.near, y.near), p, conflict2_);
  }
  /// Whether a sample covers it.
  bool covered(std::int64_t i, std::int64_t j, Vec2 p) const {
    return any_within(window(i, j, x.reach, y.reach), p, coverage2_);
  }

  /// Which parts of base cell (i, j) are covered, each by one sample's disk.
  std::uint32_t covers(std::int64_t i, std::int64_t j, const Quarters& parts) const {
    return covered_quarters(window(i, j, x.reach, y.reach), parts, coverage2_);
  }

  /// Has what a query around base cell (i, j) reads on its way into the cache.
  void prefetch(std::int64_t i, std::int64_t j) const {
    const CellWindow w = window(i, j, x.reach, y.reach);
    for (std::size_t row = 0; row < w.rows; ++row) {
      __builtin_prefetch(w.x + row * w.stride);
      __builtin_prefetch(w.x + row * w.stride + w.columns - 1);
      __builtin_prefetch(w.y + row * w.stride);
      __builtin_prefetch(w.y + row * w.stride + w.columns - 1);
    }
  }

  std::pair<std::int64_t, std::int64_t> cell_of(Vec2 p) const {
    return {std::clamp<std::int64_t>(static_cast<std::int64_t>(p.x / x.side), 0, x.cells - 1),
            std::clamp<std::int64_t>(static_cast<std::int64_t>(p.y / y.side), 0, y.cells - 1)};
  }

 private:
  std::size_t index(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>((j + y.reach) * x.stride + i + x.reach);
  }
  CellWindow window(std::int64_t i, std::int64_t j, std::int64_t reach_x, std::int64_t reach_y) const {
    const std::size_t first = index(i - reach_x, j - reach_y);
    return {&table_x_[first], &table_y_[first], static_cast<std::size_t>(x.stride),
            static_cast<std::size_t>(2 * reach_x + 1), static_cast<std::size_t>(2 * reach_y + 1)};
  }

  void put_image(std::size_t at, Vec2 p) {
    table_x_[at] = p.x;
    table_y_[at] = p.y;
  }

  std::vector<double> table_x_, table_y_;
  double conflict2_, coverage2_;
};

/// A cell of the flat quadtree, in units of the current level's side.
struct ActiveCell {
  std::uint32_t i, j;
};

class Sampler {
 public:
  Sampler(const Torus& torus, const DiskRadii& radii, Rng& rng, Control& control)
      : grid_(torus, radii), radii_(radii), rng_(rng), control_(control) {}

  /// Throws darts into the active cells and halves them, until no active cell is left (or they reach the
  /// resolution of their 32-bit indices: proof deals with what is left then).
  void run() {
    for (std::int64_t j = 0; j < grid_.y.cells; ++j)
      for (std::int64_t i = 0; i < grid_.x.cells; ++i)
        active_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
    for (int round = 0; !active_.empty() && halvable(); ++round) {
      throw_darts();
      halve();
      control_.report({1 - 1.0 / (2 + round)});
    }
  }

  PointSet samples(const std::shared_ptr<const Torus>& torus) const {
    PointSet points{torus, {}};
    for (std::int64_t j = 0; j < grid_.y.cells; ++j)
      for (std::int64_t i = 0; i < grid_.x.cells; ++i)
        if (grid_.taken(i, j)) points.push_back({grid_.sample(i, j).x, grid_.sample(i, j).y, 0});
    return points;
  }

  /// Adds a point if it conflicts with none.
  bool insert(Vec3 p) {
    const Vec2 at{p.x, p.y};
    const auto [i, j] = grid_.cell_of(at);
    if (grid_.taken(i, j) || grid_.conflicts(i, j, at)) return false;
    grid_.put(i, j, at);
    return true;
  }

 private:
  static constexpr double darts_a_cell = 0.5;  // a cell that is missed is halved, which finds its gap faster
  static constexpr std::size_t darts_between_checks = 1 << 14;
  static constexpr int most_draws = 16;

  Vec2 side() const {
    return {grid_.x.side / static_cast<double>(std::int64_t{1} << level_x_),
            grid_.y.side / static_cast<double>(std::int64_t{1} << level_y_)};
  }

  bool halvable() const {
    constexpr std::int64_t most = std::int64_t{1} << 31;
    return (grid_.x.cells << level_x_) < most && (grid_.y.cells << level_y_) < most;
  }

  /// A place in a base cell.
  struct Dart {
    std::int64_t i, j;
    Vec2 at;
    bool inside;
  };

  /// Darts are drawn some time before they are thrown, so that memory can be fetched in between.
  void throw_darts() {
    constexpr std::size_t batch = 64;
    const auto darts = static_cast<std::size_t>(darts_a_cell * static_cast<double>(active_.size())) + 1;
    const Vec2 size = side();
    std::array<Dart, batch> drawn;
    for (std::size_t begin = 0; begin < darts; begin += batch) {
      if (begin % darts_between_checks == 0) control_.check();
      const std::size_t n = std::min(batch, darts - begin);
      std::array<std::size_t, batch> cells;
      for (std::size_t k = 0; k < n; ++k) {
        cells[k] = rng_.below(active_.size());
        __builtin_prefetch(&active_[cells[k]]);
      }
      for (std::size_t k = 0; k < n; ++k) {
        drawn[k] = draw(active_[cells[k]], size);
        grid_.prefetch(drawn[k].i, drawn[k].j);
      }
      for (std::size_t k = 0; k < n; ++k) throw_dart(drawn[k]);
    }
  }

  Dart draw(ActiveCell c, Vec2 size) {
    const double u = rng_.uniform(), v = rng_.uniform();
    // Rounding may lift the last cell's points onto the period, which is 0.
    const Vec2 p{wrap((c.i + u) * size.x, grid_.x.period), wrap((c.j + v) * size.y, grid_.y.period)};
    const bool wrapped = p.x < c.i * size.x || p.y < c.j * size.y;
    return {c.i >> level_x_, c.j >> level_y_, p, !wrapped};
  }

  void throw_dart(const Dart& dart) {
    if (!dart.inside || grid_.taken(dart.i, dart.j) || grid_.covered(dart.i, dart.j, dart.at)) return;
    put(radii_.conflict < radii_.coverage ? drawn_near(dart.at) : dart.at);
  }

  void put(Vec2 p) {
    const auto [i, j] = grid_.cell_of(p);
    grid_.put(i, j, p);
  }

  /// A point that covers the uncovered place and conflicts with no sample; at worst the place itself.
  Vec2 drawn_near(Vec2 place) {
    for (int draw = 0; draw < most_draws; ++draw) {
      const double u = 2 * rng_.uniform() - 1, v = 2 * rng_.uniform() - 1;
      if (u * u + v * v >= 1) continue;
      const Vec2 p{wrap(place.x + u * radii_.coverage, grid_.x.period),
                   wrap(place.y + v * radii_.coverage, grid_.y.period)};
      const auto [i, j] = grid_.cell_of(p);
      if (!grid_.taken(i, j) && !grid_.conflicts(i, j, p)) return p;
    }
    return place;
  }

  /// Keeps the parts of active cells that no single disk covers. Long cells, which only thin tori have, are
  /// halved across; quarters of them would stay as long, and follow the rim of a disk in very many pieces.
  void halve() {
    const Vec2 size = side();
    const unsigned across_x = size.x * 2 > size.y ? 1 : 0, across_y = size.y * 2 > size.x ? 1 : 0;
    const Vec2 part{across_x != 0 ? size.x / 2 : size.x, across_y != 0 ? size.y / 2 : size.y};
    next_.clear();
    for (std::size_t k = 0; k < active_.size(); ++k) {
      if (k % darts_between_checks == 0) control_.check();
      const ActiveCell c = active_[k];
      const std::int64_t i = c.i >> level_x_, j = c.j >> level_y_;
      if (grid_.taken(i, j)) continue;
      const std::uint32_t left = c.i << across_x, low = c.j << across_y;
      const std::uint32_t covered = grid_.covers(i, j,
                                                 {{(left + 0.5) * part.x, (left + across_x + 0.5) * part.x},
                                                  {(low + 0.5) * part.y, (low + across_y + 0.5) * part.y},
                                                  0.5 * part});
      for (unsigned b = 0; b <= across_y; ++b)
        for (unsigned a = 0; a <= across_x; ++a)
          if ((covered >> (2 * b + a) & 1) == 0) next_.push_back({left + a, low + b});
    }
    active_.swap(next_);
    level_x_ += static_cast<int>(across_x);
    level_y_ += static_cast<int>(across_y);
  }

  SampleGrid grid_;
  DiskRadii radii_;
  Rng& rng_;
  Control& control_;
  std::vector<ActiveCell> active_, next_;
  int level_x_ = 0, level_y_ = 0;  // how often each axis has been halved
};

/// The farthest corner of every cell that is farther than `radius` from its sample, in the points' order.
std::vector<Vec3> find_gaps(const PointSet& points, double radius, const Control& control) {
  std::vector<Vec2> farthest(points.size());
  visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
    for (std::size_t k = 0; k < spokes.size(); ++k) {
      const Vec2 corner = circumcenter(spokes[k].offset, spokes[k + 1 == spokes.size() ? 0 : k + 1].offset);
      if (norm2(corner) > norm2(farthest[i])) farthest[i] = corner;
    }
  });
  std::vector<Vec3> gaps;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (norm2(farthest[i]) > radius * radius) gaps.push_back(points.domain->step(points[i], farthest[i]));
  return gaps;
}

}  // namespace

PointSet throw_darts(const std::shared_ptr<const Torus>& torus, const DiskRadii& radii, Rng& rng,
                     Control& control) {
  Sampler sampler(*torus, radii, rng, control);
  sampler.run();
  PointSet points = sampler.samples(torus);
  // A corner that lies within rounding of the radius can't be filled and need not be.
  for (;;) {
    bool filled = false;
    for (const Vec3 gap : find_gaps(points, radii.coverage * (1 + 1e-10), control))
      filled |= sampler.insert(gap);
    if (!filled) break;
    points = sampler.samples(torus);
  }
  control.report({1});
  return points;
}

double count_below(double count, double scatter) {
  return std::max(1.0, count - 2 * scatter * std::sqrt(count));
}

PointSet throw_darts_to_count(const std::shared_ptr<const Torus>& torus, std::uint64_t count,
                              const DiskRadii& radii, Rng& rng, Control& control) {
  if (count == 1) {  // the radius for it would be one that leaves a gap of no size
    const Vec3 only = torus->random_point(rng);
    return {torus, {only.x, only.y}};
  }
  const double farthest = norm(torus->box().size) / 2, beta = radii.coverage / radii.conflict;
  double growth = 0.25 / std::sqrt(static_cast<double>(count));
  for (double radius = radii.conflict;; radius = std::min((1 + growth) * radius, farthest), growth *= 2) {
    Sampler sampler(*torus, {radius, beta * radius}, rng, control);
    sampler.run();
    PointSet points = sampler.samples(torus);
    const std::size_t drawn = points.size();
    if (drawn > count) continue;
    const double coverage = beta * radius;
    FarthestPointEnd end;
    end.count = count;
    end.shallowest = coverage * (1 - 1.5 * static_cast<double>(count - drawn) / static_cast<double>(count));
    // Were the darts to leave a gap of more than the radius with no point to spare for it, beta would be
    // above what is wanted.
    if (insert_farthest(points, end, control) > coverage * (1 + 1e-9)) continue;
    bring_into_rows(points, drawn, radius, control);
    control.report({1});
    return points;
  }
}

}  // namespace wellspaced

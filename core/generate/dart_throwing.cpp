#include "core/generate/dart_throwing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/generate/farthest_point.h"
#include "core/generate/row_order.h"
#include "core/parallel.h"
#include "core/voronoi/cell_finder.h"

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
        table_(static_cast<std::size_t>(x.stride * y.stride), {empty, empty}) {
    // Images are rounded copies: the radii are widened by what that can hide.
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(x.period, y.period);
    conflict2_ = (radii.conflict + rounding) * (radii.conflict + rounding);
    coverage2_ = (radii.coverage + rounding) * (radii.coverage + rounding);
  }

  const GridAxis x, y;

  bool taken(std::int64_t i, std::int64_t j) const { return !std::isnan(at(i, j).x); }
  Vec2 sample(std::int64_t i, std::int64_t j) const { return at(i, j); }

  void put(std::int64_t i, std::int64_t j, Vec2 p) {
    for (std::int64_t gj = j - y.cells * ((j + y.reach) / y.cells); gj < y.cells + y.reach; gj += y.cells)
      for (std::int64_t gi = i - x.cells * ((i + x.reach) / x.cells); gi < x.cells + x.reach; gi += x.cells)
        table_[index(gi, gj)] = {p.x + static_cast<double>((gi - i) / x.cells) * x.period,
                                 p.y + static_cast<double>((gj - j) / y.cells) * y.period};
  }

  /// Whether a point of base cell (i, j) is nearer than the conflict radius to a sample.
  bool conflicts(std::int64_t i, std::int64_t j, Vec2 p) const {
    return any_within(i, j, p, {x.near, y.near}, conflict2_);
  }
  /// Whether a sample covers it.
  bool covered(std::int64_t i, std::int64_t j, Vec2 p) const {
    return any_within(i, j, p, {x.reach, y.reach}, coverage2_);
  }

  /// Whether one sample's disk covers the whole square with that center and half-side.
  bool covers(std::int64_t i, std::int64_t j, Vec2 center, Vec2 half) const {
    for (std::int64_t gj = j - y.reach; gj <= j + y.reach; ++gj) {
      const Vec2* row = &table_[index(i - x.reach, gj)];
      bool hit = false;
      for (std::int64_t k = 0; k <= 2 * x.reach; ++k) {
        const Vec2 farthest{std::fabs(row[k].x - center.x) + half.x, std::fabs(row[k].y - center.y) + half.y};
        hit |= norm2(farthest) < coverage2_;
      }
      if (hit) return true;
    }
    return false;
  }

  std::pair<std::int64_t, std::int64_t> cell_of(Vec2 p) const {
    return {std::clamp<std::int64_t>(static_cast<std::int64_t>(p.x / x.side), 0, x.cells - 1),
            std::clamp<std::int64_t>(static_cast<std::int64_t>(p.y / y.side), 0, y.cells - 1)};
  }

 private:
  std::size_t index(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>((j + y.reach) * x.stride + i + x.reach);
  }
  const Vec2& at(std::int64_t i, std::int64_t j) const { return table_[index(i, j)]; }

  struct Reach {
    std::int64_t x, y;
  };
  bool any_within(std::int64_t i, std::int64_t j, Vec2 p, Reach reach, double radius2) const {
    for (std::int64_t gj = j - reach.y; gj <= j + reach.y; ++gj) {
      const Vec2* row = &table_[index(i - reach.x, gj)];
      bool hit = false;
      for (std::int64_t k = 0; k <= 2 * reach.x; ++k) hit |= norm2(row[k] - p) < radius2;
      if (hit) return true;
    }
    return false;
  }

  std::vector<Vec2> table_;
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

  void throw_darts() {
    const auto darts = static_cast<std::size_t>(darts_a_cell * static_cast<double>(active_.size())) + 1;
    const Vec2 size = side();
    for (std::size_t t = 0; t < darts; ++t) {
      if (t % darts_between_checks == 0) control_.check();
      const ActiveCell c = active_[rng_.below(active_.size())];
      const double u = rng_.uniform(), v = rng_.uniform();
      const std::int64_t i = c.i >> level_x_, j = c.j >> level_y_;
      if (grid_.taken(i, j)) continue;
      // Rounding may lift the last cell's points onto the period, which is 0.
      const Vec2 p{wrap((c.i + u) * size.x, grid_.x.period), wrap((c.j + v) * size.y, grid_.y.period)};
      const bool wrapped = p.x < c.i * size.x || p.y < c.j * size.y;
      if (wrapped || grid_.covered(i, j, p)) continue;
      put(radii_.conflict < radii_.coverage ? drawn_near(p) : p);
    }
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
      for (unsigned b = 0; b <= across_y; ++b)
        for (unsigned a = 0; a <= across_x; ++a) {
          const ActiveCell q{(c.i << across_x) + a, (c.j << across_y) + b};
          if (!grid_.covers(i, j, {(q.i + 0.5) * part.x, (q.j + 0.5) * part.y}, 0.5 * part))
            next_.push_back(q);
        }
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
  const NeighborGrid grid(points, hexagonal_spacing(points.domain->area(), points.size()));
  constexpr std::size_t block = 1024;
  std::vector<std::vector<Vec3>> gaps((points.size() + block - 1) / block);
  parallel_blocks(points.size(), block, control, [&](std::size_t begin, std::size_t end) {
    CellFinder finder(points, grid, 2.05 * radius, control);
    for (std::size_t i = begin; i < end; ++i) {
      finder.load(static_cast<std::uint32_t>(i));
      const Cell& cell = finder.cell_at({});
      if (cell.outradius2() <= radius * radius) continue;
      const auto farthest = std::max_element(cell.corners().begin(), cell.corners().end(),
                                             [](auto& a, auto& b) { return norm2(a.at) < norm2(b.at); });
      gaps[begin / block].push_back(points.domain->step(points[i], farthest->at));
    }
  });
  std::vector<Vec3> all;
  for (const auto& part : gaps) all.insert(all.end(), part.begin(), part.end());
  return all;
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

#include "core/analyze/distributions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include "core/analyze/point_look.h"
#include "core/analyze/spacing_star.h"
#include "core/large_vector.h"
#include "core/math.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

constexpr BinGrid beta_grid{0.5, 0.01}, valence_grid{-0.5, 1}, angle_grid{0, 1, 179}, edge_grid{0, 0.02},
    nearest_grid{0, 0.02}, area_grid{0, 0.02};

/// No triangulation of a torus has all edges longer than the triangular lattice's, d_hex: so many bins hold
/// most_bins from the first one that is not empty.
constexpr std::size_t edge_bins = Histogram::most_bins + 52, angle_bins = 180;

constexpr std::size_t between_checks = 1 << 16;

/// Sums of values' deviations from `typical`, near which the mean is, so that nothing cancels.
struct Sums {
  double count = 0, sum = 0, squares = 0;

  void add(double value, double typical) {
    ++count;
    sum += value - typical;
    squares += (value - typical) * (value - typical);
  }
  void add(const Sums& other) {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
  }
};

constexpr double typical_angle = 60, typical_edge = 1;

/// Values that a star has more than one of, counted. Counts and extremes do not depend on the order.
struct Counter {
  BinCounts bins;
  double min = std::numeric_limits<double>::infinity(), max = 0;

  explicit Counter(std::size_t count) : bins{0, std::vector<std::uint64_t>(count)} {}

  void add(const BinGrid& grid, double value) {
    bins.add(grid.bin(value));
    min = std::min(min, value);
    max = std::max(max, value);
  }
  void add(const Counter& other) {
    for (std::size_t k = 0; k < bins.counts.size(); ++k) bins.counts[k] += other.bins.counts[k];
    bins.beyond += other.bins.beyond;
    min = std::min(min, other.min);
    max = std::max(max, other.max);
  }
  Histogram result(const BinGrid& grid, const Sums& sums, double typical) const {
    Histogram h = histogram(grid, bins);
    const double off = sums.sum / sums.count;
    h.mean = typical + off;
    h.sd = std::sqrt(std::max(0.0, sums.squares / sums.count - off * off));
    h.min = min;
    h.max = max;
    return h;
  }
};

struct Counters {
  std::mutex mutex;
  Counter angles{angle_bins}, edges{edge_bins};
};

/// Some counters, of which each thread mostly has its own.
class SharedCounters {
 public:
  Counters& mine() { return all_[std::hash<std::thread::id>{}(std::this_thread::get_id()) % all_.size()]; }
  std::array<Counters, 32>& all() { return all_; }

 private:
  std::array<Counters, 32> all_;
};

/// Each edge is seen from both of its ends, and counted at one.
bool is_counted_at(std::size_t i, const Spoke& spoke) {
  if (spoke.id != i) return i < spoke.id;
  return spoke.offset.x > 0 || (spoke.offset.x == 0 && spoke.offset.y > 0);
}

/// What is said of each sample, in the points' order.
struct Samples {
  explicit Samples(std::size_t n) : beta_i(n), valence(n), nearest(n), cell_area(n), angles(n), edges(n) {}

  LargeVector<double> beta_i, valence, nearest, cell_area;
  LargeVector<Sums> angles, edges;
};

class Pass {
 public:
  explicit Pass(const PointSet& points)
      : d_hex_(hexagonal_spacing(points.domain->area(), points.size())),
        mean_area_(points.domain->area() / static_cast<double>(points.size())),
        samples_(points.size()) {}

  /// Concurrently for different samples, as all that follows.
  void add(std::size_t i, std::span<const Spoke> spokes) {
    const StarMeasure m = measure_star(i, spokes);
    samples_.beta_i[i] = m.outradius / m.nearest;
    samples_.valence[i] = m.valence;
    samples_.nearest[i] = m.nearest / d_hex_;
    samples_.cell_area[i] = m.cell_area / mean_area_;
    Counters& counters = counters_.mine();
    const std::lock_guard lock(counters.mutex);
    samples_.angles[i] = add_angles(spokes, counters.angles);
    samples_.edges[i] = add_edges(i, spokes, counters.edges);
  }

  /// The same on any domain; areas are so far in the sample's units.
  void add(const MovingSet& set, std::size_t i, const PointLook& look, const DomainStar& star) {
    samples_.beta_i[i] = look.outradius / look.nearest;
    samples_.valence[i] = look.valence;
    samples_.nearest[i] = look.nearest / set.unit(i);
    samples_.cell_area[i] = look.area;
    Counters& counters = counters_.mine();
    const std::lock_guard lock(counters.mutex);
    const auto spokes = star.spokes();
    for (std::size_t k = 0; k < spokes.size(); ++k) {
      const Vec2 a = spokes[k].way, b = spokes[k + 1 == spokes.size() ? 0 : k + 1].way;
      if (spokes[k].closes) add_angle(a, b, counters.angles, samples_.angles[i]);
      const std::uint32_t j = spokes[k].id;
      if (is_counted_at(i, {a, j}))
        add_edge(norm(a) / std::min(set.unit(i), set.unit(j)), counters.edges, samples_.edges[i]);
    }
  }

  /// Makes areas parts of their mean.
  void finish_areas() {
    auto& areas = samples_.cell_area;
    const double mean = std::accumulate(areas.begin(), areas.end(), 0.0) / static_cast<double>(areas.size());
    for (double& area : areas) area /= mean;
  }

  Distributions result(const Control& control) {
    const auto& areas = samples_.cell_area;
    require_whole(std::accumulate(areas.begin(), areas.end(), 0.0), static_cast<double>(areas.size()));
    Counters total;
    for (const Counters& some : counters_.all()) {
      total.angles.add(some.angles);
      total.edges.add(some.edges);
    }
    Sums angles, edges;
    for (std::size_t i = 0; i < samples_.angles.size(); ++i) {
      if (i % between_checks == 0) control.check();
      angles.add(samples_.angles[i]);
      edges.add(samples_.edges[i]);
    }
    return {histogram(beta_grid, samples_.beta_i, control),
            histogram(valence_grid, samples_.valence, control),
            total.angles.result(angle_grid, angles, typical_angle),
            total.edges.result(edge_grid, edges, typical_edge),
            histogram(nearest_grid, samples_.nearest, control),
            histogram(area_grid, samples_.cell_area, control)};
  }

 private:
  /// At the center, so that each triangle is counted at its three corners.
  static Sums add_angles(std::span<const Spoke> spokes, Counter& counter) {
    Sums sums;
    for (std::size_t k = 0; k < spokes.size(); ++k)
      add_angle(spokes[k].offset, spokes[k + 1 == spokes.size() ? 0 : k + 1].offset, counter, sums);
    return sums;
  }

  static void add_angle(Vec2 a, Vec2 b, Counter& counter, Sums& sums) {
    const double angle = portable_atan2(1, dot(a, b) / cross(a, b)) * (180 / pi);
    counter.add(angle_grid, angle);
    sums.add(angle, typical_angle);
  }

  Sums add_edges(std::size_t i, std::span<const Spoke> spokes, Counter& counter) const {
    Sums sums;
    for (const Spoke& spoke : spokes)
      if (is_counted_at(i, spoke)) add_edge(norm(spoke.offset) / d_hex_, counter, sums);
    return sums;
  }

  static void add_edge(double length, Counter& counter, Sums& sums) {
    counter.add(edge_grid, length);
    sums.add(length, typical_edge);
  }

  const double d_hex_, mean_area_;
  Samples samples_;
  SharedCounters counters_;
};

}  // namespace

Distributions distributions(const PointSet& points, const Control& control) {
  require_usable(points, control);
  Pass pass(points);
  if (!is_plain_torus(points)) {
    const MovingSet set(points, control);
    for_each_look(set, control, [&](std::size_t i, const PointLook& look, const DomainStar& star) {
      pass.add(set, i, look, star);
    });
    pass.finish_areas();
    return pass.result(control);
  }
  visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) { pass.add(i, spokes); });
  return pass.result(control);
}

Distributions pool(std::span<const Distributions> sets) {
  const auto pooled = [&](Histogram Distributions::*which) {
    std::vector<Histogram> histograms;
    for (const Distributions& set : sets) histograms.push_back(set.*which);
    return pool(std::span<const Histogram>(histograms));
  };
  return {pooled(&Distributions::beta_i), pooled(&Distributions::valence), pooled(&Distributions::angle_deg),
          pooled(&Distributions::edge),   pooled(&Distributions::nearest), pooled(&Distributions::cell_area)};
}

}  // namespace wellspaced

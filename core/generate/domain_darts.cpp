#include "core/generate/domain_darts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <string>

#include "core/domain/near_pair.h"
#include "core/error.h"
#include "core/generate/disk_tree.h"
#include "core/generate/expected_points.h"
#include "core/generate/hole_filler.h"
#include "core/generate/row_order.h"
#include "core/text.h"

namespace wellspaced {
namespace {

constexpr std::uint32_t nobody = ~0u;
constexpr std::size_t between_checks = 512;
constexpr std::size_t many_triangles = 8;  ///< a point: from here on it is faster to look from the points

/// Radii differ by so much: one grid does not suit them all.
constexpr double many_sizes = 4;

/// A part of a curve, in lengths along it.
struct Interval {
  double begin, end;
};

std::vector<Vec3> corners_of(const Domain& domain) {
  std::vector<Vec3> corners;
  const std::vector<BoundaryCurve> curves = domain.boundary();
  for (std::size_t c = 0; c < curves.size(); ++c)
    if (!curves[c].closed) corners.push_back(domain.boundary_point(c, 0));
  return corners;
}

/// Corners of triangles, each place once.
class CornersOf {
 public:
  explicit CornersOf(std::span<const DomainTriangle> triangles) : numbers_(triangles.size()) {
    std::vector<std::uint32_t> order(3 * triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto place = [&](std::uint32_t k) {
      const Vec3 p = triangles[k / 3][k % 3];
      return std::array{p.x, p.y, p.z};
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto at = place(order[k]);
      if (k == 0 || at != place(order[k - 1])) {
        first_.push_back(static_cast<std::uint32_t>(k));
        coordinates.insert(coordinates.end(), at.begin(), at.end());
      }
      numbers_[order[k] / 3][order[k] % 3] = static_cast<std::uint32_t>(first_.size() - 1);
      triangles_.push_back(order[k] / 3);
    }
    first_.push_back(static_cast<std::uint32_t>(order.size()));
  }

  const std::array<std::uint32_t, 3>& of(std::size_t triangle) const { return numbers_[triangle]; }
  std::span<const std::uint32_t> triangles_at(std::uint32_t corner) const {
    return {triangles_.data() + first_[corner], first_[corner + 1] - first_[corner]};
  }

  std::vector<double> coordinates;

 private:
  std::vector<std::array<std::uint32_t, 3>> numbers_;
  std::vector<std::uint32_t> first_, triangles_;
};

class DomainDarts {
 public:
  DomainDarts(const std::shared_ptr<const Domain>& domain, const DiskRule& rule, Rng& rng, Control& control)
      : domain_(*domain),
        rule_(rule),
        rng_(rng),
        control_(control),
        expected_(expected_points(*domain, rule)),
        points_{domain, {}},
        grid_(points_, rule.least(), static_cast<std::size_t>(expected_)),
        tree_(points_, radii_),
        is_graded_(rule.most() > many_sizes * rule.least()),
        curvature_(domain->is_flat() || !domain->has_exact_cells() ? 0
                                                                   : std::numbers::pi / domain->farthest()),
        bounded_(domain->boundary_length() > 0) {}

  PointSet run() {
    if (bounded_) fill_boundary();
    throw_everywhere();
    fill_triangles();
    HoleFiller(points_, grid_, rule_, control_).fill();
    return std::move(points_);
  }

 private:
  // ---- darts

  /// Whether there is room for a point at p; it is then there.
  bool take(Vec3 p) {
    const double r = rule_.radius(p);
    if (has_conflict(p, r)) return false;
    add(p, r);
    return true;
  }

  bool has_conflict(Vec3 p, double r) {
    const auto reach = [&](double earlier) { return rule_.distance(r, earlier); };
    const auto is_nearer = [&](const Neighbor& q) { return domain_.is_nearer(p, q, reach(radii_[q.id])); };
    if (is_graded_) return tree_.any(p, reach, is_nearer);
    neighbors_.clear();
    grid_.gather(p, nobody, rule_.reach(r) / rule_.coverage, neighbors_);
    return std::any_of(neighbors_.begin(), neighbors_.end(), is_nearer);
  }

  void add(Vec3 p, double r) {
    points_.push_back(p);
    radii_.push_back(r);
    grid_.add(static_cast<std::uint32_t>(points_.size() - 1));
    if (is_graded_) tree_.add(static_cast<std::uint32_t>(points_.size() - 1));
  }

  bool is_inside(Vec3 p) const {
    return !bounded_ || (!domain_.why_outside(p) && domain_.freedom(p).dimensions == 2);
  }

  // ---- the boundary

  void fill_boundary() {
    const std::vector<BoundaryCurve> curves = domain_.boundary();
    for (const Vec3 corner : corners_of(domain_)) take_corner(corner);
    for (std::size_t c = 0; c < curves.size(); ++c) {
      if (c % between_checks == 0) control_.check();
      fill_curve(c, curves[c]);
    }
  }

  /// Curves of one loop follow each other, so that its corners are the beginnings of curves.
  void take_corner(Vec3 p) { add(p, rule_.radius(p)); }

  void fill_curve(std::size_t curve, const BoundaryCurve& shape) {
    constexpr int deepest = 50;
    std::vector<Interval> active = {{0, shape.length}};
    for (int level = 0; level < deepest && !active.empty(); ++level) {
      throw_at_curve(curve, active);
      std::vector<Interval> halves;
      for (std::size_t k = 0; k < active.size(); ++k) {
        if (k % between_checks == 0) control_.check();
        const Interval& whole = active[k];
        if (is_covered(curve, whole)) continue;
        const double middle = 0.5 * (whole.begin + whole.end);
        for (const Interval& half : {Interval{whole.begin, middle}, Interval{middle, whole.end}})
          if (!is_covered(curve, half)) halves.push_back(half);
      }
      active.swap(halves);
    }
  }

  void throw_at_curve(std::size_t curve, const std::vector<Interval>& active) {
    std::vector<double> sums;
    double sum = 0;
    for (const Interval& i : active) sums.push_back(sum += i.end - i.begin);
    for (std::size_t dart = 0; dart < active.size(); ++dart) {
      if (dart % between_checks == 0) control_.check();
      const double at = rng_.uniform() * sum;
      const auto k =
          std::min(static_cast<std::size_t>(std::upper_bound(sums.begin(), sums.end(), at) - sums.begin()),
                   active.size() - 1);
      const double along = active[k].end - (sums[k] - at);
      const Vec3 p = domain_.boundary_point(curve, along);
      if (domain_.freedom(p).dimensions == 1) take(p);
    }
  }

  bool is_covered(std::size_t curve, const Interval& part) {
    const Vec3 a = domain_.boundary_point(curve, part.begin), b = domain_.boundary_point(curve, part.end);
    const Vec3 middle = domain_.boundary_point(curve, 0.5 * (part.begin + part.end));
    const std::array<Vec3, 2> ends = {a, b};
    return is_covered(ends, middle, part.end - part.begin);
  }

  // ---- inside

  void throw_everywhere() {
    const auto darts = static_cast<std::size_t>(2 * expected_);
    for (std::size_t dart = 0; dart < darts; ++dart) {
      if (dart % between_checks == 0) control_.check();
      const Vec3 p = domain_.random_point(rng_);
      if (is_inside(p)) take(p);
    }
  }

  void fill_triangles() {
    constexpr int rounds = 30;
    std::vector<DomainTriangle> triangles = domain_.triangles(), active;
    are_small_ = !domain_.has_exact_cells() && triangles.size() > many_triangles * points_.size();
    drop_covered(triangles);
    for (const DomainTriangle& triangle : triangles) split(triangle, active);
    for (int round = 0; round < rounds && !active.empty(); ++round) {
      throw_at_triangles(active);
      drop_covered(active);
      std::vector<DomainTriangle> parts;
      for (std::size_t k = 0; k < active.size(); ++k) {
        if (k % between_checks == 0) control_.check();
        for (const DomainTriangle& half : halves(active[k]))
          for (const DomainTriangle& quarter : halves(half))
            if (are_small_ || !is_covered(quarter)) parts.push_back(quarter);
      }
      if (are_small_) drop_covered(parts);
      active.swap(parts);
      control_.report({std::min(0.95, 0.3 + 0.05 * round)});
    }
  }

  /// Those that a single disk covers.
  void drop_covered(std::vector<DomainTriangle>& triangles) {
    std::vector<bool> covered(triangles.size(), false);
    if (are_small_) {
      look_from_points(triangles, covered);
    } else {
      for (std::size_t k = 0; k < triangles.size(); ++k) {
        if (k % between_checks == 0) control_.check();
        covered[k] = is_covered(triangles[k]);
      }
    }
    std::size_t k = 0;
    const auto is_dropped = [&](const DomainTriangle&) { return covered[k++]; };
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_dropped), triangles.end());
  }

  /// Where a point has many triangles around it: one search to all of their corners instead of one from each
  /// of them. No place of a triangle is farther than size / sqrt(3) from a corner.
  void look_from_points(const std::vector<DomainTriangle>& triangles, std::vector<bool>& covered) {
    const CornersOf corners(triangles);
    const PointSet places{points_.domain, corners.coordinates};
    const NeighborGrid grid(places, rule_.least());
    std::vector<double> distances, to_corner(places.size(), HUGE_VAL);
    for (std::uint32_t q = 0; q < points_.size(); ++q) {
      control_.check();
      neighbors_.clear();
      grid.gather(points_[q], nobody, rule_.reach(radii_[q]), neighbors_);
      domain_.distances(points_[q], rule_.reach(radii_[q]), neighbors_, distances);
      for (std::size_t k = 0; k < distances.size(); ++k) to_corner[neighbors_[k].id] = distances[k];
      for (const Neighbor& corner : neighbors_)
        for (const std::uint32_t t : corners.triangles_at(corner.id))
          covered[t] = covered[t] || covers(q, triangles[t], corners.of(t), to_corner);
      for (const Neighbor& corner : neighbors_) to_corner[corner.id] = HUGE_VAL;
    }
  }

  bool covers(std::uint32_t point, const DomainTriangle& triangle,
              const std::array<std::uint32_t, 3>& corners, const std::vector<double>& to_corner) const {
    const double size = longest_edge(triangle);
    const double radius = coverage_radius(least_between(triangle, size), point);
    return std::all_of(corners.begin(), corners.end(),
                       [&](std::uint32_t c) { return to_corner[c] + size / std::sqrt(3.0) < radius; });
  }

  /// Into parts no longer than a radius; without those that are covered, as the whole is not.
  void split(const DomainTriangle& whole, std::vector<DomainTriangle>& parts) {
    std::vector<DomainTriangle> open = {whole};
    for (std::size_t steps = 0; !open.empty(); ++steps) {
      if (steps % between_checks == 0) control_.check();
      const DomainTriangle triangle = open.back();
      open.pop_back();
      if (longest_edge(triangle) <= rule_.radius(triangle[0])) {
        parts.push_back(triangle);
        continue;
      }
      for (const DomainTriangle& half : halves(triangle))
        if (!is_covered(half)) open.push_back(half);
    }
  }

  void throw_at_triangles(const std::vector<DomainTriangle>& active) {
    std::vector<double> sums;
    double sum = 0;
    for (const DomainTriangle& triangle : active) sums.push_back(sum += domain_.area_of(triangle));
    for (std::size_t dart = 0; dart < active.size(); ++dart) {
      if (dart % between_checks == 0) control_.check();
      const auto found = std::upper_bound(sums.begin(), sums.end(), rng_.uniform() * sum);
      const auto k = std::min(static_cast<std::size_t>(found - sums.begin()), active.size() - 1);
      const Vec3 p = domain_.random_point_in(active[k], rng_);
      if (is_inside(p)) take(p);
    }
  }

  static double longest_edge(const DomainTriangle& t) {
    return std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
  }

  /// At the middle of the longest edge, so that parts don't become thin.
  std::array<DomainTriangle, 2> halves(const DomainTriangle& t) const {
    const double lengths[3] = {norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])};
    const auto longest = static_cast<std::size_t>(std::max_element(lengths, lengths + 3) - lengths);
    const Vec3 a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3], m = domain_.middle(a, b);
    return {DomainTriangle{a, m, c}, DomainTriangle{m, b, c}};
  }

  bool is_covered(const DomainTriangle& t) {
    const Vec3 center = domain_.middle(t[0], domain_.middle(t[1], t[2]));
    return is_covered(t, center, longest_edge(t));
  }

  /// No radius between the corners is below this: no place between them is farther than size / sqrt(3) from
  /// the next one, along chords, which are at least 2 / pi of the way; and on a sphere none is farther than
  /// size^2 / 3 radii from the flat triangle.
  double least_between(std::span<const Vec3> corners, double size) const {
    if (rule_.sizing == nullptr) return rule_.scale;
    if (corners.size() == 3 && rule_.sizing->is_linear()) {
      const auto radius = [&](Vec3 corner) { return rule_.radius(corner); };
      const double least = std::min({radius(corners[0]), radius(corners[1]), radius(corners[2])});
      return std::max(rule_.least(), least - rule_.lipschitz() * curvature_ * size * size / 3);
    }
    const double within = (domain_.is_flat() ? 1 : std::numbers::pi / 2) * size / std::sqrt(3.0);
    double least = rule_.most();
    for (const Vec3 corner : corners) least = std::min(least, rule_.least_near(corner, within));
    return least;
  }

  /// Whether one disk covers all of what lies between the corners.
  bool is_covered(std::span<const Vec3> corners, Vec3 center, double size) {
    const double least = least_between(corners, size);
    gather_covering(corners, center, least, size);
    if (neighbors_.empty()) return false;
    std::array<Vec2, 3> ways;
    for (std::size_t k = 0; k < corners.size(); ++k)
      ways[k] = domain_.way_to(center, localized(center, corners[k], size));
    return std::any_of(neighbors_.begin(), neighbors_.end(), [&](const Neighbor& q) {
      const Vec2 way = domain_.way_to(center, q);
      const double radius = coverage_radius(least, q.id), radius2 = radius * radius;
      return std::all_of(ways.begin(), ways.begin() + static_cast<std::ptrdiff_t>(corners.size()),
                         [&](Vec2 corner) { return norm2(corner - way) < radius2; });
    });
  }

  double coverage_radius(double least, std::uint32_t id) const {
    return rule_.coverage * rule_.distance(least, radii_[id]);
  }

  /// Localized neighbors whose disks may cover all corners, for not even straight through space is one too
  /// far.
  void gather_covering(std::span<const Vec3> corners, Vec3 center, double least, double size) {
    gather_reaching(center, least, size);
    double reach = 0;
    const auto is_far = [&](const Neighbor& q) {
      const double radius = coverage_radius(least, q.id), radius2 = radius * radius;
      for (const Vec3 corner : corners)
        if (norm2(corner - center - q.offset) >= radius2) return true;
      reach = std::max(reach, radius);
      return false;
    };
    neighbors_.erase(std::remove_if(neighbors_.begin(), neighbors_.end(), is_far), neighbors_.end());
    if (!neighbors_.empty()) domain_.localize(center, reach, neighbors_);
  }

  /// Those whose disks are large enough for a size, and may reach the center.
  void gather_reaching(Vec3 center, double least, double size) {
    neighbors_.clear();
    if (!is_graded_) return grid_.gather(center, nobody, rule_.reach(rule_.radius(center)), neighbors_);
    const auto reach = [&](double radius) {
      const double covered = rule_.coverage * rule_.distance(least, radius);
      return covered < 0.5 * size ? 0 : covered;
    };
    tree_.any(center, reach, [&](const Neighbor& q) {
      neighbors_.push_back(q);
      return false;
    });
  }

  Neighbor localized(Vec3 center, Vec3 p, double size) {
    single_.assign(1, {p - center, nobody});
    domain_.localize(center, 2 * size, single_);
    return single_.empty() ? Neighbor{{2 * size, 0, 0}, nobody} : single_.front();
  }

  const Domain& domain_;
  const DiskRule& rule_;
  Rng& rng_;
  Control& control_;
  double expected_;
  PointSet points_;
  std::vector<double> radii_;
  NeighborGrid grid_;
  DiskTree tree_;  ///< of the same points, where radii differ much
  bool is_graded_;
  double curvature_;  ///< of a sphere
  bool bounded_, are_small_ = false;
  std::vector<Neighbor> neighbors_, single_;
};

}  // namespace

PointSet throw_darts_over(const std::shared_ptr<const Domain>& domain, const DiskRule& rule, Rng& rng,
                          Control& control) {
  PointSet points = DomainDarts(domain, rule, rng, control).run();
  sort_into_rows(points, rule.least(), control);
  return points;
}

void require_corners(const Domain& domain, std::uint64_t count) {
  const std::size_t corners = corners_of(domain).size();
  if (count >= corners) return;
  throw Error(ErrorCode::infeasible,
              "the domain has " + std::to_string(corners) +
                  " corners, each of which is a point; ask for as many points or more",
              "/count");
}

void require_corners_apart(const std::shared_ptr<const Domain>& domain) {
  PointSet points{domain, {}};
  for (const Vec3 corner : corners_of(*domain)) points.push_back(corner);
  if (points.size() < 2) return;
  const double limit = nearest_distance(*domain);
  const auto pair = find_near_pair(points, limit, Control());
  if (!pair) return;
  throw Error(ErrorCode::infeasible,
              "each corner is a point, and two corners near " + short_text(points[pair->later]) + " are " +
                  short_number(pair->distance) + " apart, less than the " + short_number(limit) +
                  " that points must be in this domain; merge them",
              "/domain");
}

PointSet throw_darts_over_to_count(const std::shared_ptr<const Domain>& domain, std::uint64_t count,
                                   const DiskRule& rule, Rng& rng, Control& control) {
  require_corners(*domain, count);
  DiskRule tried = rule;
  const auto wanted = static_cast<double>(count);
  const CountFormula formula(*domain, rule.sizing);
  tried.scale = formula.scale(wanted - 0.6 * std::sqrt(wanted)) / rule.coverage;
  for (;;) {
    PointSet points = DomainDarts(domain, tried, rng, control).run();
    const auto found = static_cast<double>(points.size());
    if (points.size() > count) {
      const double scale = tried.scale * rule.coverage;
      tried.scale *= formula.scale(formula.count(scale) * wanted / found) / scale * 1.01;
      continue;
    }
    NeighborGrid grid(points, tried.least(), count);
    HoleFiller(points, grid, tried, control).fill_to(count);
    sort_into_rows(points, tried.least(), control);
    return points;
  }
}

}  // namespace wellspaced

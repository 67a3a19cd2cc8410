#include "core/generate/equal_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace wellspaced {
namespace {

using Triangles = std::vector<DomainTriangle>;

double coordinate(Vec3 p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

double area_of(const DomainTriangle& t) { return 0.5 * norm(cross(t[1] - t[0], t[2] - t[0])); }

/// The place of an edge at which a coordinate has that value.
Vec3 crossing(Vec3 a, Vec3 b, std::size_t axis, double at) {
  const double from = coordinate(a, axis), part = (at - from) / (coordinate(b, axis) - from);
  return a + part * (b - a);
}

/// The triangle's corners, in their order, from one that is alone on its side of the plane; whether it is
/// below. Requires: the plane runs between corners.
std::pair<DomainTriangle, bool> from_lone_corner(const DomainTriangle& t, std::size_t axis, double at) {
  const auto below = [&](std::size_t k) { return coordinate(t[k % 3], axis) < at; };
  std::size_t lone = 0;
  while (below(lone) == below(lone + 1) || below(lone) == below(lone + 2)) ++lone;
  return {{t[lone], t[(lone + 1) % 3], t[(lone + 2) % 3]}, below(lone)};
}

bool is_cut(const DomainTriangle& t, std::size_t axis, double at) {
  const auto [low, high] =
      std::minmax({coordinate(t[0], axis), coordinate(t[1], axis), coordinate(t[2], axis)});
  return low < at && high >= at;
}

class Halver {
 public:
  Halver(const std::shared_ptr<const Domain>& domain, Rng& rng, Control& control)
      : domain_(*domain), rng_(rng), control_(control), points_{domain, {}} {}

  PointSet run(std::uint64_t count) {
    split(domain_.triangles(), count);
    return std::move(points_);
  }

 private:
  void split(Triangles whole, std::uint64_t count) {
    if (whole.size() > 64 || ++calls_ % 256 == 0) control_.check();
    if (count == 1) {
      points_.push_back(random_point(whole));
      return;
    }
    const std::uint64_t first = count / 2;
    const std::size_t axis = longest_axis(whole);
    const double at = cut_position(whole, axis, static_cast<double>(first) / static_cast<double>(count));
    auto [below, above] = cut(whole, axis, at);
    Triangles().swap(whole);
    split(std::move(below), first);
    split(std::move(above), count - first);
  }

  static std::array<double, 2> extent(const Triangles& all, std::size_t axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const DomainTriangle& t : all)
      for (const Vec3 corner : t) {
        low = std::min(low, coordinate(corner, axis));
        high = std::max(high, coordinate(corner, axis));
      }
    return {low, high};
  }

  static std::size_t longest_axis(const Triangles& all) {
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = extent(all, axis);
      if (high - low <= most) continue;
      most = high - low;
      longest = axis;
    }
    return longest;
  }

  static double area_below(const Triangles& all, std::size_t axis, double at) {
    double sum = 0;
    for (const DomainTriangle& t : all) {
      const double area = area_of(t);
      if (!is_cut(t, axis, at)) {
        sum += coordinate(t[0], axis) < at ? area : 0;
        continue;
      }
      const auto [turned, is_below] = from_lone_corner(t, axis, at);
      const double tip = area_of(
          {turned[0], crossing(turned[0], turned[1], axis, at), crossing(turned[0], turned[2], axis, at)});
      sum += is_below ? tip : area - tip;
    }
    return sum;
  }

  /// Where that part of the area is below. By the Illinois method, between bisections.
  static double cut_position(const Triangles& all, std::size_t axis, double part) {
    double whole = 0;
    for (const DomainTriangle& t : all) whole += area_of(t);
    auto [low, high] = extent(all, axis);
    double below_low = -part, below_high = 1 - part;
    for (int step = 0; step < 100; ++step) {
      double at = (low * below_high - high * below_low) / (below_high - below_low);
      if (step % 4 == 3 || !(at > low && at < high)) at = 0.5 * (low + high);
      if (!(at > low && at < high)) break;
      const double excess = area_below(all, axis, at) / whole - part;
      if (std::fabs(excess) < 1e-11) return at;
      if (excess < 0) {
        low = at;
        below_low = excess;
        below_high /= 2;
      } else {
        high = at;
        below_high = excess;
        below_low /= 2;
      }
    }
    return high;
  }

  static std::pair<Triangles, Triangles> cut(const Triangles& all, std::size_t axis, double at) {
    std::pair<Triangles, Triangles> sides;
    for (const DomainTriangle& t : all) {
      if (!is_cut(t, axis, at)) {
        (coordinate(t[0], axis) < at ? sides.first : sides.second).push_back(t);
        continue;
      }
      const auto [turned, is_below] = from_lone_corner(t, axis, at);
      const Vec3 p = crossing(turned[0], turned[1], axis, at), q = crossing(turned[0], turned[2], axis, at);
      Triangles &tip = is_below ? sides.first : sides.second, &rest = is_below ? sides.second : sides.first;
      tip.push_back({turned[0], p, q});
      rest.push_back({p, turned[1], turned[2]});
      rest.push_back({p, turned[2], q});
    }
    return sides;
  }

  bool is_inside(Vec3 p) const { return !domain_.why_outside(p) && domain_.freedom(p).dimensions == 2; }

  Vec3 random_point(const Triangles& part) {
    constexpr int most_tries = 100;  // of a part that is nothing but boundary, but for rounding
    std::vector<double> sums;
    double sum = 0;
    for (const DomainTriangle& t : part) sums.push_back(sum += area_of(t));
    for (int tries = 0; tries < most_tries && sum > 0; ++tries) {
      const auto found = std::upper_bound(sums.begin(), sums.end(), rng_.uniform() * sum);
      const auto k = std::min(static_cast<std::size_t>(found - sums.begin()), part.size() - 1);
      const Vec3 p = domain_.random_point_in(part[k], rng_);
      if (is_inside(p)) return p;
    }
    return domain_.random_point(rng_);
  }

  const Domain& domain_;
  Rng& rng_;
  Control& control_;
  PointSet points_;
  std::uint64_t calls_ = 0;
};

}  // namespace

PointSet one_in_each_part(const std::shared_ptr<const Domain>& domain, std::uint64_t count, Rng& rng,
                          Control& control) {
  return Halver(domain, rng, control).run(count);
}

}  // namespace wellspaced

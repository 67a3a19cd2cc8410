#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/polygon.h"
#include "core/domain/torus.h"
#include "core/error.h"
#include "core/point_set.h"
#include "core/rng.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/stars.h"

namespace wellspaced::testing {

inline PointSet random_points(double width, double height, std::size_t n, std::uint64_t seed) {
  PointSet points{std::make_shared<Torus>(width, height), {}};
  Rng rng(seed);
  for (std::size_t i = 0; i < n; ++i) points.push_back(points.domain->random_point(rng));
  return points;
}

/// Smallest distance between two samples, over all pairs; on a torus a pair's shortest image is the wrapped
/// difference.
inline double brute_r_f(const PointSet& points) {
  double r_f = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) r_f = std::min(r_f, points.domain->distance(points[i], points[j]));
  return r_f;
}

/// Distance of a place to its nearest sample, over all samples.
inline double brute_distance(const PointSet& points, Vec3 place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    nearest = std::min(nearest, points.domain->distance(points[i], place));
  return nearest;
}

/// Whether a disk has no place of the domain in it, as far as polygons can tell.
inline bool lies_outside(const Domain& domain, Vec3 center, double radius) {
  const auto* polygon = dynamic_cast<const Polygon*>(&domain);
  if (polygon == nullptr || !polygon->why_outside(center)) return false;
  double nearest = std::numeric_limits<double>::infinity();
  const Vec2 c{center.x, center.y};
  for (const auto& ring : polygon->rings())
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = ring[k], way = ring[(k + 1) % ring.size()] - a;
      const double part = std::clamp(dot(c - a, way) / norm2(way), 0.0, 1.0);
      nearest = std::min(nearest, norm(a + part * way - c));
    }
  return nearest > radius;
}

/// Proves r_c with distances only, no triangulation: branch and bound over squares. The distance to the
/// nearest sample changes by at most the way between two places, so a square whose center is d away holds
/// nothing above d + its half diagonal. The result is right to within `tolerance`.
inline double brute_r_c(const PointSet& points, double tolerance) {
  struct Square {
    double x, y, w, h;
  };
  const Box box = points.domain->box();
  std::vector<Square> open = {{box.low.x, box.low.y, box.size.x, box.size.y}}, next;
  double best = 0;
  while (!open.empty()) {
    next.clear();
    for (const Square& s : open) {
      const Vec3 center{s.x + s.w / 2, s.y + s.h / 2, 0};
      if (lies_outside(*points.domain, center, std::hypot(s.w, s.h) / 2)) continue;
      const double d = brute_distance(points, center);
      if (!points.domain->why_outside(center)) best = std::max(best, d);
      if (d + std::hypot(s.w, s.h) / 2 <= best + tolerance) continue;
      const bool wide = s.w > s.h;
      const double w = wide ? s.w / 2 : s.w, h = wide ? s.h : s.h / 2;
      next.push_back({s.x, s.y, w, h});
      next.push_back({wide ? s.x + w : s.x, wide ? s.y : s.y + h, w, h});
    }
    open.swap(next);
  }
  return best;
}

template <class Visit>
std::vector<std::vector<Spoke>> collect_stars(const PointSet& points, const Visit& visit) {
  std::vector<std::vector<Spoke>> stars(points.size());
  const Control control(2);
  visit(points, control,
        [&](std::size_t i, std::span<const Spoke> spokes) { stars[i].assign(spokes.begin(), spokes.end()); });
  return stars;
}

/// The invariants of a Delaunay triangulation of a torus, by brute force: every circumdisk is empty, and the
/// Voronoi cells' areas add up to the domain's.
inline void expect_delaunay(const PointSet& points, const std::vector<std::vector<Spoke>>& stars) {
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& star = stars[i];
    ASSERT_GE(star.size(), 3u) << "star " << i;
    std::vector<Vec2> corners;
    for (std::size_t k = 0; k < star.size(); ++k) {
      const Vec2 a = star[k].offset, b = star[(k + 1) % star.size()].offset;
      ASSERT_GT(cross(a, b), 0) << "star " << i << " spoke " << k;
      const Vec2 center = circumcenter(a, b);
      corners.push_back(center);
      const Vec3 place = points.domain->step(points[i], center);
      ASSERT_GE(brute_distance(points, place), norm(center) * (1 - 1e-9) - 1e-15)
          << "star " << i << " spoke " << k;
    }
    for (std::size_t k = 0; k < corners.size(); ++k)
      area += cross(corners[k], corners[(k + 1) % corners.size()]) / 2;
  }
  EXPECT_NEAR(area, points.domain->area(), 1e-9 * points.domain->area());
}

/// Expects a wellspaced::Error with that code and pointer.
template <class Action>
void expect_error(const Action& action, ErrorCode code, const std::string& where,
                  const std::string& part = "") {
  try {
    action();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    EXPECT_EQ(error.where(), where) << error.what();
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

}  // namespace wellspaced::testing

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/domain/box_domain.h"
#include "core/domain/sphere.h"
#include "core/domain/torus.h"
#include "core/generate/domain_darts.h"
#include "tests/support/oracle.h"

namespace wellspaced::testing {

struct NamedDomain {
  std::string name;
  std::shared_ptr<const Domain> domain;
};

/// One of every kind.
inline std::vector<NamedDomain> domains_of_every_kind() {
  return {{"torus", std::make_shared<Torus>(1.5, 1)},
          {"box", std::make_shared<BoxDomain>(1.5, 1)},
          {"strip along x", std::make_shared<BoxDomain>(1, 2, std::array<bool, 2>{true, false})},
          {"strip along y", std::make_shared<BoxDomain>(2, 1, std::array<bool, 2>{false, true})},
          {"sphere", std::make_shared<Sphere>(0.7)}};
}

/// A maximal Poisson-disk sampling of about n points.
inline PointSet mps_on(const std::shared_ptr<const Domain>& domain, double n, std::uint64_t seed) {
  Rng rng(seed);
  Control control;
  DiskRule rule;
  rule.scale = std::sqrt(0.6966 * domain->area() / n);
  return throw_darts_over(domain, rule, rng, control);
}

/// r_c on a sphere: every corner of the Voronoi diagram is equally far from three samples, with none nearer.
inline double brute_r_c_on_sphere(const PointSet& points, double radius) {
  double most = 0;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Vec3 normal = cross(points[j] - points[i], points[k] - points[i]);
        for (const double side : {1.0, -1.0}) {
          const Vec3 place = (side * radius / norm(normal)) * normal;
          const double d = norm(place - points[i]);
          bool empty = true;
          for (std::size_t q = 0; q < n && empty; ++q) empty = norm(place - points[q]) >= d * (1 - 1e-12);
          if (empty) most = std::max(most, 2 * radius * std::asin(std::min(1.0, d / (2 * radius))));
        }
      }
  return most;
}

inline double brute_r_c_on(const PointSet& points, double tolerance) {
  const auto* sphere = dynamic_cast<const Sphere*>(points.domain.get());
  return sphere != nullptr ? brute_r_c_on_sphere(points, sphere->radius()) : brute_r_c(points, tolerance);
}

}  // namespace wellspaced::testing

#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/control.h"
#include "core/domain/domain.h"
#include "core/vec.h"

namespace wellspaced {

class Sizing;

/// Samples on a domain, in an order that means something: optimizers keep it, generators give row by row.
///
/// Shapes: `coordinates` holds domain->dimension() doubles a point, row-major.
struct PointSet {
  std::shared_ptr<const Domain> domain;
  std::vector<double> coordinates;
  std::shared_ptr<const Sizing> sizing =
      nullptr;  ///< the radii that are wanted where; none: the same all over

  std::size_t size() const {
    return coordinates.empty() ? 0 : coordinates.size() / static_cast<std::size_t>(domain->dimension());
  }
  Vec3 operator[](std::size_t i) const {
    const auto dim = static_cast<std::size_t>(domain->dimension());
    const double* p = &coordinates[i * dim];
    return {p[0], p[1], dim == 3 ? p[2] : 0.0};
  }
  void set(std::size_t i, Vec3 p) {
    const auto dim = static_cast<std::size_t>(domain->dimension());
    double* to = &coordinates[i * dim];
    to[0] = p.x;
    to[1] = p.y;
    if (dim == 3) to[2] = p.z;
  }
  void push_back(Vec3 p) {
    coordinates.push_back(p.x);
    coordinates.push_back(p.y);
    if (domain->dimension() == 3) coordinates.push_back(p.z);
  }
};

/// Whether the points lie on a torus and none is wanted denser anywhere: what the fastest ways are for.
bool is_plain_torus(const PointSet& points);

/// n points that are all still to be set. Errors: cancelled, deadline_exceeded.
PointSet points_to_set(std::shared_ptr<const Domain> domain, std::size_t n, const Control& control);

/// Spacing of the triangular lattice with n points on that area: sqrt(2 area / (sqrt(3) n)); n > 0.
double hexagonal_spacing(double area, std::size_t n);

/// Points nearer to each other than this are refused: 1e-10 of the longest side of the domain's box.
/// Coordinates are rounded to 1e-16 of that, so of points that far apart the triangulation is still theirs,
/// and what is measured of it is right to 1e-5 at worst, where they see each other around the torus.
double nearest_distance(const Domain& domain);

/// Refuses what no operation on spacing can work with.
///
/// Errors: degenerate_input for fewer than 3 points, and where a part of the domain has none;
/// invalid_parameters at /17 or /17/1 for a NaN, an infinity, or a point outside the domain; degenerate_input
/// at /17 for a point that repeats an earlier one or is nearer to it than nearest_distance. Errors also:
/// cancelled, deadline_exceeded. Cost: O(n) for even sets, O(n log n) for any.
void require_usable(const PointSet& points, const Control& control);

}  // namespace wellspaced

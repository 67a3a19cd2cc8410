#include "core/generate/jittered.h"

#include <algorithm>
#include <cmath>

#include "core/domain/sphere.h"
#include "core/domain/torus.h"
#include "core/generate/equal_parts.h"
#include "core/math.h"

namespace wellspaced {
namespace {

PointSet jittered_rectangle(const std::shared_ptr<const Domain>& domain, std::uint64_t count, Rng& rng,
                            Control& control) {
  const Box box = domain->box();
  const double width = box.size.x, height = box.size.y, n = static_cast<double>(count);
  const double rows = std::clamp(std::floor(std::sqrt(n * height / width) + 0.5), 1.0, n);
  // Rows end after that many strata: a part of the height as large as their part of the count.
  const auto end_of = [&](double row) { return std::floor(row * n / rows); };
  // Along a bounded axis a point is not on the boundary.
  const auto within = [](double x, double side, bool periodic) {
    return periodic ? wrap(x, side) : std::clamp(x, std::nextafter(0.0, 1.0), std::nextafter(side, 0.0));
  };
  PointSet points{domain, {}};
  points.coordinates.reserve(2 * count);
  for (double row = 0; row < rows; ++row) {
    const double begin = end_of(row), columns = (row + 1 < rows ? end_of(row + 1) : n) - begin;
    for (double column = 0; column < columns; ++column) {
      if (points.size() % 65536 == 0) control.check();
      const double x = (column + rng.uniform()) * width / columns;
      const double y = (begin + rng.uniform() * columns) * height / n;
      points.push_back({within(x, width, box.periodic[0]), within(y, height, box.periodic[1]), 0});
    }
  }
  return points;
}

/// From the north pole down; area goes with height.
PointSet jittered_sphere(const std::shared_ptr<const Domain>& domain, std::uint64_t count, Rng& rng,
                         Control& control) {
  const double radius = domain->box().size.x / 2, n = static_cast<double>(count);
  const double rows = std::clamp(std::floor(std::sqrt(n * pi / 4) + 0.5), 1.0, n);
  const auto end_of = [&](double row) {
    return std::floor(n * (1 - portable_cos_sin(row / rows / 2).cos) / 2 + 0.5);
  };
  PointSet points{domain, {}};
  points.coordinates.reserve(3 * count);
  for (double row = 0; row < rows; ++row) {
    const double begin = end_of(row), columns = (row + 1 < rows ? end_of(row + 1) : n) - begin;
    for (double column = 0; column < columns; ++column) {
      if (points.size() % 65536 == 0) control.check();
      const double z = 1 - 2 * (begin + rng.uniform() * columns) / n;
      const CosSin turn = portable_cos_sin((column + rng.uniform()) / columns);
      const double across = std::sqrt(std::max(0.0, 1 - z * z));
      const Vec3 p{across * turn.cos, across * turn.sin, z};
      points.push_back((radius / norm(p)) * p);
    }
  }
  return points;
}

}  // namespace

PointSet jittered(const std::shared_ptr<const Domain>& domain, std::uint64_t count, Rng& rng,
                  Control& control) {
  if (domain->type() == "torus" || domain->type() == "box")
    return jittered_rectangle(domain, count, rng, control);
  if (domain->type() == "sphere") return jittered_sphere(domain, count, rng, control);
  return one_in_each_part(domain, count, rng, control);
}

}  // namespace wellspaced

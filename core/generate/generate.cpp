#include "core/generate/generate.h"

#include <algorithm>
#include <cmath>

#include "core/vec.h"

namespace wellspaced {

double poisson_disk_radius(double area, std::uint64_t count) {
  return std::sqrt(poisson_disk_constant * area / static_cast<double>(count));
}

double radius_for_count(const Domain& domain, double count) {
  const Vec3 size = domain.box().size;
  constexpr double parking = 0.7476;  // Renyi's constant: n r of a line's length
  // Two at least: a radius of half the diagonal leaves a gap of no size, which takes long to rule out on a
  // thin torus.
  const double on_line = parking * std::max(size.x, size.y) / std::max(2.0, count);
  const double on_plane = std::sqrt(poisson_disk_constant * domain.area() / count);
  return std::min(std::max(on_plane, on_line), norm(size) / 2);
}

double poisson_disk_count(double area, double radius) {
  return poisson_disk_constant * area / (radius * radius);
}

}  // namespace wellspaced

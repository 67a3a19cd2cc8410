#include "core/generate/generate.h"

#include <cmath>

namespace wellspaced {

double poisson_disk_radius(double area, std::uint64_t count) {
  return std::sqrt(poisson_disk_constant * area / static_cast<double>(count));
}

double poisson_disk_count(double area, double radius) {
  return poisson_disk_constant * area / (radius * radius);
}

}  // namespace wellspaced

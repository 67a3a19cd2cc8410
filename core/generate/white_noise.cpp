#include "core/generate/white_noise.h"

#include <utility>

namespace wellspaced {

PointSet white_noise(std::shared_ptr<const Domain> domain, std::uint64_t count, Rng& rng, Control& control) {
  PointSet points{std::move(domain), {}};
  points.coordinates.reserve(count * static_cast<std::size_t>(points.domain->dimension()));
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i % 65536 == 0) control.check();
    points.push_back(points.domain->random_point(rng));
  }
  return points;
}

}  // namespace wellspaced

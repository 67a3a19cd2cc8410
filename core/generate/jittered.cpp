#include "core/generate/jittered.h"

#include <algorithm>
#include <cmath>

namespace wellspaced {

PointSet jittered(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Rng& rng,
                  Control& control) {
  const auto n = static_cast<double>(count);
  const double rows = std::clamp(std::floor(std::sqrt(n * torus->height() / torus->width()) + 0.5), 1.0, n);
  // Rows end after that many strata: a part of the height as large as their part of the count.
  const auto end_of = [&](double row) { return std::floor(row * n / rows); };
  PointSet points{torus, {}};
  points.coordinates.reserve(2 * count);
  for (double row = 0; row < rows; ++row) {
    const double begin = end_of(row), columns = (row + 1 < rows ? end_of(row + 1) : n) - begin;
    for (double column = 0; column < columns; ++column) {
      if (points.size() % 65536 == 0) control.check();
      const double x = (column + rng.uniform()) * torus->width() / columns;
      const double y = (begin + rng.uniform() * columns) * torus->height() / n;
      points.push_back({wrap(x, torus->width()), wrap(y, torus->height()), 0});
    }
  }
  return points;
}

}  // namespace wellspaced

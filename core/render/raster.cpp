#include "core/render/raster.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace wellspaced {
namespace {

/// How much of each old place a new one covers.
struct Cover {
  std::size_t first = 0;
  std::vector<double> weights;
};

std::vector<Cover> covers(double low, double high, std::size_t places, std::size_t old_places) {
  std::vector<Cover> all(places);
  const double step = (high - low) / static_cast<double>(places);
  for (std::size_t i = 0; i < places; ++i) {
    const double from = low + static_cast<double>(i) * step, to = from + step;
    const auto last_place = static_cast<double>(old_places - 1);
    const auto first = static_cast<std::size_t>(std::clamp(std::floor(from), 0.0, last_place));
    const auto last =
        static_cast<std::size_t>(std::clamp(std::ceil(to) - 1, static_cast<double>(first), last_place));
    all[i].first = first;
    double sum = 0;
    for (std::size_t k = first; k <= last; ++k) {
      const auto at = static_cast<double>(k);
      all[i].weights.push_back(std::max(0.0, std::min(to, at + 1) - std::max(from, at)));
      sum += all[i].weights.back();
    }
    for (double& weight : all[i].weights) weight = sum > 0 ? weight / sum : 1;
  }
  return all;
}

}  // namespace

Raster resampled(const Raster& raster, double x0, double x1, double y0, double y1, std::size_t columns,
                 std::size_t rows) {
  const std::vector<Cover> across = covers(x0, x1, columns, raster.columns),
                           down = covers(y0, y1, rows, raster.rows);
  Raster result{columns, rows, std::vector<double>(columns * rows)};
  std::vector<double> line(raster.columns);
  for (std::size_t y = 0; y < rows; ++y) {
    std::fill(line.begin(), line.end(), 0.0);
    for (std::size_t k = 0; k < down[y].weights.size(); ++k)
      for (std::size_t x = 0; x < raster.columns; ++x)
        line[x] += down[y].weights[k] * raster.values[(down[y].first + k) * raster.columns + x];
    for (std::size_t x = 0; x < columns; ++x)
      for (std::size_t k = 0; k < across[x].weights.size(); ++k)
        result.values[y * columns + x] += across[x].weights[k] * line[across[x].first + k];
  }
  return result;
}

Image colored(const Raster& raster, ColorMap map, double low, double high) {
  Image image{raster.columns, raster.rows, {}};
  image.rgb.reserve(3 * raster.values.size());
  for (const double value : raster.values) {
    const Rgb color = color_at(map, std::isfinite(value) ? (value - low) / (high - low) : 0);
    for (const double channel : {color.r, color.g, color.b})
      image.rgb.push_back(static_cast<std::uint8_t>(channel + 0.5));
  }
  return image;
}

}  // namespace wellspaced

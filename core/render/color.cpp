#include "core/render/color.h"

#include <algorithm>

namespace wellspaced {

Rgb color_at(ColorMap map, double t) {
  const double place = (t > 0 ? std::min(t, 1.0) : 0) * static_cast<double>(map.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), map.size() - 2);
  const double s = place - static_cast<double>(k);
  const Rgb &a = map[k], &b = map[k + 1];
  return {a.r + s * (b.r - a.r), a.g + s * (b.g - a.g), a.b + s * (b.b - a.b)};
}

Rgb color_of_class(std::size_t k) {
  constexpr std::array<Rgb, 7> classes = {
      {{0, 114, 178}, {213, 94, 0}, {0, 140, 102}, {180, 90, 150}, {0, 0, 0}, {70, 165, 215}, {215, 145, 0}}};
  return classes[k % classes.size()];
}

double dash_px_of_class(std::size_t k) {
  constexpr std::array<double, 3> dashes = {0, 7, 2.2};
  return dashes[k / 7 % dashes.size()];
}

}  // namespace wellspaced

#include "core/analyze/ranked_points.h"

#include <tuple>

#include "core/sort.h"

namespace wellspaced {
namespace {

struct Place {
  double at;
  std::uint32_t id;
};

}  // namespace

RankedPoints rank_points(const PointSet& points, const Control& control) {
  constexpr std::size_t between_checks = 1 << 16;
  const std::size_t n = points.size();
  const Vec3 sides = points.domain->box().size;
  LargeVector<Place> by_y(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i % between_checks == 0) control.check();
    by_y[i] = {points[i].y / sides.y, static_cast<std::uint32_t>(i)};
  }
  sort(by_y.begin(), by_y.end(), control,
       [](const Place& a, const Place& b) { return std::tie(a.at, a.id) < std::tie(b.at, b.id); });
  RankedPoints ranked;
  LargeVector<std::uint32_t> level(n);
  ranked.sorted_y.reserve(n);
  for (const auto& [y, id] : by_y) {
    if (ranked.sorted_y.size() % between_checks == 0) control.check();
    if (ranked.levels.empty() || y > ranked.levels.back()) ranked.levels.push_back(y);
    level[id] = static_cast<std::uint32_t>(ranked.levels.size() - 1);
    ranked.sorted_y.push_back(y);
  }
  LargeVector<Place> by_x(n);
  for (std::size_t k = 0; k < n; ++k) {
    if (k % between_checks == 0) control.check();
    by_x[k] = {points[by_y[k].id].x / sides.x, static_cast<std::uint32_t>(k)};
  }
  sort(by_x.begin(), by_x.end(), control,
       [](const Place& a, const Place& b) { return std::tie(a.at, a.id) < std::tie(b.at, b.id); });
  for (std::size_t k = 0; k < n; ++k) {
    if (k % between_checks == 0) control.check();
    ranked.x.push_back(by_x[k].at);
    ranked.y.push_back(by_y[by_x[k].id].at);
    ranked.level.push_back(level[by_y[by_x[k].id].id]);
  }
  return ranked;
}

}  // namespace wellspaced

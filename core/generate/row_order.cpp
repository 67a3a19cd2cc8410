#include "core/generate/row_order.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "core/sort.h"

namespace wellspaced {
namespace {

class RowKey {
 public:
  RowKey(const Box& box, double radius)
      : low_(box.low),
        columns_(background_cells(box.size.x, radius)),
        rows_(background_cells(box.size.y, radius)),
        width_(box.size.x / static_cast<double>(columns_)),
        height_(box.size.y / static_cast<double>(rows_)) {}

  std::int64_t operator()(Vec3 p) const {
    return cell(p.y - low_.y, height_, rows_) * columns_ + cell(p.x - low_.x, width_, columns_);
  }

 private:
  static std::int64_t cell(double x, double side, std::int64_t cells) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(x / side), 0, cells - 1);
  }

  Vec3 low_;
  std::int64_t columns_, rows_;
  double width_, height_;
};

}  // namespace

std::int64_t background_cells(double length, double radius) {
  return static_cast<std::int64_t>(std::ceil(length * std::sqrt(2.0) / radius * (1 + 1e-12)));
}

void bring_into_rows(PointSet& points, std::size_t sorted, double radius, const Control& control) {
  const RowKey key(points.domain->box(), radius);
  std::vector<std::pair<std::int64_t, std::size_t>> late;
  for (std::size_t i = sorted; i < points.size(); ++i) {
    if (i % 65536 == 0) control.check();
    late.push_back({key(points[i]), i});
  }
  sort(late.begin(), late.end(), control, std::less<>());
  PointSet merged{points.domain, {}};
  merged.coordinates.reserve(points.coordinates.size());
  auto next = late.begin();
  for (std::size_t i = 0; i < sorted; ++i) {
    if (i % 65536 == 0) control.check();
    for (; next != late.end() && next->first < key(points[i]); ++next) merged.push_back(points[next->second]);
    merged.push_back(points[i]);
  }
  for (; next != late.end(); ++next) merged.push_back(points[next->second]);
  points.coordinates = std::move(merged.coordinates);
}

void sort_into_rows(PointSet& points, double radius, const Control& control) {
  const Box box = points.domain->box();
  const double side = radius / std::sqrt(2.0);
  std::vector<std::tuple<double, double, double, std::size_t>> keys(points.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Vec3 p = points[i] - box.low;
    keys[i] = {std::floor(p.z / side), std::floor(p.y / side), std::floor(p.x / side), i};
  }
  sort(keys.begin(), keys.end(), control, std::less<>());
  PointSet sorted{points.domain, {}};
  sorted.coordinates.reserve(points.coordinates.size());
  for (const auto& key : keys) sorted.push_back(points[std::get<3>(key)]);
  points.coordinates = std::move(sorted.coordinates);
}

}  // namespace wellspaced

#include "core/domain/star_region.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math.h"

namespace wellspaced {
namespace {

constexpr double widest = pi / 3;   ///< of a triangle whose far side is out of reach
constexpr double far = 2;           ///< reaches to its corners
constexpr double no_angle = 1e-9;   ///< radians
constexpr double no_height = 1e-8;  ///< of a triangle, in reaches

/// The angles that a view covers, counter-clockwise.
struct Sector {
  double begin, end;
};

double angle_of(Vec2 v) { return portable_atan2(v.y, v.x); }

void add_triangle(Vec2 a, Vec2 b, Vec2 c, ChartPieces& out) {
  out.corners.insert(out.corners.end(), {a, b, c});
  out.close();
}

/// Nothing is in the way here.
void add_sector(Vec2 apex, Sector sector, double radius, ChartPieces& out) {
  const double angle = sector.end - sector.begin;
  if (angle <= no_angle) return;
  const int parts = static_cast<int>(std::ceil(angle / widest));
  const auto at = [&](int k) {
    const CosSin turn = portable_cos_sin((sector.begin + angle * k / parts) / (2 * pi));
    return apex + radius * Vec2{turn.cos, turn.sin};
  };
  for (int k = 0; k < parts; ++k) add_triangle(apex, at(k), at(k + 1), out);
}

}  // namespace

ChartPieces star_region(Vec2 apex, std::span<const BorderView> views, double reach) {
  ChartPieces out;
  std::vector<Sector> sectors;
  for (const auto& [right, left] : views) {
    const double area = cross(right - apex, left - apex);
    if (area > no_height * reach * norm(left - right)) add_triangle(apex, right, left, out);
    const double begin = angle_of(right - apex), end = angle_of(left - apex);
    sectors.push_back({begin, end < begin ? end + 2 * pi : end});
  }
  std::sort(sectors.begin(), sectors.end(), [](Sector a, Sector b) { return a.begin < b.begin; });
  if (sectors.empty()) sectors.push_back({-pi, -pi});
  for (std::size_t k = 0; k < sectors.size(); ++k) {
    const double next = k + 1 < sectors.size() ? sectors[k + 1].begin : sectors[0].begin + 2 * pi;
    add_sector(apex, {sectors[k].end, next}, far * reach, out);
  }
  return out;
}

}  // namespace wellspaced

#include "core/analyze/spacing_star.h"

#include <algorithm>
#include <cmath>
#include <limits>

#ifndef WELLSPACED_SPACING_STAR
#define WELLSPACED_SPACING_STAR
namespace wellspaced {

/// Eight spokes and the one after them; those past the last one of the star go on from the first one.
struct SpokeRow {
  static constexpr std::size_t places = 8;
  alignas(64) double x[places + 1], y[places + 1];
  alignas(64) double own[places];  ///< infinite for an image of the point itself, else 0

  SpokeRow(std::size_t i, std::span<const Spoke> spokes, std::size_t first) {
    for (std::size_t k = 0, s = first; k <= places; ++k, s = s + 1 == spokes.size() ? 0 : s + 1) {
      x[k] = spokes[s].offset.x;
      y[k] = spokes[s].offset.y;
      if (k < places) own[k] = spokes[s].id == i ? std::numeric_limits<double>::infinity() : 0;
    }
  }
};

}  // namespace wellspaced
#endif

// This file is compiled once for every kind of vector unit; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/analyze/spacing_star.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Twice the area of the cell, corner after corner.
class TwiceArea {
 public:
  void add(const double* x, const double* y, std::size_t n) {
    if (first_) last_ = start_ = {x[0], y[0]};
    for (std::size_t k = first_ ? 1 : 0; k < n; ++k) {
      const Vec2 next{x[k], y[k]};
      sum_ += cross(last_, next);
      last_ = next;
    }
    first_ = false;
  }
  double closed() const { return sum_ + cross(last_, start_); }

 private:
  bool first_ = true;
  Vec2 start_, last_;
  double sum_ = 0;
};

StarMeasure measure_star_here(std::size_t i, std::span<const Spoke> spokes) {
  const hn::CappedTag<double, SpokeRow::places> d;
  const auto never = hn::Set(d, std::numeric_limits<double>::infinity());
  auto nearest2 = never, least = never;
  auto edge2 = hn::Zero(d), outradius2 = hn::Zero(d), most = hn::Neg(never);
  TwiceArea twice_area;
  for (std::size_t first = 0; first < spokes.size(); first += SpokeRow::places) {
    const SpokeRow row(i, spokes, first);
    alignas(64) double corner_x[SpokeRow::places], corner_y[SpokeRow::places];
    for (std::size_t k = 0; k < SpokeRow::places; k += hn::Lanes(d)) {
      const auto ax = hn::Load(d, row.x + k), ay = hn::Load(d, row.y + k);
      const auto bx = hn::LoadU(d, row.x + k + 1), by = hn::LoadU(d, row.y + k + 1);
      const auto a2 = hn::Add(hn::Mul(ax, ax), hn::Mul(ay, ay));
      const auto b2 = hn::Add(hn::Mul(bx, bx), hn::Mul(by, by));
      nearest2 = hn::Min(nearest2, hn::Add(a2, hn::Load(d, row.own + k)));
      edge2 = hn::Max(edge2, a2);
      const auto area = hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
      const auto inverse = hn::Div(hn::Set(d, 1), area), scale = hn::Mul(hn::Set(d, 0.5), inverse);
      const auto x = hn::Mul(scale, hn::Sub(hn::Mul(by, a2), hn::Mul(ay, b2)));
      const auto y = hn::Mul(scale, hn::Sub(hn::Mul(ax, b2), hn::Mul(bx, a2)));
      hn::Store(x, d, corner_x + k);
      hn::Store(y, d, corner_y + k);
      outradius2 = hn::Max(outradius2, hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
      // All three angles, though a neighbor sees its own: among cocircular points it may see another
      // triangle.
      const auto ex = hn::Sub(bx, ax), ey = hn::Sub(by, ay);
      const auto center = hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by));
      const auto at_a = hn::Neg(hn::Add(hn::Mul(ax, ex), hn::Mul(ay, ey)));
      const auto at_b = hn::Add(hn::Mul(bx, ex), hn::Mul(by, ey));
      most = hn::Max(most, hn::Mul(hn::Max(center, hn::Max(at_a, at_b)), inverse));
      least = hn::Min(least, hn::Mul(hn::Min(center, hn::Min(at_a, at_b)), inverse));
    }
    twice_area.add(corner_x, corner_y, std::min(SpokeRow::places, spokes.size() - first));
  }
  return {std::sqrt(hn::GetLane(hn::MinOfLanes(d, nearest2))),
          std::sqrt(hn::GetLane(hn::MaxOfLanes(d, outradius2))),
          0.5 * twice_area.closed(),
          std::sqrt(hn::GetLane(hn::MaxOfLanes(d, edge2))),
          hn::GetLane(hn::MaxOfLanes(d, most)),
          hn::GetLane(hn::MinOfLanes(d, least)),
          static_cast<int>(spokes.size())};
}

}  // namespace
}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wellspaced {

HWY_EXPORT(measure_star_here);

StarMeasure measure_star(std::size_t i, std::span<const Spoke> spokes) {
  return HWY_DYNAMIC_DISPATCH(measure_star_here)(i, spokes);
}

void require_whole(double cell_areas, double area) {
  if (!(std::fabs(cell_areas - area) <= 1e-5 * area)) throw hidden_triangles();
}

}  // namespace wellspaced
#endif  // HWY_ONCE

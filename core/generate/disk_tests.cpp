#include "core/generate/disk_tests.h"

// This file is compiled once for every kind of vector unit; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/generate/disk_tests.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, CellWindow::readable_beyond>;

bool any_within_here(const CellWindow& window, Vec2 p, double radius2) {
  const Doubles d;
  const auto px = hn::Set(d, p.x), py = hn::Set(d, p.y), limit = hn::Set(d, radius2);
  for (std::size_t row = 0; row < window.rows; ++row) {
    const double *x = window.x + row * window.stride, *y = window.y + row * window.stride;
    for (std::size_t k = 0; k < window.columns; k += hn::Lanes(d)) {
      const auto dx = hn::Sub(hn::LoadU(d, x + k), px), dy = hn::Sub(hn::LoadU(d, y + k), py);
      const auto near = hn::Lt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), limit);
      if (!hn::AllFalse(d, near)) return true;
    }
  }
  return false;
}

std::uint32_t covered_quarters_here(const CellWindow& window, const Quarters& q, double radius2) {
  const Doubles d;
  const auto x0 = hn::Set(d, q.center_x[0]), x1 = hn::Set(d, q.center_x[1]);
  const auto y0 = hn::Set(d, q.center_y[0]), y1 = hn::Set(d, q.center_y[1]);
  const auto half_x = hn::Set(d, q.half.x), half_y = hn::Set(d, q.half.y), limit = hn::Set(d, radius2);
  std::uint32_t covered = 0;
  for (std::size_t row = 0; row < window.rows; ++row) {
    const double *x = window.x + row * window.stride, *y = window.y + row * window.stride;
    for (std::size_t k = 0; k < window.columns; k += hn::Lanes(d)) {
      const auto sample_x = hn::LoadU(d, x + k), sample_y = hn::LoadU(d, y + k);
      const auto far_x0 = hn::Add(hn::Abs(hn::Sub(sample_x, x0)), half_x);
      const auto far_x1 = hn::Add(hn::Abs(hn::Sub(sample_x, x1)), half_x);
      const auto far_y0 = hn::Add(hn::Abs(hn::Sub(sample_y, y0)), half_y);
      const auto far_y1 = hn::Add(hn::Abs(hn::Sub(sample_y, y1)), half_y);
      const auto xx0 = hn::Mul(far_x0, far_x0), xx1 = hn::Mul(far_x1, far_x1);
      const auto yy0 = hn::Mul(far_y0, far_y0), yy1 = hn::Mul(far_y1, far_y1);
      const auto hit = [&](auto xx, auto yy) {
        return hn::AllFalse(d, hn::Lt(hn::Add(xx, yy), limit)) ? 0u : 1u;
      };
      covered |= hit(xx0, yy0) | hit(xx1, yy0) << 1 | hit(xx0, yy1) << 2 | hit(xx1, yy1) << 3;
    }
    if (covered == 15) break;
  }
  return covered;
}

}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wellspaced {

HWY_EXPORT(any_within_here);
HWY_EXPORT(covered_quarters_here);

bool any_within(const CellWindow& window, Vec2 p, double radius2) {
  return HWY_DYNAMIC_DISPATCH(any_within_here)(window, p, radius2);
}

std::uint32_t covered_quarters(const CellWindow& window, const Quarters& quarters, double radius2) {
  return HWY_DYNAMIC_DISPATCH(covered_quarters_here)(window, quarters, radius2);
}

}  // namespace wellspaced
#endif  // HWY_ONCE

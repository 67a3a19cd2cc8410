#include "core/generate/dart_loops.h"

#include <array>

// This file is compiled once for every kind of vector unit; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/generate/dart_loops.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, CellWindow::readable_beyond>;

HWY_INLINE bool within(const CellWindow& window, Vec2 p, double radius2) {
  const Doubles d;
  const auto px = hn::Set(d, p.x), py = hn::Set(d, p.y), limit = hn::Set(d, radius2);
  auto near = hn::FirstN(d, 0);
  for (std::size_t row = 0; row < window.rows; ++row) {
    const double *x = window.x + row * window.stride, *y = window.y + row * window.stride;
    for (std::size_t k = 0; k < window.columns; k += hn::Lanes(d)) {
      const auto dx = hn::Sub(hn::LoadU(d, x + k), px), dy = hn::Sub(hn::LoadU(d, y + k), py);
      near = hn::Or(near, hn::Lt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), limit));
    }
  }
  return !hn::AllFalse(d, near);
}

bool any_within_here(const CellWindow& window, Vec2 p, double radius2) { return within(window, p, radius2); }

void throw_darts_here(SampleGrid& grid, std::span<const Dart> darts) {
  for (const Dart& dart : darts)
    if (!grid.taken(dart.i, dart.j) && !within(grid.window(dart.i, dart.j), dart.at, grid.coverage2()))
      grid.put(dart.i, dart.j, dart.at);
}

/// Four (or two, or one, if centers repeat) rectangles of the same size.
struct Parts {
  std::array<double, 2> center_x, center_y;
  Vec2 half;
};

/// Which of them are covered, whole, by the disk of a single sample: bit 2 b + a for that at center_x[a],
/// center_y[b].
HWY_INLINE std::uint32_t covered(const CellWindow& window, const Parts& parts, double radius2) {
  const Doubles d;
  const auto x0 = hn::Set(d, parts.center_x[0]), x1 = hn::Set(d, parts.center_x[1]);
  const auto y0 = hn::Set(d, parts.center_y[0]), y1 = hn::Set(d, parts.center_y[1]);
  const auto half_x = hn::Set(d, parts.half.x), half_y = hn::Set(d, parts.half.y),
             limit = hn::Set(d, radius2);
  auto m00 = hn::FirstN(d, 0), m10 = m00, m01 = m00, m11 = m00;
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
      m00 = hn::Or(m00, hn::Lt(hn::Add(xx0, yy0), limit));
      m10 = hn::Or(m10, hn::Lt(hn::Add(xx1, yy0), limit));
      m01 = hn::Or(m01, hn::Lt(hn::Add(xx0, yy1), limit));
      m11 = hn::Or(m11, hn::Lt(hn::Add(xx1, yy1), limit));
    }
  }
  const auto any = [&](auto mask) { return hn::AllFalse(d, mask) ? 0u : 1u; };
  return any(m00) | any(m10) << 1 | any(m01) << 2 | any(m11) << 3;
}

template <class Index>
HWY_INLINE void halve_all(const SampleGrid& grid, std::span<const PartCell<Index>> cells, const Level& from,
                          const Level& to, double coverage2, std::vector<PartCell<Index>>& next) {
  const unsigned across_x = to.x > from.x ? 1 : 0, across_y = to.y > from.y ? 1 : 0;
  const Vec2 side = to.side, half{0.5 * to.side.x, 0.5 * to.side.y};
  std::size_t end = next.size();
  next.resize(end + 4 * cells.size());
  for (const PartCell<Index> c : cells) {
    const auto i = static_cast<std::int64_t>(c.i >> from.x), j = static_cast<std::int64_t>(c.j >> from.y);
    if (grid.taken(i, j)) continue;
    const Index left = c.i << across_x, low = c.j << across_y;
    const auto x = static_cast<double>(left), y = static_cast<double>(low);
    const Parts parts{{(x + 0.5) * side.x, (x + across_x + 0.5) * side.x},
                      {(y + 0.5) * side.y, (y + across_y + 0.5) * side.y},
                      half};
    const std::uint32_t full = covered(grid.window(i, j), parts, coverage2);
    for (unsigned b = 0; b <= across_y; ++b)
      for (unsigned a = 0; a <= across_x; ++a) {
        next[end] = {left + a, low + b};  // counts only if it is not covered
        end += 1 - (full >> (2 * b + a) & 1);
      }
  }
  next.resize(end);
}

void halve_active(const SampleGrid& grid, std::span<const ActiveCell> cells, const Level& from,
                  const Level& to, double coverage2, std::vector<ActiveCell>& next) {
  halve_all(grid, cells, from, to, coverage2, next);
}

void halve_deep(const SampleGrid& grid, std::span<const DeepCell> cells, const Level& from, const Level& to,
                double coverage2, std::vector<DeepCell>& next) {
  halve_all(grid, cells, from, to, coverage2, next);
}

}  // namespace
}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wellspaced {

HWY_EXPORT(any_within_here);
HWY_EXPORT(throw_darts_here);
HWY_EXPORT(halve_active);
HWY_EXPORT(halve_deep);

bool any_within(const CellWindow& window, Vec2 p, double radius2) {
  return HWY_DYNAMIC_DISPATCH(any_within_here)(window, p, radius2);
}

void throw_darts(SampleGrid& grid, std::span<const Dart> darts) {
  HWY_DYNAMIC_DISPATCH(throw_darts_here)(grid, darts);
}

void halve(const SampleGrid& grid, std::span<const ActiveCell> cells, const Level& from, const Level& to,
           double coverage2, std::vector<ActiveCell>& next) {
  HWY_DYNAMIC_DISPATCH(halve_active)(grid, cells, from, to, coverage2, next);
}

void halve(const SampleGrid& grid, std::span<const DeepCell> cells, const Level& from, const Level& to,
           double coverage2, std::vector<DeepCell>& next) {
  HWY_DYNAMIC_DISPATCH(halve_deep)(grid, cells, from, to, coverage2, next);
}

}  // namespace wellspaced
#endif  // HWY_ONCE

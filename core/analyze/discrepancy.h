#pragma once

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// How far the share of samples in boxes is from the boxes' area, coordinates divided by the torus's sides.
/// The less, the better the set integrates; about n^(-1/2) for white noise.
struct Discrepancy {
  /// Star discrepancy D*: the largest |samples in the box / n - x y| of all boxes [0, x) x [0, y) and
  /// [0, x] x [0, y]. Depends on where the origin is.
  double star = 0;
  /// L2 star discrepancy: the root of the mean square of the same over x and y. Depends on where the origin
  /// is.
  double l2_star = 0;
  /// Hickernell's wrap-around L2 discrepancy: the root of the sum of mean squares over boxes [x', x) x
  /// [y', y), and intervals of one coordinate alone, all of which go around the torus. Translations do not
  /// change it.
  double l2_periodic = 0;
};

/// Guarantees
/// 1. star is exact up to 1e-15, whatever coordinates coincide.
/// 2. The squares of l2_star and l2_periodic are exact up to 1e-17 and the last bit.
///
/// Both are roots. scipy.stats.qmc.discrepancy returns the square of l2_periodic for method "WD", but l2_star
/// itself for "L2-star".
///
/// Requires: finite points in their domain, a torus. Errors: degenerate_input without points; cancelled,
/// deadline_exceeded. Cost: O(n log n), star O(n log^3 n) at worst; 3 us and 260 bytes a point at a million;
/// on up to three threads. Determinism: the same bits on any number of threads. Reference: Niederreiter,
/// "Discrepancy and Convex Programming", 1972 (star); Warnock, "Computational investigations of
/// low-discrepancy point sets", 1972 (l2_star); Hickernell, "Lattice rules: how well do they measure up?",
/// 1998 (l2_periodic).
Discrepancy discrepancy(const PointSet& points, const Control& control);

}  // namespace wellspaced

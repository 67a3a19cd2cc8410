#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/control.h"
#include "core/point_set.h"
#include "core/vec.h"

namespace wellspaced {

/// The function of the aliasing test: rings around the corner (0, 0) that get finer outwards,
/// f = (1 + cos(pi k rho^2)) / 2 with rho the distance from the corner in units of the domain's width. At rho
/// its frequency is k rho cycles a width.
struct ZonePlateField {
  double width = 1;  ///< of the domain
  double k = 0;      ///< cycles a width at rho = 1; at least 0

  double at(Vec2 p) const;

  /// f blurred by a Gaussian of standard deviation `sigma` (in domain lengths) over the whole plane: what
  /// endlessly many samples give. With a = pi k, s = sigma / width and c = 2 a s^2, each axis gives the
  /// complex Gaussian integral E exp(i a (x + s Z)^2) = (1 - i c)^(-1/2) exp(i a x^2 / (1 - i c)), and both
  /// together
  ///
  ///   (1 + exp(-a c rho^2 / (1 + c^2)) (cos t - c sin t) / (1 + c^2)) / 2,  t = a rho^2 / (1 + c^2).
  double blurred(Vec2 p, double sigma) const;
};

/// Lengths are in units of the mean sample spacing h = sqrt(area / n).
struct ZonePlateOptions {
  /// Pixels across, 1 to most_columns, at most largest_pixels in all; nothing: width / h of them, one a
  /// sample, and as many as are allowed at most.
  std::optional<int> columns;
  /// The field's frequency at a width's distance from the corner, cycles a spacing, 0 to 16. A square grid
  /// can carry .5: with that its limit is reached at the end of the lower edge, and exceeded towards the
  /// opposite corner.
  double frequency = 0.5;
  double sigma = 0.5;  ///< standard deviation of the filter, spacings, .01 to 8

  static constexpr int most_columns = 4096;
  static constexpr std::size_t largest_pixels = std::size_t{1} << 24;
};

/// Shapes: `pixels` is row-major, row 0 at y = 0 and upwards, as coordinates are and images mostly aren't;
/// pixel (column, row) is centered on ((column + 1/2) width / columns, (row + 1/2) height / rows). Values in
/// [0, 1], up to rounding.
struct ZonePlate {
  std::size_t columns = 0, rows = 0;
  std::vector<double> pixels;
  /// Root mean square difference from the field blurred by the filter, which is aliasing and noise. Over the
  /// pixels at least 3 sigma from all sides, for the others see but one side; over all if there are no such.
  double rmse = 0;
};

/// The field as the samples show it: each pixel is the mean of f at the samples within 3 sigma of its
/// center, weighted by exp(-d^2 / (2 sigma^2)) and normalized. Where there are none, the reach is widened to
/// the nearest sample, and the pixel is f there (of several, at the first). Samples are not repeated beyond
/// the sides, since f isn't periodic: pixels at the border see those on one side only.
///
/// Guarantees: what is measured is the samples' doing, but for the Gaussian's being cut at 3 sigma, which
/// leaves an rmse of about .002 however many samples there are. Requires: a torus; finite points in it.
/// Errors: invalid_parameters at /columns, /frequency, /sigma; degenerate_input without points; cancelled,
/// deadline_exceeded. Cost: a tree of the points, and about .5 us a pixel and 25 ns for each sample in its
/// reach, 28 sigma^2 of them: .13 s for 122,500 samples and pixels; pixels far from all samples cost O(log
/// n). Determinism: the same bits on any number of threads. Reference: Mitchell and Netravali,
/// "Reconstruction Filters in Computer Graphics", 1988, for zone plates; Lagae and Dutre, "A Comparison of
/// Methods for Generating Poisson Disk Distributions", 2008.
ZonePlate zone_plate(const PointSet& points, const ZonePlateOptions& options, const Control& control);

/// What zone_plate refuses of its options for so many points. Errors: invalid_parameters at /columns,
/// /frequency, /sigma.
void require_options(const ZonePlateOptions& options, const Domain& domain, std::size_t n);

/// The field that `zone_plate` shows with `n` samples.
ZonePlateField zone_plate_field(const Domain& domain, std::size_t n, double frequency);

}  // namespace wellspaced

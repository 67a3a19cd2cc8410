#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// Lengths are in d_hex of the equivalent uniform set, see `differential_domain`.
struct DifferentialOptions {
  double reach = 4;  ///< the image covers [-reach, reach]^2; 1 to 16
  int pixels = 257;  ///< across, odd, 3 to 1025
  /// Standard deviation of the kernel, reach / 256 to reach / 4. The default is a 15th of the hole's radius
  /// in maximal Poisson-disk sets (rho = .777), so that its edge stays sharp, and 1.6 of the default pixels,
  /// which show it without aliasing. White noise of 1000 points then scatters by .17 a pixel.
  double sigma = 0.05;
};

/// What differential_domain refuses of its options. Errors: invalid_parameters at /reach, /pixels, /sigma.
void require_options(const DifferentialOptions& options);

/// The density of differences between samples, 1 for white noise.
///
/// Shapes: `density` is row-major, size x size, row 0 at the bottom; pixel (column, row) is at
/// q = (column - (size - 1) / 2, row - (size - 1) / 2) step, with step = 2 reach / size. Elements of `r`,
/// `mean` and `anisotropy_db` are rings of pixels, as far as they are whole: ring k holds those with |q| in
/// [k - 1/2, k + 1/2) step. NaN where a ring has no anisotropy: less than two different pixels, or only
/// zeros.
struct DifferentialDomain {
  double n = 0;  ///< points; the mean number for an average over sets
  int sets = 1;  ///< averaged
  int size = 0;
  double reach = 0, sigma = 0;
  std::vector<double> density;
  std::vector<double> r;              ///< of the rings: k step
  std::vector<double> mean;           ///< over the ring: the radial distribution
  std::vector<double> anisotropy_db;  ///< 10 log10(variance / mean^2) over half of the ring; about
                                      ///< -10 log10(4 pi sigma^2 n sets 2 / sqrt(3)) for white noise

  double at(int column, int row) const {
    return density[static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
                   static_cast<std::size_t>(column)];
  }
};

/// Differential domain analysis: how the samples around a sample lie, for sets that are denser in some
/// places. Every ordered pair of samples s, s' with their radii gives the difference
///
///   d = (s' - s) 2 r_ref / (r(s) + r(s'))
///
/// for the shortest image of s' and all further ones; a sample's own images don't count. The density at q is
/// the sum over pairs of Gaussian(q - d) / ((n - 1) 2 / sqrt(3)).
///
/// Scale. A set made for r has the density c / r^2. Seen through d, around any sample, that is c / r_ref^2,
/// and it is to be 2 / sqrt(3), which is that of the triangular lattice of spacing 1. Since the mean of r_i^2
/// over the samples is the integral of (r^2 c / r^2) / n = c A / n, c = n mean(r_i^2) / A, hence
///
///   r_ref^2 = (sqrt(3) / 2) n mean(r_i^2) / A.
///
/// So only the radii's ratios count, and where all are the same, d = (s' - s) / d_hex, and the density is the
/// two-dimensional pair correlation, `mean` the radial one g(r), both blurred by the kernel. White noise is n
/// independent points of density c / r^2: they give 1, but for terms of second order in how much r changes
/// over the reach. Where r jumps, as a linear sizing does at the seam of a torus, that is not little: one
/// coarse sample there sees many fine ones. A set that does not fill its torus appears shrunk, and the denser
/// for it.
///
/// Guarantees
/// 1. The kernel is a Gaussian to within .5% of its height, its mean right to a thousandth of sigma, its
/// variance too, on average over where differences lie between pixels.
/// 2. The density is symmetric: that at q is that at -q.
/// Requires: a torus; finite points in it. Errors: invalid_parameters at /radii if there are not as many as
/// points, at /radii/17 for one that is not positive and finite, at /reach, /pixels, /sigma; degenerate_input
/// for less than 2 points; cancelled, deadline_exceeded. Cost: O(n reach^2) where radii follow the density,
/// 40 ns an ordered pair: .4 s for 100,000 points; always about as many steps as pairs within reach, whatever
/// the radii. 5 MB by default, and at most 100 MB, besides the points. Determinism: the same bits on any
/// number of threads, since pairs are counted in whole numbers. Reference: Wei and Wang, "Differential Domain
/// Analysis for Non-uniform Sampling", 2011; its d for isotropic sampling, here with a scale and a kernel of
/// unit weight.
DifferentialDomain differential_domain(const PointSet& points, std::span<const double> radii,
                                       const DifferentialOptions& options, const Control& control);

/// The mean of densities, pixel by pixel, and what follows for the rings. Requires: at least one; all of the
/// same size, reach and sigma.
DifferentialDomain average(std::span<const DifferentialDomain> sets);

}  // namespace wellspaced

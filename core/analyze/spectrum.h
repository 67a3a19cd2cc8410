#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/analyze/periodogram.h"

namespace wellspaced {

/// A periodogram by rings of equal frequency. Frequencies are in units of 1/sqrt(area): ring r holds those
/// with |k| in [r - 1/2, r + 1/2), on the unit square |k| = sqrt(kx^2 + ky^2).
///
/// Shapes: element r of `power` and `anisotropy_db` is ring r; element 0 is 0. Only rings that lie within the
/// periodogram's square; NaN where a ring holds nothing (anisotropy: less than two, or only zeros to within
/// the periodogram's error).
struct Spectrum {
  double n = 0;                       ///< points; the mean number for an average over sets
  int sets = 1;                       ///< averaged
  std::vector<double> power;          ///< mean over the ring; 1 for white noise
  std::vector<double> anisotropy_db;  ///< 10 log10(variance / mean^2) over half of the ring; -10 log10(sets)
                                      ///< for sets without any preferred direction
};

/// Whole frequencies that take both axes up to `range` sqrt(n / A), on a torus with sides of that ratio (>=
/// 1).
double k_max_of(double n, double aspect, double range);

/// The periodogram up to `range` sqrt(n / A) along both axes, averaged over the sets frequency by frequency.
/// Requires: at least one; all of one size and on one torus. Errors: invalid_parameters at /range beyond
/// largest_k_max; those of periodogram. Cost: that of a periodogram each; the memory of two results at once.
Periodogram mean_periodogram(std::span<const PointSet> sets, double range, const Control& control);

/// Cost: O(k_max^2). Determinism: sequential. Reference: Ulichney, "Dithering with Blue Noise", 1988, for
/// both measures; Lagae and Dutre, "A Comparison of Methods for Generating Poisson Disk Distributions", 2008.
Spectrum spectrum(const Periodogram& periodogram, int sets = 1);

/// Effective Nyquist frequency / sqrt(n): up to it a set holds nearly no power. With c(v) the mean power
/// below v, the first v from sqrt(n)/2 up where c > .5, and back from there to c < .1. Nothing if the
/// spectrum ends before. Reference: Heck, Schloemer, Deussen, "Blue Noise Sampling with Controlled Aliasing",
/// 2013, section 5.
std::optional<double> effective_nyquist(const Spectrum& spectrum);

/// How far the spectrum swings around white noise's above the first frequency v0 where it comes to .98:
/// 10 sqrt(mean of (P - 1)^2 over |k| in [v0, v0 + 5 sqrt(n)]), the mean by area. Nothing if the spectrum
/// ends before; about 6.2 sqrt(n) suffice. The noise of a single set is in it. Reference: as above.
std::optional<double> oscillations(const Spectrum& spectrum);

/// Mean anisotropy over the rings from .5 to 2.5 sqrt(n), a single ring being noisy. Nothing if the spectrum
/// ends before, or has no power there.
std::optional<double> mean_anisotropy_db(const Spectrum& spectrum);

}  // namespace wellspaced

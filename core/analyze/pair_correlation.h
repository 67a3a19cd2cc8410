#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

struct PairCorrelationOptions {
  static constexpr double largest_reach = 64;
  static constexpr int most_bins = 100000;

  double reach = 8;  ///< up to which distance, in d_hex; in (0, largest_reach]
  int bins = 400;    ///< of equal width, in [1, most_bins]
};

/// How many pairs of samples stand at each distance, relative to white noise: g(r). 0 up to the conflict
/// radius r_f, 1 where nothing is known of one sample from the other.
///
/// Shapes: g[k] is the mean of g over the ring of distances [k, k + 1) * bin.
struct PairCorrelation {
  double n = 0;           ///< points; the mean number for an average over sets
  double area = 1;        ///< of the torus
  double d_hex = 0;       ///< sqrt(2 A / (sqrt(3) n)), domain length; the mean for an average over sets
  double bin = 0;         ///< width of a bin in d_hex
  std::vector<double> g;  ///< one number a bin

  /// Distance in the middle of bin k, in d_hex.
  double middle(std::size_t k) const { return (static_cast<double>(k) + 0.5) * bin; }
  /// How many other samples a sample has in bin k, on the mean: g (n - 1) / A times the ring's area.
  double neighbors(std::size_t k) const;
};

/// g(r) of a point set on a torus.
///
/// Guarantees: every periodic image of every other sample counts whose distance is less than the reach, also
/// where that exceeds half a side of the torus; a sample's own images don't. Divided by (n - 1) / A times the
/// exact area of the ring, so that white noise is 1 on average at any distance, however few points there are.
/// Requires: finite points in their domain. Errors: degenerate_input for fewer than 2 points;
/// invalid_parameters at /reach, /bins; cancelled, deadline_exceeded. Cost: proportional to the pairs within
/// reach, 116 a point where points are not clustered, about 4 ns each; 30 bytes a point. Determinism: pairs
/// are counted, so the same bits on any number of threads. Reference: Torquato, "Random Heterogeneous
/// Materials", 2002, section 2.1 (the radial distribution function).
PairCorrelation pair_correlation(const PointSet& points, const PairCorrelationOptions& options,
                                 const Control& control);

/// The mean of g, bin by bin. Requires: at least one; all of the same options.
PairCorrelation average(std::span<const PairCorrelation> sets);

/// Where samples stand most often.
struct PairCorrelationPeak {
  double r = 0;       ///< distance in d_hex, in the middle of a bin
  double height = 0;  ///< g there
};

/// The highest bin, of equal ones the first: the first peak, of any set that is well spaced. For white noise
/// it is chance. Requires: at least one bin.
PairCorrelationPeak highest_peak(const PairCorrelation& correlation);

}  // namespace wellspaced

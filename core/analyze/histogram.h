#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/control.h"

namespace wellspaced {

/// How often each value occurs. Not normalized: counts of values, whatever the bins' width.
///
/// Shapes: bin k holds the values in [low + k width, low + (k + 1) width). The first and the last bin are not
/// empty.
struct Histogram {
  static constexpr std::int64_t most_bins = 400;

  double low = 0, width = 1;
  std::vector<std::uint64_t> counts;  ///< at most most_bins
  std::uint64_t above = 0;            ///< values beyond as many bins
  /// Of the values themselves; sd is the root of the mean square deviation from the mean.
  double mean = 0, sd = 0, min = 0, max = 0;

  std::uint64_t total() const;  ///< how many values
};

/// Bins that are the same for all sets: bin k, counted from the origin, is [origin + k width, origin + (k +
/// 1) width), so that what lies on an edge belongs to the upper bin.
struct BinGrid {
  double origin, width;
  std::int64_t last = std::int64_t{1} << 52;  ///< the last bin, to which what is above belongs

  std::int64_t bin(double value) const;  ///< 0 for what is below the origin
};

/// Counts of the bins first, first + 1, .. of a grid.
struct BinCounts {
  std::int64_t first = 0;
  std::vector<std::uint64_t> counts;
  std::uint64_t beyond = 0;  ///< above those bins

  /// Requires: bin >= first.
  void add(std::int64_t bin, std::uint64_t count = 1);
};

/// Without empty bins at its ends, and without mean, sd, min and max, which are not known. Requires: nothing
/// is beyond the counts that would be within most_bins from the first bin that is not empty.
Histogram histogram(const BinGrid& grid, const BinCounts& bins);

/// Of all values. Requires: at least one, none NaN. Errors: cancelled, deadline_exceeded. Cost: O(n +
/// most_bins), about 10 ns a value. Determinism: sequential.
Histogram histogram(const BinGrid& grid, std::span<const double> values, const Control& control);

/// Of the values of all sets together. Guarantees: the bins and counts are those that the values would have
/// had at once. Requires: at least one set; all of the same grid.
Histogram pool(std::span<const Histogram> sets);

}  // namespace wellspaced

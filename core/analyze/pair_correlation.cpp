#include "core/analyze/pair_correlation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <string>

#include "core/error.h"
#include "core/math.h"
#include "core/parallel.h"
#include "core/voronoi/grid_order.h"

namespace wellspaced {
namespace {

using Counts = std::vector<std::uint64_t>;

void require_options(const PairCorrelationOptions& options) {
  if (!(options.reach > 0 && options.reach <= PairCorrelationOptions::largest_reach))
    throw Error(ErrorCode::invalid_parameters,
                "the reach must be more than 0 and at most " +
                    std::to_string(static_cast<int>(PairCorrelationOptions::largest_reach)) + " d_hex",
                "/reach");
  if (options.bins < 1 || options.bins > PairCorrelationOptions::most_bins)
    throw Error(
        ErrorCode::invalid_parameters,
        "the number of bins must be between 1 and " + std::to_string(PairCorrelationOptions::most_bins),
        "/bins");
}

/// How often k goes into n, rounded down.
std::int64_t turns(std::int64_t k, std::int64_t n) { return k >= 0 ? k / n : -((n - 1 - k) / n); }

/// Counts pairs, each once: from every place to the places after it in its row of cells, and to the rows
/// above. What rows and columns lie beyond a side are images.
class PairCounter {
 public:
  /// `reach` and `bin` in domain lengths.
  PairCounter(const GridOrder& order, double reach, std::size_t bins, const Control& control)
      : order_(order),
        reach_(reach),
        bins_(static_cast<double>(bins)),
        bins_per_length_(bins_ / reach),
        columns_per_length_(order.columns / order.width),
        rows_per_length_(order.rows / order.height),
        control_(control),
        counts_(bins + 1) {}

  void add_place(std::size_t i) {
    const double x = order_.x[i], y = order_.y[i];
    const std::int64_t row = order_.row_of(y);
    add_columns(i, row, order_.column_of(x), column(x + reach_ + slack_x()));
    const std::int64_t last = static_cast<std::int64_t>(std::floor((y + reach_) * rows_per_length_ + slack));
    for (std::int64_t r = row + 1; r <= last; ++r) {
      const double above = std::max(0.0, (static_cast<double>(r) - slack) / rows_per_length_ - y);
      const double half = std::sqrt(std::max(0.0, reach_ * reach_ - above * above)) + slack_x();
      add_columns(i, r, column(x - half), column(x + half));
    }
    if (since_check_ < between_checks) return;
    since_check_ = 0;
    control_.check();
  }

  /// Takes away the images that `count` samples have of themselves: the offsets are the same for all.
  void remove_own_images(std::uint64_t count) {
    const auto up = static_cast<std::int64_t>(reach_ / order_.height) + 1;
    const auto along = static_cast<std::int64_t>(reach_ / order_.width) + 1;
    for (std::int64_t ty = 0; ty <= up; ++ty)
      for (std::int64_t tx = ty == 0 ? 1 : -along; tx <= along; ++tx) {
        const std::int32_t bin =
            bin_of(static_cast<double>(tx) * order_.width, static_cast<double>(ty) * order_.height);
        if (bin < bins_) counts_[static_cast<std::size_t>(bin)] -= count;
      }
  }

  const Counts& counts() const { return counts_; }

 private:
  /// Of a cell: more than rounding moves a point across a side of one.
  static constexpr double slack = 1e-6;
  static constexpr std::size_t between_checks = 1 << 20;

  double slack_x() const { return slack / columns_per_length_; }
  std::int64_t column(double x) const {
    return static_cast<std::int64_t>(std::floor(x * columns_per_length_));
  }
  /// The last one is for what is out of reach.
  std::int32_t bin_of(double dx, double dy) const {
    return static_cast<std::int32_t>(std::min(std::sqrt(dx * dx + dy * dy) * bins_per_length_, bins_));
  }

  /// Cells [from, to] of a row that may lie beyond the torus, as they may; of i's own cell what is after i.
  void add_columns(std::size_t i, std::int64_t row, std::int64_t from, std::int64_t to) {
    const std::int64_t columns = order_.columns, rows = order_.rows;
    const std::int64_t ty = turns(row, rows);
    const bool own_row = row == order_.row_of(order_.y[i]);
    const auto* start = order_.start.data() + (row - ty * rows) * columns;
    for (std::int64_t tx = turns(from, columns); tx * columns <= to; ++tx) {
      const std::int64_t first = std::max<std::int64_t>(0, from - tx * columns);
      const std::int64_t last = std::min(columns - 1, to - tx * columns);
      const bool own_cell = own_row && tx == 0;  // the row begins with it
      add_places(i, own_cell ? i + 1 : start[first], start[last + 1],
                 {static_cast<double>(tx) * order_.width, static_cast<double>(ty) * order_.height});
    }
  }

  /// The difference first, then the shift: x + width would round away the last bits of x.
  void add_places(std::size_t i, std::size_t begin, std::size_t end, Vec2 shift) {
    const double *x = order_.x.data(), *y = order_.y.data(), xi = x[i], yi = y[i];
    std::uint64_t* counts = counts_.data();
    std::array<std::int32_t, 32> found;  // in a loop of its own, which becomes vectors
    since_check_ += end - begin;
    for (std::size_t some; begin < end; begin += some) {
      some = std::min(end - begin, found.size());
      for (std::size_t k = 0; k < some; ++k)
        found[k] = bin_of((x[begin + k] - xi) + shift.x, (y[begin + k] - yi) + shift.y);
      for (std::size_t k = 0; k < some; ++k) ++counts[static_cast<std::uint32_t>(found[k])];
    }
  }

  const GridOrder& order_;
  const double reach_, bins_, bins_per_length_, columns_per_length_, rows_per_length_;
  const Control& control_;
  std::size_t since_check_ = 0;
  Counts counts_;
};

/// Pairs of samples by distance, each once.
Counts count_pairs(const GridOrder& order, double reach, std::size_t bins, const Control& control) {
  Counts total(bins + 1);
  const auto add = [&](const Counts& counts) {
    for (std::size_t k = 0; k <= bins; ++k) total[k] += counts[k];
  };
  std::mutex mutex;
  const std::size_t block = std::max<std::size_t>(1024, bins);  // so that adding up costs little
  parallel_blocks(order.size(), block, control, [&](std::size_t begin, std::size_t end) {
    PairCounter counter(order, reach, bins, control);
    for (std::size_t i = begin; i < end; ++i) counter.add_place(i);
    counter.remove_own_images(end - begin);
    const std::lock_guard lock(mutex);
    add(counter.counts());
  });
  total.pop_back();
  return total;
}

}  // namespace

double PairCorrelation::neighbors(std::size_t k) const {
  const double width = bin * d_hex, ring_area = pi * (2 * static_cast<double>(k) + 1) * width * width;
  return g[k] * ((n - 1) / area * ring_area);
}

PairCorrelation pair_correlation(const PointSet& points, const PairCorrelationOptions& options,
                                 const Control& control) {
  require_options(options);
  const std::size_t n = points.size();
  if (n < 2)
    throw Error(ErrorCode::degenerate_input,
                "a pair correlation takes at least 2 points; the point set has " + std::to_string(n));
  const double d_hex = hexagonal_spacing(points.domain->area(), n);
  const auto bins = static_cast<std::size_t>(options.bins);
  const GridOrder order = grid_order(points, d_hex, control);
  const Counts pairs = count_pairs(order, options.reach * d_hex, bins, control);
  PairCorrelation result{static_cast<double>(n), points.domain->area(), d_hex, options.reach / options.bins,
                         std::vector<double>(bins, 1)};
  for (std::size_t k = 0; k < bins; ++k) {
    const double of_white_noise = result.neighbors(k);
    result.g[k] = 2 * static_cast<double>(pairs[k]) / (result.n * of_white_noise);
  }
  return result;
}

PairCorrelation average(std::span<const PairCorrelation> sets) {
  PairCorrelation mean = sets.front();
  for (const PairCorrelation& set : sets.subspan(1)) {
    mean.n += set.n;
    mean.d_hex += set.d_hex;
    for (std::size_t k = 0; k < mean.g.size(); ++k) mean.g[k] += set.g[k];
  }
  const auto count = static_cast<double>(sets.size());
  mean.n /= count;
  mean.d_hex /= count;
  for (double& g : mean.g) g /= count;
  return mean;
}

PairCorrelationPeak highest_peak(const PairCorrelation& correlation) {
  const auto highest = std::max_element(correlation.g.begin(), correlation.g.end());
  return {correlation.middle(static_cast<std::size_t>(highest - correlation.g.begin())), *highest};
}

}  // namespace wellspaced

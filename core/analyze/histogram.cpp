#include "core/analyze/histogram.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wellspaced {
namespace {

constexpr std::size_t between_checks = 1 << 16;

/// Sets mean, sd, min, max.
void summarize(std::span<const double> values, Histogram& histogram, const Control& control) {
  const auto count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  histogram.min = histogram.max = values.front();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % between_checks == 0) control.check();
    sum += values[i];
    histogram.min = std::min(histogram.min, values[i]);
    histogram.max = std::max(histogram.max, values[i]);
  }
  histogram.mean = sum / count;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % between_checks == 0) control.check();
    squares += (values[i] - histogram.mean) * (values[i] - histogram.mean);
  }
  histogram.sd = std::sqrt(squares / count);
}

}  // namespace

std::uint64_t Histogram::total() const { return std::accumulate(counts.begin(), counts.end(), above); }

std::int64_t BinGrid::bin(double value) const {
  const double guess = std::floor((value - origin) / width);
  if (!(guess < static_cast<double>(last))) return last;
  if (guess < 0) return 0;
  auto k = static_cast<std::int64_t>(guess);
  // The quotient is rounded; the edges decide.
  if (value >= origin + static_cast<double>(k + 1) * width) ++k;
  if (value < origin + static_cast<double>(k) * width) --k;
  return std::max<std::int64_t>(k, 0);
}

void BinCounts::add(std::int64_t bin, std::uint64_t count) {
  const auto k = static_cast<std::uint64_t>(bin - first);
  (k < counts.size() ? counts[k] : beyond) += count;
}

Histogram histogram(const BinGrid& grid, const BinCounts& bins) {
  const auto is_full = [](std::uint64_t count) { return count > 0; };
  const auto begin = std::find_if(bins.counts.begin(), bins.counts.end(), is_full);
  const auto most = std::min<std::ptrdiff_t>(Histogram::most_bins, bins.counts.end() - begin);
  Histogram result;
  result.width = grid.width;
  result.low = grid.origin + static_cast<double>(bins.first + (begin - bins.counts.begin())) * grid.width;
  result.counts.assign(begin, begin + most);
  result.above = std::accumulate(begin + most, bins.counts.end(), bins.beyond);
  while (!result.counts.empty() && result.counts.back() == 0) result.counts.pop_back();
  return result;
}

Histogram histogram(const BinGrid& grid, std::span<const double> values, const Control& control) {
  const double lowest = *std::min_element(values.begin(), values.end());
  BinCounts bins{grid.bin(lowest), std::vector<std::uint64_t>(Histogram::most_bins)};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % between_checks == 0) control.check();
    bins.add(grid.bin(values[i]));
  }
  Histogram result = histogram(grid, bins);
  summarize(values, result, control);
  return result;
}

Histogram pool(std::span<const Histogram> sets) {
  const Histogram& lowest = *std::min_element(
      sets.begin(), sets.end(), [](const Histogram& a, const Histogram& b) { return a.low < b.low; });
  const BinGrid grid{lowest.low, lowest.width};
  BinCounts bins{0, std::vector<std::uint64_t>(Histogram::most_bins)};
  double count = 0, sum = 0, squares = 0, min = lowest.min, max = lowest.max;
  for (const Histogram& set : sets) {
    const std::int64_t first = std::llround((set.low - grid.origin) / grid.width);
    for (std::size_t k = 0; k < set.counts.size(); ++k)
      bins.add(first + static_cast<std::int64_t>(k), set.counts[k]);
    bins.beyond += set.above;
    count += static_cast<double>(set.total());
    sum += static_cast<double>(set.total()) * set.mean;
    min = std::min(min, set.min);
    max = std::max(max, set.max);
  }
  Histogram result = histogram(grid, bins);
  result.mean = sum / count;
  for (const Histogram& set : sets) {
    const double apart = set.mean - result.mean;
    squares += static_cast<double>(set.total()) * (set.sd * set.sd + apart * apart);
  }
  result.sd = std::sqrt(squares / count);
  result.min = min;
  result.max = max;
  return result;
}

}  // namespace wellspaced

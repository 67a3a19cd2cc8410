#include "core/analyze/l2_discrepancy.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/large_vector.h"

namespace wellspaced {
namespace {

constexpr std::size_t between_checks = 1 << 12;

__extension__ using Wide = __int128;

/// Numbers of [-1, 1] as multiples of 2^-62.
using Fixed = std::int64_t;
constexpr int fixed_bits = 62;
constexpr long double fixed_unit = 0x1p-62L;

Fixed product(Fixed a, Fixed b) {
  return static_cast<Fixed>((Wide{a} * b + (Wide{1} << (fixed_bits - 1))) >> fixed_bits);
}

/// A sum of multiples of 2^-62, in which nothing is lost however many there are. Requires: below 2^40.
class FixedSum {
 public:
  void operator+=(Fixed term) { units_ += term; }
  void operator+=(FixedSum other) { units_ += other.units_; }
  /// Rounded to such a multiple. Requires: |term| < 2^40.
  void add(long double term) { units_ += static_cast<Wide>(term / fixed_unit); }
  long double value() const {  // in two parts, which is faster
    constexpr int low_bits = 40;
    const auto high = static_cast<std::int64_t>(units_ >> low_bits);
    const auto low = static_cast<std::int64_t>(units_ & ((Wide{1} << low_bits) - 1));
    return (static_cast<long double>(high) * (std::int64_t{1} << low_bits) + static_cast<long double>(low)) *
           fixed_unit;
  }

 private:
  Wide units_ = 0;
};

/// A coordinate less 1/2.
Fixed centered(double x) { return static_cast<Fixed>(x * 0x1p62) - (Fixed{1} << (fixed_bits - 1)); }

/// Sums of p^a q^b over samples, a <= 2, b < `Powers`, p and q being coordinates less 1/2.
template <std::size_t Powers>
struct Moments {
  std::array<std::array<FixedSum, Powers>, 3> of{};

  void operator+=(const Moments& other) {
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < Powers; ++b) of[a][b] += other.of[a][b];
  }
  void add_sample(Fixed p, Fixed q) {
    constexpr Fixed one = Fixed{1} << fixed_bits;
    const Fixed powers_p[3] = {one, p, product(p, p)}, powers_q[3] = {one, q, product(q, q)};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < Powers; ++b) of[a][b] += product(powers_p[a], powers_q[b]);
  }
};

/// Moments of the samples above a level (a binary indexed tree, from the top down).
class Above {
 public:
  Above(std::size_t levels, const Control& control) : tree_(filled(levels + 1, Moments<2>{}, control)) {}

  void add(std::size_t level, const Moments<2>& sample) {
    for (std::size_t k = tree_.size() - 1 - level; k < tree_.size(); k += k & (~k + 1)) tree_[k] += sample;
  }
  Moments<2> above(std::size_t level) const {
    Moments<2> sum;
    for (std::size_t k = tree_.size() - 2 - level; k > 0; k &= k - 1) sum += tree_[k];
    return sum;
  }

 private:
  LargeVector<Moments<2>> tree_;
};

/// The mean over all pairs (i, j) of B(|x_i - x_j|), B(t) = t^2 - t + 1/6, as a sum of squares: twice
/// Watson's statistic / n.
long double mean_of_pairs(std::span<const double> rising) {
  const auto n = static_cast<long double>(rising.size());
  FixedSum sum;
  for (const double x : rising) sum.add(x);
  const long double middle = sum.value() / n - 0.5L;
  FixedSum squares;
  for (std::size_t i = 0; i < rising.size(); ++i) {
    const long double even = (static_cast<long double>(i) + 0.5L) / n, off = rising[i] - middle - even;
    squares.add(off * off);
  }
  return 2 / n * (squares.value() + 1 / (12 * n));
}

/// Sums over the samples before a sample in x, of what their pairs with it add to the squares. p and q are
/// the sample's own.
struct Pairs {
  long double p, q;
  long double before;  ///< how many
  const Moments<3>& all;
  const Moments<2>& above;  ///< of them, those that are higher in y

  /// (1 - larger x) (1 - larger y)
  long double star() const {
    const long double count = above.of[0][0].value();
    const long double heights = (before - count) * (0.5L - q) + (0.5L * count - above.of[0][1].value());
    return (0.5L - p) * heights;
  }

  /// B(dx) B(|dy|). B(|dy|) is dy^2 - dy + 1/6 for all, and 2 dy more for those that are higher.
  long double periodic() const {
    const long double x[3] = {p * p - p + 1 / 6.0L, 1 - 2 * p, 1},
                      y[3] = {q * q - q + 1 / 6.0L, 1 - 2 * q, 1};
    long double sum = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) sum += x[a] * y[b] * all.of[a][b].value();
      sum += 2 * x[a] * (q * above.of[a][0].value() - above.of[a][1].value());
    }
    return sum;
  }
};

}  // namespace

L2Discrepancies l2_discrepancies(const RankedPoints& points, const Control& control) {
  const auto n = static_cast<long double>(points.size());
  Above tree(points.levels.size(), control);
  Moments<3> all;
  FixedSum star, periodic;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % between_checks == 0) control.check();
    const long double x = points.x[i], y = points.y[i];
    const Fixed p = centered(points.x[i]), q = centered(points.y[i]);
    const Moments<2> above = tree.above(points.level[i]);
    const Pairs pairs{p * fixed_unit, q * fixed_unit, static_cast<long double>(i), all, above};
    star.add(((1 - x) * (1 - y) + 2 * pairs.star()) / n - (1 - x * x) * (1 - y * y) / 2);
    periodic.add((1 / 36.0L + 2 * pairs.periodic()) / n);
    Moments<2> sample;
    sample.add_sample(p, q);
    tree.add(points.level[i], sample);
    all.add_sample(p, q);
  }
  // With B as above, scipy's 3/2 - |dx| (1 - |dx|) is 4/3 + B(|dx|), and the squares of 4/3 cancel.
  const long double axes = mean_of_pairs(points.x) + mean_of_pairs(points.sorted_y);
  const long double star2 = 1 / 9.0L + star.value() / n, periodic2 = 4 / 3.0L * axes + periodic.value() / n;
  return {static_cast<double>(std::max(0.0L, star2)), static_cast<double>(std::max(0.0L, periodic2))};
}

}  // namespace wellspaced

#include "core/math.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace wellspaced {
namespace {

// atan(k / 8), k = 0..8.
constexpr std::array<double, 9> atan_of_eighths = {0.0,
                                                   0.124354994546761435031,
                                                   0.244978663126864154172,
                                                   0.358770670270572220395,
                                                   0.463647609000806116214,
                                                   0.558599315343562435971,
                                                   0.643501108793284386803,
                                                   0.718829999621624505268,
                                                   0.785398163397448309616};

/// atan on [0, 1]: the nearest tabulated angle plus a Taylor series of an argument of at most 1/16.
double atan_unit(double t) {
  const int k = static_cast<int>(t * 8 + 0.5);
  const double c = k / 8.0;
  const double s = (t - c) / (1 + t * c);
  const double z = s * s;
  double sum = 0;
  for (int power = 15; power >= 3; power -= 2) sum = z * (((power / 2) % 2 == 0 ? 1.0 : -1.0) / power + sum);
  return atan_of_eighths[static_cast<std::size_t>(k)] + (s + s * sum);
}

/// 1 / k!, k = 0..13.
constexpr std::array<double, 14> one_by_factorial = [] {
  std::array<double, 14> values{};
  double factorial = 1;  // exact
  for (std::size_t k = 0; k < values.size(); ++k) {
    factorial *= k == 0 ? 1.0 : static_cast<double>(k);
    values[k] = 1 / factorial;
  }
  return values;
}();

/// Cosine and sine on [-pi / 4, pi / 4], by their series.
CosSin cos_sin_of_eighth(double angle) {
  const double z = angle * angle;
  double cos = 0, sin = 0;
  for (int power = 18; power >= 2; power -= 2) {
    cos = z / (power * (power - 1)) * (1 - cos);
    sin = z / (power * (power + 1)) * (1 - sin);
  }
  return {1 - cos, angle - angle * sin};
}

}  // namespace

double portable_atan2(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y);
  if (ax == 0 && ay == 0) return 0;
  double angle = ay <= ax ? atan_unit(ay / ax) : pi / 2 - atan_unit(ax / ay);
  if (x < 0) angle = pi - angle;
  return y < 0 ? -angle : angle;
}

double portable_log10(double x) {
  constexpr double log10_of_2 = 0.301029995663981195, log10_of_e = 0.434294481903251828;
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // in [1/2, 1)
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  // log(m) = 2 artanh(s), |s| <= .172
  const double s = (m - 1) / (m + 1), z = s * s;
  double sum = 0;
  for (int power = 25; power >= 3; power -= 2) sum = z * (1.0 / power + sum);
  return exponent * log10_of_2 + 2 * log10_of_e * (s + s * sum);
}

double portable_exp(double x) {
  // ln 2 in two parts: the first has 32 trailing zeros, so that its products with whole numbers are exact.
  constexpr double ln2 = 0x1.62e42feep-1, ln2_rest = 0x1.a39ef35793c76p-33, one_by_ln2 = 1.4426950408889634;
  if (x > 710) return std::numeric_limits<double>::infinity();
  if (x < -746) return 0;
  if (std::isnan(x)) return x;
  const double power = std::floor(x * one_by_ln2 + 0.5);
  const double high = x - power * ln2, low = power * ln2_rest, r = high - low;  // |r| <= .347
  double sum = 0;
  for (std::size_t k = one_by_factorial.size(); k-- > 2;) sum = one_by_factorial[k] + r * sum;
  return std::ldexp(1 + (r + (r * r * sum + (high - r - low))), static_cast<int>(power));
}

CosSin portable_cos_sin(std::uint64_t k, std::uint64_t n) {
  const std::uint64_t quarter = 4 * k / n, rest = 4 * k - quarter * n;  // rest / n of a quarter turn
  const bool beyond = 2 * rest > n;                                     // an eighth: count from the other end
  const double part = static_cast<double>(beyond ? n - rest : rest) / static_cast<double>(n);
  auto [cos, sin] = cos_sin_of_eighth(pi / 2 * part);
  if (beyond) std::swap(cos, sin);
  for (std::uint64_t turn = 0; turn < quarter; ++turn) {
    std::swap(cos, sin);
    cos = -cos;
  }
  return {cos, sin};
}

CosSin portable_cos_sin(double turns) {
  const double quarters = std::floor(4 * turns + 0.5);
  auto [cos, sin] = cos_sin_of_eighth(2 * pi * (turns - quarters / 4));  // an exact difference
  for (auto turn = static_cast<std::int64_t>(quarters) & 3; turn > 0; --turn) {
    std::swap(cos, sin);
    cos = -cos;
  }
  return {cos, sin};
}

}  // namespace wellspaced

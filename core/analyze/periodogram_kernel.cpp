#include "core/analyze/periodogram_kernel.h"

#include "core/math.h"

namespace wellspaced {
namespace {

// b^2, with b = pi sqrt((3/4 reach)^2 - 0.8): the best for a grid of twice as many places as frequencies.
constexpr double b2 = pi * pi * (0.5625 * SpreadingKernel::reach * SpreadingKernel::reach - 0.8);
constexpr std::size_t terms = 100;  // far more than double precision needs

/// I0(b sqrt(u)) = sum over m of (b^2 u / 4)^m / m!^2.
std::array<double, terms> bessel_series() {
  std::array<double, terms> series{1};
  for (std::size_t m = 1; m < terms; ++m) {
    const auto k = static_cast<double>(m);
    series[m] = series[m - 1] * (b2 / 4 / (k * k));
  }
  return series;
}

}  // namespace

SpreadingKernel::SpreadingKernel() {
  const std::array<double, terms> series = bessel_series();
  for (std::size_t m = terms; m-- > 0;) peak_ += series[m];
  constexpr double step = 2.0 / reach;
  for (std::size_t j = 0; j < reach; ++j) {
    // Horner's scheme with 1 - z^2 as a polynomial of x, cut off at the degree that is kept.
    const double z = (static_cast<double>(j) + 0.5) * step - 1;
    const double u[3] = {1 - z * z, -2 * z * step, -step * step};
    std::array<double, degree + 1> sum{};
    for (std::size_t m = terms; m-- > 0;) {
      for (std::size_t d = degree + 1; d-- > 0;)
        sum[d] = sum[d] * u[0] + (d > 0 ? sum[d - 1] * u[1] : 0) + (d > 1 ? sum[d - 2] * u[2] : 0);
      sum[0] += series[m];
    }
    for (std::size_t d = 0; d <= degree; ++d) coefficients_[d][j] = sum[d] / peak_;
  }
}

double SpreadingKernel::transform(double periods) const {
  const double t = pi * reach * periods, q2 = b2 - t * t;  // positive: |t| <= pi reach / 4
  double sum = 0;                                          // sinh(q) / q
  for (std::size_t m = terms; m-- > 0;) {
    const auto k = static_cast<double>(2 * m + 2);
    sum = sum * (q2 / (k * (k + 1))) + 1;
  }
  return reach * sum / peak_;
}

}  // namespace wellspaced

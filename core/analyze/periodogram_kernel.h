#pragma once

#include <array>
#include <cstddef>

namespace wellspaced {

/// The Kaiser-Bessel window phi(z) = I0(b sqrt(1 - z^2)) / I0(b), |z| <= 1, laid over `reach` places of a
/// grid: what a point is spread by before a Fourier transform on twice as many places as there are
/// frequencies.
///
/// Guarantees: values and transform right to 1e-14; aliasing of the pair below 1e-12. Sums of positive terms
/// only, so there is nothing that depends on a CPU.
class SpreadingKernel {
 public:
  static constexpr int reach = 14;
  using Values = std::array<double, reach>;

  SpreadingKernel();

  /// Values at the places 0, .., reach - 1 for a point that stands at reach / 2 - t, t in [0, 1].
  Values at(double t) const {
    const double x = t - 0.5;
    Values values = coefficients_[degree];
    for (std::size_t d = degree; d-- > 0;)
      for (std::size_t j = 0; j < reach; ++j) values[j] = values[j] * x + coefficients_[d][j];
    return values;
  }

  /// Its Fourier transform at a frequency of so many periods a place, |periods| <= 1/4.
  double transform(double periods) const;

 private:
  static constexpr std::size_t degree = 19;

  std::array<Values, degree + 1> coefficients_{};  ///< a polynomial in t - 1/2 for each place
  double peak_ = 0;                                ///< I0(b)
};

}  // namespace wellspaced

#pragma once

#include <cstddef>
#include <vector>

namespace wellspaced {

/// Discrete Fourier transforms of one length, X_k = sum_j x_j exp(-2 pi i j k / n), eight at a time.
///
/// Shapes: the eight series lie side by side: element j is 16 doubles, real parts and then imaginary parts.
/// Accuracy: 1e-15 of the root mean square of X. Requires: n = 2^a 3^b 5^c. Cost: n log n, about 1.5 ns a
/// point, series and factor; 16 n bytes for a table. Determinism: plain IEEE arithmetic in a fixed order, the
/// same on any vector width (FFTW's twiddle factors come from libm, and so differ between CPUs). Thread
/// safety: immutable after construction. Reference: Stockham's autosort, as in Van Loan, "Computational
/// Frameworks for the Fast Fourier Transform", 1992, section 1.7.
class FourierTransform {
 public:
  static constexpr std::size_t side_by_side = 8, stride = 2 * side_by_side;

  explicit FourierTransform(std::size_t n);

  /// Whether n has no other prime factors than 2, 3 and 5.
  static bool takes(std::size_t n);

  std::size_t size() const { return n_; }

  /// Transforms n elements. Both arrays have room for that many; returns the one that holds the result, the
  /// other then holds nothing of meaning.
  double* run(double* elements, double* scratch) const;

 private:
  std::size_t n_;
  std::vector<int> radices_;
  std::vector<double> roots_;  ///< cos, sin of -2 pi k / n
};

}  // namespace wellspaced

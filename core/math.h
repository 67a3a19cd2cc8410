#pragma once

#include <cstdint>

namespace wellspaced {

/// Angle of the vector (x, y) in radians, in [-pi, pi]; 0 for (0, 0).
///
/// Built from +, -, *, / only, so that it gives the same bits on every CPU, which libm's does not promise (it
/// chooses code by whether the CPU has fused multiply-add). Accuracy: 4 ulp. Every transcendental function in
/// a result path goes through this header.
double portable_atan2(double y, double x);

/// Decimal logarithm of x > 0, finite. Accuracy: 4 ulp, and 1e-16 absolute near 1.
double portable_log10(double x);

/// e^x for any x: 0 below -745.2, infinite above 709.8, NaN for NaN. Accuracy: 1 ulp, also where the result
/// is subnormal.
double portable_exp(double x);

struct CosSin {
  double cos = 1, sin = 0;
};

/// Cosine and sine of k n-ths of a whole turn, k < n < 2^60. Accuracy: 1e-16 absolute; exact at quarter
/// turns.
CosSin portable_cos_sin(std::uint64_t k, std::uint64_t n);

/// The same of any number of whole turns, |turns| < 2^52. Accuracy: 2e-16 absolute; exact at quarter turns.
CosSin portable_cos_sin(double turns);

inline constexpr double pi = 3.14159265358979323846;

}  // namespace wellspaced

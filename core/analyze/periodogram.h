#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// How much a point set holds of each frequency (kx / width, ky / height): P = |sum_j exp(-2 pi i k.x_j)|^2 /
/// n, 1 on average for white noise. The zero frequency, which tells nothing, is excluded: 0.
///
/// Shapes: P(-k) = P(k), so `power` holds a half plane: kx = 0 .. k_max, and for each of them ky = -k_max ..
/// k_max.
struct Periodogram {
  int k_max = 0;
  double n = 0;  ///< points; the mean number for an average over sets
  double width = 1, height = 1;
  std::vector<double> power;

  double at(int kx, int ky) const { return kx < 0 ? power[index(-kx, -ky)] : power[index(kx, ky)]; }
  std::size_t index(int kx, int ky) const {
    const auto k = static_cast<std::size_t>(k_max);
    return static_cast<std::size_t>(kx) * (2 * k + 1) + static_cast<std::size_t>(ky + k_max);
  }
};

inline constexpr int largest_k_max = 1 << 15;

/// The periodogram of points on a torus for whole kx, ky in [-k_max, k_max].
///
/// Guarantees: |error| <= 1e-9 max(1, P). Requires: finite points in their domain. Errors: degenerate_input
/// without points; invalid_parameters at /k_max outside [1, largest_k_max]; cancelled, deadline_exceeded.
/// Cost: n spreading steps of 0.3 us and a Fourier transform of about (4 k_max)^2 places, of which the half
/// is pruned; `periodogram_bytes` of memory. Determinism: the same bits on any number of threads; plain IEEE
/// arithmetic in a fixed order, the same on any vector width. Reference: Fessler and Sutton,
/// "Nonuniform Fast Fourier Transforms Using Min-Max Interpolation", 2003, for the Kaiser-Bessel kernel;
/// Barnett, Magland, af Klinteberg, "A Parallel Nonuniform Fast Fourier Transform Library", 2019.
Periodogram periodogram(const PointSet& points, int k_max, const Control& control);

/// The most memory that `periodogram` takes, with its result, on so many threads.
std::uint64_t periodogram_bytes(std::size_t n, int k_max, unsigned threads = 1);

}  // namespace wellspaced

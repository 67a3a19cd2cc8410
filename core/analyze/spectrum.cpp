#include "core/analyze/spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/math.h"

namespace wellspaced {
namespace {

/// Calls use(ring, power) for half of the plane, without the zero frequency.
template <class Use>
void for_each_frequency(const Periodogram& p, std::size_t rings, const Use& use) {
  const double along_x = p.height / p.width, along_y = p.width / p.height;
  for (int kx = 0; kx <= p.k_max; ++kx)
    for (int ky = kx == 0 ? 1 : -p.k_max; ky <= p.k_max; ++ky) {
      const double k2 = along_x * kx * kx + along_y * ky * ky;
      const auto ring = static_cast<std::size_t>(std::sqrt(k2) + 0.5);
      if (ring < rings) use(ring, p.at(kx, ky));
    }
}

std::size_t rings_within(const Periodogram& p) {
  const double side = std::min(std::sqrt(p.height / p.width), std::sqrt(p.width / p.height));
  return static_cast<std::size_t>(p.k_max * side) + 1;
}

}  // namespace

double k_max_of(double n, double aspect, double range) {
  return std::max(1.0, std::ceil(range * std::sqrt(n * aspect)));
}

Periodogram mean_periodogram(std::span<const PointSet> sets, double range, const Control& control) {
  const Vec3 sides = sets.front().domain->box().size;
  const double aspect = std::max(sides.x / sides.y, sides.y / sides.x);
  const double k_max = k_max_of(static_cast<double>(sets.front().size()), aspect, range);
  if (!(k_max <= largest_k_max))
    throw Error(ErrorCode::invalid_parameters,
                "this range goes beyond frequency " + std::to_string(largest_k_max) +
                    " of a side, which is the most; ask for a smaller one",
                "/range");
  Periodogram mean = periodogram(sets.front(), static_cast<int>(k_max), control);
  for (const PointSet& set : sets.subspan(1)) {
    const Periodogram next = periodogram(set, static_cast<int>(k_max), control);
    for (std::size_t i = 0; i < mean.power.size(); ++i) mean.power[i] += next.power[i];
  }
  for (double& power : mean.power) power /= static_cast<double>(sets.size());
  return mean;
}

Spectrum spectrum(const Periodogram& periodogram, int sets) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN(), periodogram_error = 1e-9;
  const std::size_t rings = rings_within(periodogram);
  Spectrum result{periodogram.n, sets, std::vector<double>(rings), std::vector<double>(rings)};
  std::vector<double> members(rings), squares(rings);
  for_each_frequency(periodogram, rings, [&](std::size_t ring, double power) {
    result.power[ring] += power;
    ++members[ring];
  });
  for (std::size_t r = 1; r < rings; ++r)
    result.power[r] = members[r] > 0 ? result.power[r] / members[r] : unknown;
  for_each_frequency(periodogram, rings, [&](std::size_t ring, double power) {
    squares[ring] += (power - result.power[ring]) * (power - result.power[ring]);
  });
  for (std::size_t r = 1; r < rings; ++r) {
    const double mean = result.power[r], ratio = squares[r] / (members[r] - 1) / (mean * mean);
    const bool known = mean > periodogram_error && ratio > 0 && std::isfinite(ratio);
    result.anisotropy_db[r] = known ? 10 * portable_log10(ratio) : unknown;
  }
  result.power[0] = result.anisotropy_db[0] = 0;
  return result;
}

std::optional<double> effective_nyquist(const Spectrum& spectrum) {
  const double root = std::sqrt(spectrum.n);
  std::vector<double> mean_below(spectrum.power.size());  // of the frequencies in ring r and below
  double sum = 0;
  for (std::size_t r = 1; r < mean_below.size(); ++r) {
    const auto k = static_cast<double>(r);
    if (!std::isnan(spectrum.power[r])) sum += 2 * k * spectrum.power[r];
    mean_below[r] = sum / (k * (k + 1));
  }
  for (auto r = static_cast<std::size_t>(root / 2); r < mean_below.size(); ++r) {
    if (!(mean_below[r] > 0.5)) continue;
    while (r > 0 && !(mean_below[r] < 0.1)) --r;
    return static_cast<double>(r) / root;
  }
  return std::nullopt;
}

std::optional<double> oscillations(const Spectrum& spectrum) {
  const auto& power = spectrum.power;
  std::size_t first = 1;
  while (first < power.size() && !(power[first] >= 0.98)) ++first;
  const auto last = first + static_cast<std::size_t>(5 * std::sqrt(spectrum.n));
  if (last >= power.size()) return std::nullopt;
  double sum = 0, area = 0;
  for (std::size_t r = first; r <= last; ++r) {
    if (std::isnan(power[r])) continue;
    const auto k = static_cast<double>(r);
    sum += k * (power[r] - 1) * (power[r] - 1);
    area += k;
  }
  return 10 * std::sqrt(sum / area);
}

std::optional<double> mean_anisotropy_db(const Spectrum& spectrum) {
  const double root = std::sqrt(spectrum.n);
  const auto last = static_cast<std::size_t>(2.5 * root);
  if (last >= spectrum.power.size()) return std::nullopt;
  double sum = 0, count = 0;
  for (auto r = static_cast<std::size_t>(std::ceil(0.5 * root)); r <= last; ++r) {
    if (std::isnan(spectrum.anisotropy_db[r])) continue;
    sum += spectrum.anisotropy_db[r];
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

}  // namespace wellspaced

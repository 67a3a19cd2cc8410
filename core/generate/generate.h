#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/domain/domain.h"

namespace wellspaced {

/// How many points: exactly one of the two.
struct Density {
  std::optional<std::uint64_t>
      count;  ///< wanted number of points, at least 1; methods say how near they come to it
  std::optional<double> radius;  ///< conflict radius in domain lengths
};

/// n r^2 = 0.6966 A for maximal Poisson-disk samplings (.690 to .703 for n >= 5000).
inline constexpr double poisson_disk_constant = 0.6966;

/// The conflict radius that gives about `count` points on `area`.
double poisson_disk_radius(double area, std::uint64_t count);

/// The conflict radius of a maximal Poisson-disk sampling of about `count` points, at most the largest one
/// that a sampling can have. Where it is above the shorter side, as on thin tori, points follow each other as
/// on a line.
double radius_for_count(const Domain& domain, double count);

/// The number of points that a maximal Poisson-disk sampling with that radius will have, about.
double poisson_disk_count(double area, double radius);

}  // namespace wellspaced

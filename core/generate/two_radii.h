#pragma once

#include <cstdint>
#include <memory>

#include "core/control.h"
#include "core/domain/torus.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

struct TwoRadiiOptions {
  double radius = 0;  ///< conflict radius r_f, domain lengths; more than 0, at most half the torus's diagonal
  double beta = 1.5;  ///< coverage radius r_c = beta r_f; more than 1, at most 2
};

/// Two-radii maximal Poisson-disk sampling of a torus: more random than the one of a single radius, since
/// places are covered already that a further point could still take.
///
/// Guarantees
/// 1. No two samples are nearer than r_f, periodic images included.
/// 2. No place is farther than r_c (1 + 1e-9) from its nearest sample, since every cell of a quadtree was
/// found covered by one sample or taken. So beta of the result is at most options.beta.
/// 3. Each sample is drawn from the disk of radius r_c around a place that is uniform over what no earlier
/// one covers, uniformly over the part of it that is free of conflicts; it is that place where 16 draws
/// conflict.
/// 4. Order: row by row of the background grid, left to right.
/// Errors: infeasible or invalid_parameters at /radius as for poisson_disk, invalid_parameters at /beta;
/// cancelled, deadline_exceeded.
/// Cost: O(n) time and memory, 2.5 to 4 us a point.
/// Determinism: the points depend on torus, options and rng only.
/// Reference: the radii are those of Mitchell, Rand, Ebeida, Bajaj, "Variable Radii Poisson Disk Sampling",
/// 2012; the way to draw is this project's.
PointSet two_radii(const std::shared_ptr<const Torus>& torus, const TwoRadiiOptions& options, Rng& rng,
                   Control& control);

/// The same with exactly `count` points, at least 1, for the r_f that is found: as in poisson_disk_of_count,
/// the last ones stand in the middle of holes. Guarantees: r_c <= beta r_f (1 + 1e-9). options.radius is not
/// looked at.
PointSet two_radii_of_count(const std::shared_ptr<const Torus>& torus, std::uint64_t count,
                            const TwoRadiiOptions& options, Rng& rng, Control& control);

/// The number of points that these radii will give, about.
double two_radii_count(double area, const TwoRadiiOptions& options);

}  // namespace wellspaced

#pragma once

#include <cstdint>
#include <memory>

#include "core/control.h"
#include "core/domain/torus.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

struct PoissonDiskOptions {
  double radius = 0;  ///< conflict radius r, domain lengths; more than 0, at most half the torus's diagonal
};

/// Errors: invalid_parameters or infeasible at `where`, as for poisson_disk.
void require_radius(const Domain& domain, double radius, const std::string& where = "/radius");

/// Maximal Poisson-disk sampling (MPS) of a torus: random points, none nearer than r to another, none can be
/// added.
///
/// Guarantees
/// 1. r_f >= r between any two samples, periodic images included.
/// 2. Maximal: r_c <= r (1 + 1e-9), since every cell of a quadtree was found covered by one sample or taken.
///    So beta <= 1 + 1e-9.
/// 3. Unbiased: each sample is uniform over what the earlier ones leave free; of more than about 20,000
///    samples, over what they leave free of one tile, tiles taking turns. The spectrum doesn't show it.
/// 4. Order: row by row of the background grid, left to right.
/// Errors: infeasible at /radius above half the diagonal; cancelled, deadline_exceeded.
/// Cost: O(n) time and memory, about 0.6 us and 100 bytes a point. n r^2 is .690 to .703 of the area for n >=
/// 5000. Determinism: the points depend on torus, radius and rng only, on no number of threads. Reference:
/// Ebeida, Mitchell, Patney, Davidson, Owens, "A Simple Algorithm for Maximal Poisson-Disk Sampling in High
/// Dimensions", 2012. The base cell has side r/sqrt(2), so that it holds at most one sample.
PointSet poisson_disk(const std::shared_ptr<const Torus>& torus, const PoissonDiskOptions& options, Rng& rng,
                      Control& control);

/// The same with exactly `count` points, at least 1: a sampling of about two standard deviations fewer
/// points, to which farthest-point insertion adds those that are missing, 0.5 sqrt(count) of them.
///
/// Guarantees
/// 1. Exactly `count` points.
/// 2. They are maximal for r = r_f: r_c <= r_f (1 + 1e-9), so beta <= 1 + 1e-9, whatever `count` is.
/// 3. Order: row by row, as above.
/// Not guaranteed: that all are unbiased; the ones added stand in the middle of holes. r is not chosen but
/// found: n r^2 is 1% less than that of `poisson_disk` at 400 points, 0.1% less at 10,000.
/// Errors: cancelled, deadline_exceeded. Cost: as poisson_disk; one set in forty takes a second try.
PointSet poisson_disk_of_count(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Rng& rng,
                               Control& control);

}  // namespace wellspaced

#pragma once

#include <cstdint>
#include <memory>

#include "core/control.h"
#include "core/domain/torus.h"
#include "core/generate/sample_grid.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

/// A DartSampler's points: the method behind `poisson_disk` and `two_radii`, whose headers say what holds.
///
/// A dart aims at a place that no sample covers. Where the radii are the same it becomes a sample there, else
/// at a place drawn around it (where 16 draws conflict with samples: there).
/// Order: row by row of the background grid. Errors: cancelled, deadline_exceeded.
PointSet throw_darts(const std::shared_ptr<const Torus>& torus, const DiskRadii& radii, Rng& rng,
                     Control& control);

/// The same with exactly `count` points, at least 1, if `radii` are such that not many more are drawn: those
/// that are missing are added by farthest-point insertion, which is the proof as well. Radii that give too
/// many points are tried again, a little larger. Guarantees: for r_f of the result, r_c is at most as many
/// times larger as radii.coverage is than radii.conflict, or beta <= 1.
PointSet throw_darts_to_count(const std::shared_ptr<const Torus>& torus, std::uint64_t count,
                              const DiskRadii& radii, Rng& rng, Control& control);

/// Two standard deviations below a count, of samplings whose numbers of points scatter by scatter * sqrt(n)
/// for a given radius: one of so many expected points seldom has more than `count`.
double count_below(double count, double scatter);

}  // namespace wellspaced

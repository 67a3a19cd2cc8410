#pragma once

#include <cstdint>
#include <memory>

#include "core/control.h"
#include "core/domain/domain.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

/// Jittered sampling: one uniform point in each of `count` strata of equal area.
///
/// On a torus, strip or box the strata are rectangles in rows that are as high as they have columns, whose
/// numbers differ by one at most; where the count is that of a grid, as k^2 on a square torus, they are the
/// grid's cells. On a sphere they are rows of equal latitude, of as many parts as their areas say. Elsewhere
/// see one_in_each_part.
///
/// Guarantees: exactly `count` points, at least 1; row by row, one in each stratum, left to right. So each
/// place is as likely as any other. Errors: cancelled, deadline_exceeded. Cost: O(count).
PointSet jittered(const std::shared_ptr<const Domain>& domain, std::uint64_t count, Rng& rng,
                  Control& control);

}  // namespace wellspaced

#pragma once

#include <cstdint>

#include "core/control.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

/// One uniform point in each of `count` parts of equal area, of a domain that is made of flat triangles: the
/// whole is halved across its longest side, by area and count, and so are the halves, down to single parts.
///
/// Guarantees: areas are equal to 1e-9; points are inside, none on the boundary. Order: that of the parts.
/// Errors: cancelled, deadline_exceeded. Cost: O((n + t) log n) for t triangles, about 10 us a point.
PointSet one_in_each_part(const std::shared_ptr<const Domain>& domain, std::uint64_t count, Rng& rng,
                          Control& control);

}  // namespace wellspaced

#pragma once

#include <cstdint>
#include <memory>

#include "core/control.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

/// `count` independent points, uniform by area: the reference in which nothing is spaced.
///
/// Guarantees: exactly `count` points; point i is the i-th draw (no spatial order).
/// Errors: cancelled, deadline_exceeded. Cost: O(count).
PointSet white_noise(std::shared_ptr<const Domain> domain, std::uint64_t count, Rng& rng, Control& control);

}  // namespace wellspaced

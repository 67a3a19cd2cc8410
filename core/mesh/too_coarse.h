#pragma once

#include "core/control.h"
#include "core/error.h"
#include "core/point_set.h"

namespace wellspaced {

/// Why points on a sphere or a surface have no mesh that follows it, and what would do: infeasible. A border
/// of which a corner, or the whole curve, has no point comes first; then points in one half of a sphere; then
/// the coverage radius. Cost: that of measure_spacing. Errors: those of that.
Error too_coarse(const PointSet& points, const Control& control);

}  // namespace wellspaced

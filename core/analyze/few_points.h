#pragma once

#include <vector>

#include "core/analyze/point_look.h"
#include "core/control.h"
#include "core/point_set.h"

namespace wellspaced {

/// Where at most 64 points share a surface of up to some thousand faces, cells in charts may miss corners:
/// raises the outradius in `looks` of the points around a place that is farther from all of them. Does
/// nothing elsewhere. Cost: a search over the whole surface for each point. Errors: cancelled,
/// deadline_exceeded.
void see_far_places(const PointSet& points, const Control& control, std::vector<PointLook>& looks);

}  // namespace wellspaced

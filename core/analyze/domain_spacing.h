#pragma once

#include "core/analyze/spacing.h"

namespace wellspaced {

/// measure_local_spacing on any domain, with and without a sizing function, by clipped cells: what it goes by
/// where there is no torus. Cost: about 3 us a point and thread on the plane.
LocalSpacing measure_domain_spacing(const PointSet& points, const Control& control);

}  // namespace wellspaced

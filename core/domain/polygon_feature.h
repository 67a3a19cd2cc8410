#pragma once

#include "core/domain/polygon.h"
#include "core/domain/polygon_locator.h"

namespace wellspaced {

/// See Polygon::smallest_feature.
PolygonFeature find_smallest_feature(const PolygonRings& rings, const PolygonLocator& locator);

}  // namespace wellspaced

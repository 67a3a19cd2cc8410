#pragma once

#include "core/domain/triangle_mesh.h"

namespace wellspaced {

/// About the longest shortest way between two places of one component, and a tenth more: along edges, which
/// is farther than straight, from a vertex that is as far away as there are. An estimate, not a bound that is
/// proven. Cost: O(n log n), about 1 us a vertex.
double mesh_extent(const TriangleMesh& mesh);

}  // namespace wellspaced

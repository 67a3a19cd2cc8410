#pragma once

#include "core/domain/triangle_mesh.h"

namespace wellspaced {

/// A length that no shortest way between two places of one component is above: from a vertex in the middle,
/// along edges, to the farthest vertex, twice. At most about twice the longest shortest way.
/// Cost: O(n log n), about 1 us a vertex.
double mesh_extent(const TriangleMesh& mesh);

}  // namespace wellspaced

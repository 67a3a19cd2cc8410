#pragma once

#include <string>

#include "core/domain/face_tree.h"
#include "core/domain/triangle_mesh.h"

namespace wellspaced {

/// How fine the finest detail of a surface is, and where.
struct SmallestFeature {
  double length = 0;
  std::string description;  ///< "the radius of curvature at vertex 17"
};

/// The smallest of: radii of curvature at vertices, as the edges there bend away from the tangent plane, but
/// at sharp edges, where the surface turns by more than 60 degrees; half the way from a vertex along its
/// normal, inward and outward, to another part of the surface; extents of border loops. An estimate, for
/// warning where samples are too few to follow the surface: only vertices are looked at, and noise counts as
/// curvature.
///
/// Requires: the tree is of the mesh's faces. Cost: about 3 us a vertex. A flat mesh has only its borders.
SmallestFeature smallest_feature(const TriangleMesh& mesh, const FaceTree& tree);

}  // namespace wellspaced

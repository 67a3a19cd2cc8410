#pragma once

#include <span>

#include "core/control.h"
#include "core/point_set.h"
#include "core/vec.h"
#include "core/voronoi/moving_set.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {

/// Moves all points at once, point i by moves[i] in units of d_hex, and makes the mesh Delaunay again: by
/// flips where no triangle turned over, else by triangulating anew.
///
/// Guarantees: the mesh is Delaunay, as after legalize_all. Where the new places can't be triangulated (more
/// than 15 neighbors of one point, say), all moves are halved until they can. Returns the part of the moves
/// that was made: 1 but for such a set, 0 if even a 64th is too much.
/// Errors: cancelled, deadline_exceeded. Cost: 0.1 us a point; 1 us where triangles turn over.
double move_all(StarMesh& mesh, std::span<const Vec2> moves, const PointSet& input, const Control& control);

/// The same on any domain, as far as each point's freedom and the boundary allow. Returns 1.
double move_all(MovingSet& set, std::span<const Vec2> moves, const PointSet& input, const Control& control);

/// Length of the longest move.
double longest(std::span<const Vec2> moves);

}  // namespace wellspaced

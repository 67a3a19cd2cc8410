#pragma once

#include <vector>

#include "core/control.h"
#include "core/optimize/optimize.h"
#include "core/vec.h"
#include "core/voronoi/moving_set.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {

struct DistMeshOptions {
  int max_sweeps = 100;     ///< at least 1
  double tolerance = 1e-3;  ///< it is over when no point moved farther in a sweep, in units of d_hex; >= 0
};

/// DistMesh: the edges of the Delaunay triangulation as springs that only push. An edge of length L pushes
/// its ends apart with the force max(0, L_0 - L), L_0 being 1.2 times the root mean square of all lengths;
/// each sweep moves every point by 0.2 times the sum of its forces, all at once, and makes the triangulation
/// Delaunay again.
///
/// Points are neither added nor taken away: the density control of the authors' later versions is left out.
///
/// Guarantees: those of OptimizeResult; `converged` stays empty, since there is no target for beta. `history`
/// holds all sweeps.
/// Errors: those of StarMesh; invalid_parameters at /max_sweeps, /tolerance; cancelled, deadline_exceeded.
/// Cost: 0.15 us a point and sweep; 140 bytes a point.
/// Determinism: sequential; sums in the order of the points.
/// Reference: Persson and Strang, "A Simple Mesh Generator in MATLAB", 2004.
OptimizeResult distmesh(const PointSet& input, const DistMeshOptions& options, Control& control);

/// One sweep's moves, in units of d_hex. Requires: the mesh is Delaunay.
std::vector<Vec2> distmesh_moves(const StarMesh& mesh, const Control& control);
/// The same on any domain, each point in its own units, as far as its freedom lets it.
std::vector<Vec2> distmesh_moves(const MovingSet& set, const Control& control);

}  // namespace wellspaced

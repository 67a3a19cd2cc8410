#pragma once

#include <optional>

#include "core/control.h"
#include "core/optimize/optimize.h"

namespace wellspaced {

struct PushPullOptions {
  double rho = 0.87;              ///< target: r_f / d_hex is at least this; in (0, 1]
  double coverage = 0.65;         ///< target: r_c / d_hex is at most this; at least 1/sqrt(3)
  std::optional<double> area_sd;  ///< target: each cell's area is within this part of the mean; positive
  int max_sweeps = 1000;          ///< at least 1
};

/// Push-pull: absolute targets for the conflict radius, the coverage radius, and, if wanted, the cells'
/// areas. Only points that violate one act: they leave neighbors that are too near, go towards circumcenters
/// that are too far, and pull in (or push off) the neighbors of a cell that is too large (or too small), see
/// push_pull_sweep and capacity_step; until nothing violates a target.
///
/// Where a target is harder than a rho of .9, a coverage of .62, or areas to within .03, radii no harder than
/// those are reached first, then areas to within .03, so that something is won if it is out of reach. .90
/// with .62 (beta .689) is about what the method reaches from MPS.
///
/// Targets so loose that a state which holds them may have a higher beta than the input are tightened until
/// it can't.
///
/// A point moves itself where the paper's moves its neighbors, by part of what is missing; the part grows
/// when the sweeps make no more progress.
///
/// Guarantees: those of OptimizeResult, but a state that holds all targets is preferred to one of lower
/// beta (still never worse than the input); `converged` says whether the returned points, measured apart
/// from the triangulation, hold them all; an input that does is returned bit for bit. `history` holds the
/// sweeps 0, 1, 2, 4, ..., every 64th and the last, a sweep visiting only points that are marked.
/// Errors: those of StarMesh; infeasible at /rho above 1 and at /coverage below 1/sqrt(3), what the
/// triangular lattice has; invalid_parameters at /rho, /coverage, /area_sd, /max_sweeps; cancelled,
/// deadline_exceeded.
/// Cost: 0.04 us a point and sweep on average, since later sweeps visit few points, and 0.3 us where all
/// targets are out of reach; three times as much with areas. 10,000 points from MPS to the default targets
/// take 0.13 s; 180 bytes a point.
/// Determinism: sequential; sweeps, not time, end it.
/// Reference: Ahmed, Guo, Yan, Franceschi, Zhang, Deussen, "A Simple Push-Pull Algorithm for Blue-Noise
/// Sampling", 2017.
OptimizeResult push_pull(const PointSet& input, const PushPullOptions& options, Control& control);

}  // namespace wellspaced

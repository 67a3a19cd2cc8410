#pragma once

#include <cstddef>

#include "core/control.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {

/// What one step aims at and how hard. Lengths in units of d_hex.
struct PushPull {
  double r_f = 0;     ///< no two points nearer than this
  double r_c = 0;     ///< no circumradius above this
  double push = 0.9;  ///< part of an edge's shortfall that a step makes good
  double pull = 2;    ///< the same for a circumradius's excess
  bool look_across =
      false;  ///< also legalize the far edge of each triangle that is too large: needed for low beta
};

/// Visits point i: flips its illegal edges; if it violates a target, moves it away from neighbors that are
/// too near and towards circumcenters that are too far, and marks it and the ends of what still violates.
///
/// Guarantees: the point's triangles stay counter-clockwise (the step is halved until they are, or not made);
/// a step is at most 0.2 d_hex long. Returns whether the point moved.
/// Determinism: plain IEEE float arithmetic in a fixed order, whatever the vector width.
/// Reference: Ahmed, Guo, Yan, Franceschi, Zhang, Deussen, "A Simple Push-Pull Algorithm for Blue-Noise
/// Sampling", 2017, for moving only what violates absolute radii.
bool push_pull_step(StarMesh& mesh, std::size_t i, const PushPull& targets);

struct SweepCount {
  std::size_t visits = 0, moves = 0;
};

/// One step for each marked point, in memory order; points marked on the way and further on are visited too.
/// Errors: cancelled, deadline_exceeded, between two steps.
SweepCount push_pull_sweep(StarMesh& mesh, const PushPull& targets, const Control& control);

}  // namespace wellspaced

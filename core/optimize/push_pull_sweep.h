#pragma once

#include <cstddef>

#include "core/control.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {

/// What a step aims at and how hard. Lengths in units of d_hex.
struct PushPull {
  double r_f = 0;     ///< no two points nearer than this
  double r_c = 0;     ///< no circumradius above this
  double push = 0.9;  ///< part of an edge's shortfall that a step makes good
  double pull = 2;    ///< the same for a circumradius's excess
  bool look_across =
      false;  ///< also legalize the far edge of each triangle that is too large: needed for low beta
};

/// What happened in a sweep.
struct SweepCounts {
  std::size_t visits = 0, moves = 0, flips = 0;
};

/// Visits every marked point once, its mark taken away: flips its illegal edges; if it violates a target,
/// moves it away from neighbors that are too near and towards circumcenters that are too far, and marks it
/// and the ends of what still violates. Even strips first, then the odd ones, on control.threads() threads
/// where that pays; last what reached too far for its strip.
///
/// Guarantees: a moved point's triangles stay counter-clockwise and keep some area, or gain area where they
/// had next to none (the step is halved until they do, or not made); a step is at most 0.2 d_hex long.
/// Errors: cancelled, deadline_exceeded; the mesh is then between two states. Cost: about 0.06 us a visit.
/// Determinism: plain IEEE float arithmetic in a fixed order: the same on any number of threads and any
/// vector width. Reference: Ahmed, Guo, Yan, Franceschi, Zhang, Deussen, "A Simple Push-Pull Algorithm for
/// Blue-Noise Sampling", 2017, for moving only what violates absolute radii.
SweepCounts push_pull_sweep(StarMesh& mesh, const PushPull& targets, const Control& control);

/// The same for one point. Returns whether it moved.
bool push_pull_step(StarMesh& mesh, std::size_t i, const PushPull& targets);

}  // namespace wellspaced

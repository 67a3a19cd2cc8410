#pragma once

#include <limits>
#include <vector>

#include "core/control.h"
#include "core/optimize/optimize.h"
#include "core/voronoi/moving_set.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {

/// The best state, by global beta, of points that an optimizer moves, and the history of its sweeps.
///
/// Requires: input and mesh outlive it; the mesh is Delaunay whenever its state is recorded, and holds the
/// input at sweep 0. Cost: 8 bytes a point.
/// State: a StarMesh or a MovingSet.
template <class State>
class BestState {
 public:
  BestState(const PointSet& input, State& mesh, Control& control);

  /// Notes the mesh as it is after `sweep`, and reports it together with the fraction of work done.
  void record(int sweep, double fraction);
  /// The same where its radii are known already.
  void record(int sweep, double fraction, MeshRadii radii);

  /// Makes the state recorded last the best one, whatever comes later, if it is at least as good as the
  /// input.
  void prefer_last();

  /// The best state; the input, bit for bit, if measuring apart from the mesh finds nothing better. Moves
  /// the mesh's points, so call it once, at the end.
  OptimizeResult result();

 private:
  void note(int sweep, double fraction, MeshRadii radii);
  MeshRadii measure_apart() const;
  void keep(int sweep, double beta);

  const PointSet& input_;
  State& mesh_;
  Control& control_;
  bool narrow_;  // so few points across that the mesh may lack edges that reach around the torus
  typename State::Places best_;
  int best_sweep_ = 0;
  double best_beta_ = std::numeric_limits<double>::infinity();
  bool preferred_ = false;
  std::vector<SweepRecord> history_;
};

extern template class BestState<StarMesh>;
extern template class BestState<MovingSet>;

}  // namespace wellspaced

#include "core/optimize/best_state.h"

#include <algorithm>
#include <utility>

#include "core/analyze/spacing.h"

namespace wellspaced {

namespace {

/// So few points across that the mesh may lack edges that reach around the torus.
bool is_narrow(const PointSet& input, const StarMesh& mesh) {
  constexpr double points_across = 12;
  const Box box = input.domain->box();
  return std::min(box.size.x, box.size.y) < points_across * mesh.spacing();
}

bool is_narrow(const PointSet&, const MovingSet&) { return false; }

}  // namespace

template <class State>
BestState<State>::BestState(const PointSet& input, State& mesh, Control& control)
    : input_(input), mesh_(mesh), control_(control), narrow_(is_narrow(input, mesh)) {}

template <class State>
void BestState<State>::record(int sweep, double fraction) {
  note(sweep, fraction, narrow_ ? measure_apart() : mesh_.measure(control_));
}

template <class State>
void BestState<State>::record(int sweep, double fraction, MeshRadii radii) {
  note(sweep, fraction, narrow_ ? measure_apart() : radii);
}

template <class State>
MeshRadii BestState<State>::measure_apart() const {
  const GlobalRatio ratio = measure_ratio(mesh_.points(input_, control_), control_);
  return {ratio.r_f / mesh_.spacing(), ratio.r_c / mesh_.spacing()};
}

template <class State>
void BestState<State>::note(int sweep, double fraction, MeshRadii radii) {
  const double d = mesh_.spacing(), beta = radii.outermost / radii.shortest;
  history_.push_back({sweep, beta, radii.outermost * d, radii.shortest * d});
  if (beta < best_beta_ && !preferred_) keep(sweep, beta);
  control_.report({std::min(1.0, fraction), sweep, beta, radii.outermost * d, radii.shortest * d});
}

template <class State>
void BestState<State>::prefer_last() {
  const SweepRecord& last = history_.back();
  if (last.beta > history_.front().beta) return;
  keep(last.sweep, last.beta);
  preferred_ = true;
}

template <class State>
void BestState<State>::keep(int sweep, double beta) {
  best_sweep_ = sweep;
  best_beta_ = beta;
  if (sweep == 0) return;  // that is the input itself
  best_ = mesh_.places();
}

template <class State>
OptimizeResult BestState<State>::result() {
  const int sweeps = history_.back().sweep;
  OptimizeResult result{input_, {}, sweeps, std::move(history_), static_cast<double>(sweeps)};
  if (best_sweep_ == 0) return result;
  mesh_.put(best_);
  PointSet best = mesh_.points(input_, control_);
  const double after = measure_ratio(best, control_).beta();
  // The first record is the input's to within the mesh's rounding: only a close call needs the input itself.
  const bool better = after < 0.999 * result.history.front().beta;
  if (better || after < measure_ratio(input_, control_).beta()) result.points = std::move(best);
  return result;
}

template class BestState<StarMesh>;
template class BestState<MovingSet>;

}  // namespace wellspaced

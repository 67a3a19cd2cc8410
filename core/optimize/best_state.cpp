#include "core/optimize/best_state.h"

#include <algorithm>
#include <utility>

#include "core/analyze/spacing.h"

namespace wellspaced {

BestState::BestState(const PointSet& input, StarMesh& mesh, Control& control)
    : input_(input), mesh_(mesh), control_(control) {
  constexpr double points_across = 12;
  const Box box = input.domain->box();
  narrow_ = std::min(box.size.x, box.size.y) < points_across * mesh.spacing();
}

void BestState::record(int sweep, double fraction) {
  note(sweep, fraction, narrow_ ? measure_apart() : mesh_.measure(control_));
}

void BestState::record(int sweep, double fraction, MeshRadii radii) {
  note(sweep, fraction, narrow_ ? measure_apart() : radii);
}

MeshRadii BestState::measure_apart() const {
  const GlobalRatio ratio = measure_ratio(mesh_.points(input_, control_), control_);
  return {ratio.r_f / mesh_.spacing(), ratio.r_c / mesh_.spacing()};
}

void BestState::note(int sweep, double fraction, MeshRadii radii) {
  const double d = mesh_.spacing(), beta = radii.outermost / radii.shortest;
  history_.push_back({sweep, beta, radii.outermost * d, radii.shortest * d});
  if (beta < best_beta_ && !preferred_) keep(sweep, beta);
  control_.report({std::min(1.0, fraction), sweep, beta, radii.outermost * d, radii.shortest * d});
}

void BestState::prefer_last() {
  const SweepRecord& last = history_.back();
  if (last.beta > history_.front().beta) return;
  keep(last.sweep, last.beta);
  preferred_ = true;
}

void BestState::keep(int sweep, double beta) {
  best_sweep_ = sweep;
  best_beta_ = beta;
  if (sweep == 0) return;  // that is the input itself
  best_.resize(mesh_.size());
  for (std::size_t i = 0; i < best_.size(); ++i) best_[i] = mesh_.at(i);
}

OptimizeResult BestState::result() {
  const int sweeps = history_.back().sweep;
  OptimizeResult result{input_, {}, sweeps, std::move(history_), static_cast<double>(sweeps)};
  if (best_sweep_ == 0) return result;
  for (std::size_t i = 0; i < best_.size(); ++i) mesh_.move_to(i, best_[i]);
  PointSet best = mesh_.points(input_, control_);
  const double after = measure_ratio(best, control_).beta();
  // The first record is the input's to within the mesh's rounding: only a close call needs the input itself.
  const bool better = after < 0.999 * result.history.front().beta;
  if (better || after < measure_ratio(input_, control_).beta()) result.points = std::move(best);
  return result;
}

}  // namespace wellspaced

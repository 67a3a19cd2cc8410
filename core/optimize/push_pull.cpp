#include "core/optimize/push_pull.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/optimize/best_state.h"
#include "core/optimize/calm.h"
#include "core/optimize/capacity_step.h"
#include "core/optimize/cell_sweep.h"
#include "core/optimize/push_pull_sweep.h"
#include "core/optimize/require.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/star_mesh.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

constexpr std::size_t between_checks = 4096;
constexpr double tight = 1e-5;  // targets are tested in float: aim at a little more

void require_options(const PushPullOptions& o) {
  if (o.rho > 1)
    throw Error(
        ErrorCode::infeasible,
        "no point set in the plane has r_f above d_hex, that of the triangular lattice: rho is at most 1",
        "/rho");
  if (!(o.rho > 0)) throw Error(ErrorCode::invalid_parameters, "rho must be in (0, 1]", "/rho");
  if (o.coverage < 1 / std::sqrt(3.0))
    throw Error(ErrorCode::infeasible,
                "no point set in the plane has r_c below d_hex/sqrt(3), that of the triangular lattice: "
                "coverage is at least 0.57735",
                "/coverage");
  if (!std::isfinite(o.coverage))
    throw Error(ErrorCode::invalid_parameters, "coverage must be a number of at least 0.57735", "/coverage");
  if (o.area_sd && !(*o.area_sd > 0))
    throw Error(ErrorCode::invalid_parameters, "area_sd must be positive", "/area_sd");
  require_sweeps(o.max_sweeps);
}

/// What the targets are held against, in units of d_hex and of the mean area; from the points alone.
struct Measured {
  double r_f, r_c, area_deviation;

  bool holds(const PushPullOptions& o) const {
    return r_f >= o.rho && r_c <= o.coverage && (!o.area_sd || area_deviation <= *o.area_sd);
  }
};

Measured measure(const MovingSet& set, const Control& control) {
  const MeshRadii radii = set.measure(control);
  double deviation = 0;
  for (const double d : area_deviations(set, control)) deviation = std::max(deviation, std::abs(d));
  return {radii.shortest, radii.outermost, deviation};
}

Measured measure(const PointSet& points, const Control& control) {
  if (!is_plain_torus(points)) return measure(MovingSet(points, control), control);
  const double d = hexagonal_spacing(points.domain->area(), points.size());
  const double mean_area = points.domain->area() / static_cast<double>(points.size());
  std::vector<Measured> locals(points.size());
  visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
    Measured m{norm(spokes[0].offset), 0, 0};
    double twice_area = 0;
    Vec2 before = circumcenter(spokes.back().offset, spokes.front().offset);
    for (std::size_t k = 0; k < spokes.size(); ++k) {
      const Vec2 center = circumcenter(spokes[k].offset, spokes[k + 1 == spokes.size() ? 0 : k + 1].offset);
      m.r_f = std::min(m.r_f, norm(spokes[k].offset));
      m.r_c = std::max(m.r_c, norm(center));
      twice_area += cross(before, center);
      before = center;
    }
    m.area_deviation = std::abs(twice_area / (2 * mean_area) - 1);
    locals[i] = m;
  });
  Measured all = locals[0];
  for (const Measured& m : locals)
    all = {std::min(all.r_f, m.r_f), std::max(all.r_c, m.r_c),
           std::max(all.area_deviation, m.area_deviation)};
  return {all.r_f / d, all.r_c / d, all.area_deviation};
}

/// What a unit is for a point whose radius is 1.
double unit_length(const PointSet& points, const Control& control) {
  return is_plain_torus(points) ? hexagonal_spacing(points.domain->area(), points.size())
                                : MovingSet(points, control).spacing();
}

/// Targets so loose that holding them may make beta worse than it was are tightened: rho as far as is easy,
/// then coverage.
PushPullOptions tightened(PushPullOptions o, double beta) {
  constexpr double easy_rho = .82;
  o.rho = std::max(o.rho, std::min(easy_rho, o.coverage / beta));
  o.coverage = std::min(o.coverage, std::max(o.rho * beta, 1 / std::sqrt(3.0)));
  return o;
}

PushPull targets_of(const PushPullOptions& o) {
  PushPull targets;
  targets.r_f = o.rho * (1 + tight);
  targets.r_c = o.coverage * (1 - tight);
  // Lower ratios freeze with small weights; higher ones keep more of the input's randomness with them.
  const double ratio = o.coverage / o.rho;
  targets.push = ratio > .73 ? .7 : ratio > .709 ? 1.1 : 1.3;
  targets.pull = ratio > .73 ? .7 : 2;
  targets.look_across = ratio < .70;
  return targets;
}

template <class State>
class Relaxation {
 public:
  Relaxation(const PointSet& input, const PushPullOptions& options, Control& control)
      : options_(options), control_(control), mesh_(input, control), best_(input, mesh_, control) {
    best_.record(0, 0);
  }

  OptimizeResult run() {
    for (const PushPullOptions& stage : stages()) {
      if (!relax(stage)) break;
      if (stage.area_sd || holds_all(stage)) best_.prefer_last();
    }
    OptimizeResult result = best_.result();
    result.visits = static_cast<double>(visits_) / static_cast<double>(mesh_.size());
    return result;
  }

 private:
  /// Targets that are hard or out of reach make points wander; a state that is known to be reached comes
  /// first, so that something is won in any case.
  std::vector<PushPullOptions> stages() const {
    constexpr double largest_rho = .9, least_coverage = .62, least_area_sd = .03;
    PushPullOptions radii = options_;
    radii.rho = std::min(options_.rho, largest_rho);
    radii.coverage = std::max(options_.coverage, least_coverage);
    radii.area_sd.reset();
    PushPullOptions areas = radii;
    areas.area_sd = least_area_sd;
    const bool hard_areas = options_.area_sd && *options_.area_sd < least_area_sd;
    if (hard_areas) return {radii, areas, options_};
    if (radii.rho != options_.rho || radii.coverage != options_.coverage) return {radii, options_};
    return {options_};
  }

  bool holds_all(const PushPullOptions& stage) const {
    return stage.rho == options_.rho && stage.coverage == options_.coverage &&
           stage.area_sd == options_.area_sd;
  }

  /// Whether all targets hold in the end.
  bool relax(const PushPullOptions& aims) {
    PushPull targets = targets_of(aims);
    Calm calm;
    mesh_.mark_all();
    while (sweeps_ < options_.max_sweeps) {
      const SweepCounts count = aims.area_sd ? sweep_with_areas(targets, area_target(aims))
                                             : push_pull_sweep(mesh_, targets, control_);
      ++sweeps_;
      visits_ += count.visits;
      const bool clean = !mesh_.any_marked() && is_clean(aims);
      if (clean || std::has_single_bit(static_cast<unsigned>(sweeps_)) || sweeps_ % 64 == 0 ||
          sweeps_ == options_.max_sweeps)
        record();
      if (clean) return true;
      if (calm.lasts(count.moves, mesh_.size())) {
        targets.push = std::min(1.6, targets.push * 1.08);
        targets.pull = std::min(2.0, targets.pull * 1.08);
      }
    }
    return false;
  }

  static double area_target(const PushPullOptions& aims) { return *aims.area_sd * (1 - tight); }

  SweepCounts sweep_with_areas(const PushPull& targets, double most) {
    return sweep_with_areas(mesh_, targets, most);
  }

  /// Points that violate a radius act for themselves, then all cells push or pull their neighbors at once.
  SweepCounts sweep_with_areas(MovingSet& set, const PushPull& targets, double most) {
    SweepCounts count = push_pull_sweep(set, targets, control_);
    count.moves += capacity_sweep(set, most, control_);
    count.visits += set.size();
    return count;
  }

  SweepCounts sweep_with_areas(StarMesh& mesh, const PushPull& targets, double most) {
    SweepCounts count;
    for (std::size_t i = 0; (i = mesh.take_marked(i, mesh.size())) < mesh.size(); ++i) {
      if (++count.visits % between_checks == 0) control_.check();
      const bool moved = push_pull_step(mesh, i, targets);
      const bool corrected = capacity_step(mesh, i, most);
      count.moves += moved || corrected ? 1 : 0;
      if (!moved || corrected) continue;
      for (int k = 0; k < mesh.star(i).degree; ++k) mesh.mark(mesh.star(i).neighbor[k]);
    }
    control_.check();
    return count;
  }

  /// Looks for what the marks may have missed; marks it.
  bool is_clean(const PushPullOptions& aims) {
    mesh_.legalize_all(control_);
    mark_violations(mesh_, aims);
    return !mesh_.any_marked();
  }

  void mark_violations(StarMesh& mesh, const PushPullOptions& aims) const {
    if (!aims.area_sd) return;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
      if (i % between_checks == 0) control_.check();
      if (std::abs(area_deviation(mesh, i)) > area_target(aims)) mesh.mark(i);
    }
  }

  void mark_violations(MovingSet& set, const PushPullOptions& aims) const {
    const MeshRadii radii = set.measure(control_);
    if (radii.shortest < aims.rho || radii.outermost > aims.coverage) set.mark_all();
    if (!aims.area_sd) return;
    const std::vector<double> deviations = area_deviations(set, control_);
    for (std::size_t i = 0; i < set.size(); ++i)
      if (std::abs(deviations[i]) > area_target(aims)) set.mark(i);
  }

  void record() {
    mesh_.legalize_all(control_);
    best_.record(sweeps_, static_cast<double>(sweeps_) / options_.max_sweeps);
  }

  const PushPullOptions& options_;
  Control& control_;
  State mesh_;
  BestState<State> best_;
  int sweeps_ = 0;
  std::size_t visits_ = 0;
};

}  // namespace

OptimizeResult push_pull(const PointSet& input, const PushPullOptions& options, Control& control) {
  require_options(options);
  require_usable(input, control);
  const Measured before = measure(input, control);
  if (before.holds(options)) {
    const double d = unit_length(input, control);
    return {input, true, 0, {{0, before.r_c / before.r_f, before.r_c * d, before.r_f * d}}};
  }
  const PushPullOptions aims = tightened(options, before.r_c / before.r_f);
  OptimizeResult result = is_plain_torus(input) ? Relaxation<StarMesh>(input, aims, control).run()
                                                : Relaxation<MovingSet>(input, aims, control).run();
  result.converged = measure(result.points, control).holds(options);
  return result;
}

}  // namespace wellspaced

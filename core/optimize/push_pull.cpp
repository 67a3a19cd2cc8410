#include "core/optimize/push_pull.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/optimize/best_state.h"
#include "core/optimize/calm.h"
#include "core/optimize/capacity_step.h"
#include "core/optimize/push_pull_sweep.h"
#include "core/optimize/require.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/star_mesh.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

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

Measured measure(const PointSet& points, const Control& control) {
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

class Relaxation {
 public:
  Relaxation(const PointSet& input, const PushPullOptions& options, Control& control)
      : options_(options), control_(control), mesh_(input, control), best_(input, mesh_, control) {
    best_.record(0, 0);
  }

  OptimizeResult run() {
    PushPull targets = targets_of(options_);
    Calm calm;
    mesh_.mark_all();
    for (int sweep = 1; sweep <= options_.max_sweeps; ++sweep) {
      const SweepCounts count =
          options_.area_sd ? sweep_with_areas(targets) : push_pull_sweep(mesh_, targets, control_);
      const bool clean = !mesh_.any_marked() && is_clean();
      if (clean || std::has_single_bit(static_cast<unsigned>(sweep)) || sweep % 64 == 0 ||
          sweep == options_.max_sweeps)
        record(sweep);
      if (clean) {
        best_.prefer_last();
        break;
      }
      if (calm.lasts(count.moves, mesh_.size())) {
        targets.push = std::min(1.6, targets.push * 1.08);
        targets.pull = std::min(2.0, targets.pull * 1.08);
      }
    }
    return best_.result();
  }

 private:
  SweepCounts sweep_with_areas(const PushPull& targets) {
    constexpr std::size_t between_checks = 4096;
    SweepCounts count;
    for (std::size_t i = 0; (i = mesh_.take_marked(i, mesh_.size())) < mesh_.size(); ++i) {
      if (++count.visits % between_checks == 0) control_.check();
      const bool moved = push_pull_step(mesh_, i, targets);
      const bool corrected = capacity_step(mesh_, i, area_target());
      count.moves += moved || corrected ? 1 : 0;
      if (!moved || corrected) continue;
      for (int k = 0; k < mesh_.star(i).degree; ++k) mesh_.mark(mesh_.star(i).neighbor[k]);
    }
    return count;
  }

  double area_target() const { return *options_.area_sd * (1 - tight); }

  /// Looks for what the marks may have missed; marks it.
  bool is_clean() {
    mesh_.legalize_all(control_);
    if (options_.area_sd)
      for (std::size_t i = 0; i < mesh_.size(); ++i)
        if (std::abs(area_deviation(mesh_, i)) > area_target()) mesh_.mark(i);
    return !mesh_.any_marked();
  }

  void record(int sweep) {
    mesh_.legalize_all(control_);
    best_.record(sweep, static_cast<double>(sweep) / options_.max_sweeps);
  }

  const PushPullOptions& options_;
  Control& control_;
  StarMesh mesh_;
  BestState best_;
};

}  // namespace

OptimizeResult push_pull(const PointSet& input, const PushPullOptions& options, Control& control) {
  require_options(options);
  require_usable(input, control);
  const Measured before = measure(input, control);
  if (before.holds(options)) {
    const double d = hexagonal_spacing(input.domain->area(), input.size());
    return {input, true, 0, {{0, before.r_c / before.r_f, before.r_c * d, before.r_f * d}}};
  }
  OptimizeResult result = Relaxation(input, options, control).run();
  result.converged = measure(result.points, control).holds(options);
  return result;
}

}  // namespace wellspaced

#include "core/optimize/opt_beta.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/analyze/spacing.h"
#include "core/error.h"
#include "core/optimize/calm.h"
#include "core/optimize/cell_sweep.h"
#include "core/optimize/move_all.h"
#include "core/optimize/opt_beta_local.h"
#include "core/optimize/opt_beta_targets.h"
#include "core/optimize/push_pull_sweep.h"
#include "core/optimize/ripening.h"
#include "core/rng.h"
#include "core/voronoi/moving_set.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {
namespace {

// Lower targets than these melt the triangulation unless approached in steps.
constexpr double surely_reached = 0.70, often_reached = 0.69;
constexpr double floor_beta = 0.57735026918962573;
constexpr int visits_to_sure_targets = 250, visits_to_all = 20000;  // a point

void require_options(const OptBetaOptions& o) {
  if (!(o.beta >= floor_beta))
    throw Error(
        ErrorCode::infeasible,
        "no point set in the plane has beta below 1/sqrt(3) = 0.57735 (the triangular lattice); ask for more",
        "/beta");
  if (!(o.beta < 1))
    throw Error(ErrorCode::invalid_parameters,
                "the target must be below 1: every maximal Poisson-disk sampling already has beta <= 1",
                "/beta");
  if (o.max_visits && *o.max_visits < 1)
    throw Error(ErrorCode::invalid_parameters, "at least one visit a point is needed", "/max_visits");
}

/// Which of a stage's sweeps are measured, which takes as long as a sweep: for a curve of a few steps an
/// octave where that takes no time to speak of, for large sets only 1, 8, 64 and then twice as many each
/// time.
bool is_recorded(int sweep, std::size_t n) {
  constexpr std::size_t few_points = 5'000;
  const auto is_power_of_two = [](int k) { return (k & (k - 1)) == 0; };
  if (n <= few_points)
    return is_power_of_two(sweep) || (sweep % 3 == 0 && is_power_of_two(sweep / 3)) || sweep % 64 == 0;
  return sweep == 1 || sweep == 8 || (sweep >= 64 && is_power_of_two(sweep));
}

/// Marks what still violates the targets though nothing is marked. How many edges were flipped.
std::size_t confirm(StarMesh& mesh, const PushPull&, const Control& control) {
  return mesh.legalize_all(control);
}

std::size_t confirm(MovingSet& set, const PushPull& targets, const Control& control) {
  const MeshRadii radii = set.measure(control);
  if (radii.shortest < targets.r_f || radii.outermost > targets.r_c) set.mark_all();
  return 0;
}

/// On a StarMesh or, for domains that it can't hold, a MovingSet.
template <class State>
class Descent {
 public:
  template <class... From>
  Descent(std::tuple<From...> from, const PointSet& input, const OptBetaOptions& options, Control& control)
      : input_(input),
        options_(options),
        control_(control),
        mesh_(std::make_from_tuple<State>(std::move(from))),
        best_(mesh_.places()) {
    constexpr double cheap = 1e5;  // visits in all that nobody notices
    budget_ = static_cast<double>(allowed_visits(options)) * static_cast<double>(mesh_.size());
    if (!options.max_visits) budget_ = std::max(budget_, cheap);
    record();
  }

  OptimizeResult run() {
    if (best_beta_ > options_.beta) {
      const double first = leap();
      if (options_.beta < first) lower(first);
    }
    if constexpr (std::is_same_v<State, MovingSet>)
      if (best_beta_ > options_.beta && !options_.max_visits) settle_for_less();
    return result();
  }

 private:
  struct Allowance {
    double visits, flips;  // in all, over all points
    bool escalate;         // raise the weights when nothing moves forward
    // Sweeps before edges are looked across, which at first costs more than it brings.
    int look_across_after = std::numeric_limits<int>::max();
  };

  static constexpr double no_limit = std::numeric_limits<double>::infinity();

  /// As far as can be got without steps. Returns the target that was reached, or 0 if the budget is used up.
  double leap() {
    constexpr double flips_a_point = 20, visits_a_point = 200;
    const auto n = static_cast<double>(mesh_.size());
    if (options_.beta < surely_reached) {
      const typename State::Snapshot start = mesh_.snapshot();
      const double boldly = std::max(options_.beta, often_reached);
      const bool clean = relax(opt_beta_targets(boldly, options_.randomness),
                               {visits_a_point * n, flips_a_point * n, false, 100});
      record();
      if (clean) return boldly;
      mesh_.restore(start);
    }
    const double first = std::max(options_.beta, surely_reached);
    const bool clean = reach(first);
    record();
    return clean ? first : 0;
  }

  /// A set may freeze, above all one of few points near gentle's radii, or a lattice, whose pushes and pulls
  /// cancel. It is then shaken, and moved on by targets that are easier to come to from there, however much
  /// randomness they cost.
  bool reach(double beta) {
    struct Rescue {
      double beta, push, pull;
    };
    constexpr std::array<Rescue, 5> rescues = {
        {{1, 1.3, 2}, {.69, 1.6, 2}, {.70, 1.6, 2}, {.69, 1.3, 2}, {.68, 1.3, 1.7}}};
    const double most = std::min(budget_, visits_to_sure_targets * static_cast<double>(mesh_.size()));
    if (relax(opt_beta_targets(beta, options_.randomness), {.5 * most, no_limit, true})) return true;
    for (std::size_t k = 0; visits_ < budget_; ++k) {
      record();
      shake();
      const Rescue& rescue = rescues[k % rescues.size()];
      const PushPull targets = opt_beta_targets(std::min(beta, rescue.beta), rescue.push, rescue.pull);
      if (relax(targets, {.08 * most, no_limit, true})) return true;
    }
    return false;
  }

  /// Returns how many points moved.
  std::size_t sweep_once(const PushPull& targets) {
    const SweepCounts count = push_pull_sweep(mesh_, targets, control_);
    visits_ += static_cast<double>(count.visits);
    flips_ += static_cast<double>(count.flips);
    ++sweeps_;
    return count.moves;
  }

  void shake() {
    constexpr double farthest = .03;
    std::vector<Vec2> moves(mesh_.size());
    for (Vec2& move : moves)
      move = {farthest * (2 * rng_.uniform() - 1), farthest * (2 * rng_.uniform() - 1)};
    move_all(mesh_, moves, input_, control_);
  }

  /// Sweeps over marked points until nothing violates the targets. False: the allowance is used up.
  bool relax(PushPull targets, const Allowance& allowance) {
    const double visits_before = visits_;
    const double flips_before = flips_;
    Calm calm;
    mesh_.mark_all();
    for (int sweep = 1;; ++sweep) {
      targets.look_across = sweep > allowance.look_across_after;
      const std::size_t moves = sweep_once(targets);
      if (!mesh_.any_marked()) {
        flips_ += static_cast<double>(confirm(mesh_, targets, control_));
        if (!mesh_.any_marked()) return true;
      }
      if (is_recorded(sweep, mesh_.size()))
        record();
      else
        report(history_.back());
      if (allowance.escalate && calm.lasts(moves, mesh_.size())) {
        targets.push = std::min(1.6, targets.push * 1.08);
        targets.pull = std::min(2.0, std::max(targets.pull, targets.pull * 1.08));
      }
      if (visits_ - visits_before > allowance.visits || visits_ > budget_) return false;
      if (flips_ - flips_before > allowance.flips) return false;
    }
  }

  /// Below what can be reached at once: small steps, each from the last state that was clean, or from what
  /// has ripened out of it.
  void lower(double beta) {
    constexpr std::array<std::pair<double, double>, 7> weights = {
        {{1.3, 1.7}, {1.2, 1.6}, {1.3, 1.5}, {1.15, 1.4}, {1.4, 1.5}, {1.2, 1.9}, {1.05, 1.3}}};
    constexpr double largest_step = .004, smallest_step = 5e-4, flips_a_point = 20;
    const auto n = static_cast<double>(mesh_.size());
    typename State::Snapshot start = mesh_.snapshot();
    Ripening ripening;
    double step = largest_step;
    std::size_t choice = 0;
    for (int failures = 0; beta > options_.beta && visits_ < budget_;) {
      const double next = std::max(options_.beta, beta - step);
      const auto [push, pull] = weights[choice];
      const PushPull targets = opt_beta_targets(next, push, pull);
      if (relax(targets, {ripening.patience() * n, flips_a_point * n, false, 0})) {
        beta = next;
        start = mesh_.snapshot();
        record();
        failures = 0;
        ripening.restart();
        step = std::min(largest_step, step * 1.4);
        continue;
      }
      choice = (choice + 1) % weights.size();
      mesh_.restore(start);
      if (++failures < 2) continue;
      step = std::max(smallest_step, step * .9);
      ripen(ripening.next());
      start = mesh_.snapshot();
    }
  }

  /// Some targets can't be had, as where a curve of the boundary has too many points, which stay on it; and
  /// points that go after one are no better off for it. So the least that can be had is looked for, between
  /// the target and the best so far, each time from the last state that was clean.
  void settle_for_less() {
    constexpr double visits_a_point = 40, fewest_visits = 2e4, near = 2e-3;
    const double most = std::max(fewest_visits, visits_a_point * static_cast<double>(mesh_.size()));
    double low = options_.beta, high = std::min(best_beta_, .99);
    typename State::Places start = input_.coordinates;
    while (high - low > near) {
      const double middle = 0.5 * (low + high);
      budget_ = visits_ + most;
      mesh_.put(start);
      const bool clean = relax(opt_beta_targets(middle, options_.randomness), {most, no_limit, true});
      record();
      if (clean) start = mesh_.places();
      (clean ? high : low) = middle;
    }
  }

  void ripen(const Ripening::Portion& portion) {
    const double enough = std::min(budget_, visits_ + portion.visits * static_cast<double>(mesh_.size()));
    mesh_.mark_all();
    while (mesh_.any_marked() && visits_ < enough) {
      sweep_once(portion.targets);
      report(history_.back());
    }
    flips_ += static_cast<double>(mesh_.legalize_all(control_));
  }

  /// Measures the state, and keeps it if it is the best so far. Between sweeps a few edges are not Delaunay,
  /// whose triangles would be measured for too large.
  void record() {
    if (sweeps_ > 0) flips_ += static_cast<double>(mesh_.legalize_all(control_));
    const MeshRadii radii = mesh_.measure(control_);
    const double beta = radii.outermost / radii.shortest, d = mesh_.spacing();
    if (!history_.empty() && history_.back().sweep == sweeps_) history_.pop_back();
    history_.push_back({sweeps_, beta, radii.outermost * d, radii.shortest * d});
    if (beta < best_beta_) {
      best_beta_ = beta;
      if (sweeps_ > 0) best_ = mesh_.places();
    }
    report(history_.back());
  }

  /// How far the work is, and what was last measured.
  void report(const SweepRecord& last) {
    control_.report({std::min(1.0, visits_ / budget_), last.sweep, last.beta, last.r_c, last.r_f});
  }

  OptimizeResult result() {
    mesh_.put(best_);
    OptimizeResult result{mesh_.points(input_, control_), false, sweeps_, std::move(history_),
                          visits_ / static_cast<double>(mesh_.size())};
    // What the mesh says of its places is right for the points to within this, but for points in a line.
    constexpr double rounding = 1e-6;
    const double before = result.history.front().beta;
    if (best_beta_ <= options_.beta * (1 - rounding) && best_beta_ < before * (1 - rounding)) {
      result.converged = true;
      return result;
    }
    double beta = measure_ratio(result.points, control_).beta();
    if (const double input_beta = measure_ratio(input_, control_).beta(); !(beta < input_beta)) {
      result.points = input_;  // a set that isn't better is not worth having
      beta = input_beta;
    }
    result.converged = beta <= options_.beta;
    return result;
  }

  const PointSet& input_;
  const OptBetaOptions& options_;
  Control& control_;
  State mesh_;
  typename State::Places best_;  // stars are not needed to tell the points
  double best_beta_ = std::numeric_limits<double>::infinity();
  double visits_ = 0, flips_ = 0, budget_ = 0;
  int sweeps_ = 0;
  Rng rng_{0x5ba4e};
  std::vector<SweepRecord> history_;
};

/// Nothing if the points are too unevenly spread.
std::optional<StarMesh> try_mesh(const PointSet& points, const Control& control) {
  try {
    return StarMesh(points, control);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::degenerate_input) throw;
    return std::nullopt;
  }
}

/// Point by point, for sets that a mesh can't hold.
OptimizeResult by_local_ratios(const PointSet& input, const OptBetaOptions& options, int most_sweeps,
                               Control& control) {
  return opt_beta_local(input, {options.beta, std::min(most_sweeps, allowed_visits(options)), {}}, control);
}

OptimizeResult one_after_the_other(OptimizeResult first, OptimizeResult second) {
  for (SweepRecord& record : second.history) record.sweep += first.sweeps;
  first.history.insert(first.history.end(), second.history.begin() + 1, second.history.end());
  second.history = std::move(first.history);
  second.sweeps += first.sweeps;
  second.visits += first.visits;
  return second;
}

OptimizeResult descend(const PointSet& input, const OptBetaOptions& options, Control& control) {
  return Descent<MovingSet>(std::tie(input, std::as_const(control)), input, options, control).run();
}

/// Where corners of cells are searched for, what is found of them may differ by a little from one search to
/// the next: a little more is aimed at, and the result is measured anew, as others will measure it.
OptimizeResult on_inexact_cells(const PointSet& input, const OptBetaOptions& options, Control& control) {
  constexpr double uncertain = 3e-4;
  OptBetaOptions aims = options;
  if (measure_ratio(input, control).beta() > options.beta)
    aims.beta = std::max(floor_beta, options.beta * (1 - uncertain));
  OptimizeResult result = descend(input, aims, control);
  result.converged = measure_ratio(result.points, control).beta() <= options.beta;
  return result;
}

}  // namespace

int allowed_visits(const OptBetaOptions& options) {
  return options.max_visits.value_or(options.beta < surely_reached ? visits_to_all : visits_to_sure_targets);
}

int expected_visits(const OptBetaOptions& options) {
  struct Row {
    double beta;
    int visits;
  };
  constexpr std::array<Row, 5> rows = {{{.70, 100}, {.69, 120}, {.68, 800}, {.67, 4000}, {.66, 15000}}};
  for (const Row& row : rows)
    if (options.beta >= row.beta) return std::min(row.visits, allowed_visits(options));
  return allowed_visits(options);
}

OptimizeResult opt_beta(const PointSet& input, const OptBetaOptions& options, Control& control) {
  constexpr int sweeps_to_even_out = 3;
  const int most_sweeps = allowed_visits(options);
  require_options(options);
  require_usable(input, control);
  if (!input.domain->has_exact_cells()) return on_inexact_cells(input, options, control);
  if (!is_plain_torus(input)) return descend(input, options, control);
  if (StarMesh::why_too_small(*input.domain, input.size()))
    return by_local_ratios(input, options, most_sweeps, control);
  if (auto mesh = try_mesh(input, control))
    return Descent<StarMesh>(std::forward_as_tuple(std::move(*mesh)), input, options, control).run();
  OptimizeResult evened = by_local_ratios(input, options, sweeps_to_even_out, control);
  while (evened.converged != true && evened.sweeps < most_sweeps) {
    if (auto mesh = try_mesh(evened.points, control)) {
      OptimizeResult result =
          Descent<StarMesh>(std::forward_as_tuple(std::move(*mesh)), evened.points, options, control).run();
      return one_after_the_other(std::move(evened), std::move(result));
    }
    const int more = std::min(evened.sweeps, most_sweeps - evened.sweeps);  // from the best state again
    OptimizeResult further = by_local_ratios(evened.points, options, more, control);
    evened = one_after_the_other(std::move(evened), std::move(further));
  }
  return evened;
}

}  // namespace wellspaced

#include "core/optimize/opt_beta_local.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "core/analyze/spacing.h"
#include "core/error.h"
#include "core/optimize/nelder_mead.h"
#include "core/sort.h"
#include "core/voronoi/moving_set.h"

namespace wellspaced {
namespace {

constexpr int nelder_mead_steps = 10;
constexpr double mps_rho = 0.777;  // r_f / d_hex of maximal Poisson-disk samplings: the paper's r

void require_options(const OptBetaLocalOptions& o) {
  if (!(o.beta >= 1 / std::sqrt(3.0)))
    throw Error(
        ErrorCode::infeasible,
        "no point set in the plane has beta below 1/sqrt(3) = 0.57735 (the triangular lattice); ask for more",
        "/beta");
  if (!(o.beta < 1))
    throw Error(ErrorCode::invalid_parameters,
                "the target must be below 1: every maximal Poisson-disk sampling already has beta <= 1",
                "/beta");
  if (o.max_sweeps < 1)
    throw Error(ErrorCode::invalid_parameters, "at least one sweep is needed", "/max_sweeps");
  if (o.damping && !(*o.damping > 0 && *o.damping <= 1))
    throw Error(ErrorCode::invalid_parameters, "damping must be in (0, 1]", "/damping");
}

/// Row by row, left to right, on curved domains layer by layer; rows as high as the spacing.
std::vector<std::uint32_t> scan_line_order(const PointSet& points, double spacing, const Control& control) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](Vec3 p) {
    return std::tuple(std::floor(p.z / spacing), std::floor(p.y / spacing), p.x);
  };
  sort(order.begin(), order.end(), control, [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple_cat(key(points[a]), std::tuple(a)) < std::tuple_cat(key(points[b]), std::tuple(b));
  });
  return order;
}

SweepRecord record(int sweep, const PointSet& points, const Control& control) {
  const GlobalRatio ratio = measure_ratio(points, control);
  return {sweep, ratio.beta(), ratio.r_c, ratio.r_f};
}

SweepRecord record(int sweep, const MovingSet& set, const Control& control) {
  if (is_plain_torus(set.points())) return record(sweep, set.points(), control);  // faster
  const MeshRadii radii = set.measure(control);
  return {sweep, radii.outermost / radii.shortest, radii.outermost * set.spacing(),
          radii.shortest * set.spacing()};
}

class Sweeper {
 public:
  Sweeper(const PointSet& input, double damping, const Control& control)
      : set_(input, control),
        damping_(damping),
        order_(scan_line_order(input, hexagonal_spacing(*input.domain, input.size()), control)),
        finder_(set_.finder(control)) {}

  void sweep(const Control& control) {
    for (const std::uint32_t i : order_) {
      control.check();
      visit(i);
    }
  }

  const MovingSet& set() const { return set_; }

 private:
  void visit(std::uint32_t i) {
    if (set_.freedom(i).dimensions == 0) return;
    finder_.load(i, 2 * set_.unit(i));
    const Vec2 best = set_.domain().possible(set_[i], damping_ * best_move(i));
    if (best != Vec2{}) set_.move_to(i, set_.domain().step(set_[i], best));
  }

  /// Over the domain, or along the curve that the point is on.
  Vec2 best_move(std::uint32_t i) {
    const Vec3 from = set_[i];
    const double size = mps_rho * set_.unit(i) / 10;
    const auto beta_i = [&](Vec2 u) {
      const CellFinder::Radii radii = finder_.radii_at(set_.domain().possible(from, u));
      return radii.r_c / radii.r_f;
    };
    if (set_.freedom(i).dimensions == 2) return nelder_mead(beta_i, size, nelder_mead_steps).at;
    const Vec2 along = set_.freedom(i).along;
    return nelder_mead_on_line([&](double t) { return beta_i(t * along); }, size, nelder_mead_steps) * along;
  }

  MovingSet set_;
  double damping_;
  std::vector<std::uint32_t> order_;
  CellFinder finder_;
};

}  // namespace

OptimizeResult opt_beta_local(const PointSet& input, const OptBetaLocalOptions& options, Control& control) {
  require_options(options);
  require_usable(input, control);
  // Without damping, sweeps towards an easy target overshoot and make the global ratio worse.
  Sweeper sweeper(input, options.damping.value_or(options.beta > 0.9 ? 0.7 : 1.0), control);
  OptimizeResult result{input, false, 0, {record(0, input, control)}};
  double best_beta = result.history[0].beta;
  while (best_beta > options.beta && result.sweeps < options.max_sweeps) {
    sweeper.sweep(control);
    const SweepRecord now = record(++result.sweeps, sweeper.set(), control);
    result.history.push_back(now);
    if (now.beta < best_beta) {
      best_beta = now.beta;
      result.points.coordinates = sweeper.set().places();
    }
    control.report(
        {static_cast<double>(result.sweeps) / options.max_sweeps, now.sweep, now.beta, now.r_c, now.r_f});
  }
  result.converged = best_beta <= options.beta;
  result.visits = result.sweeps;
  return result;
}

}  // namespace wellspaced

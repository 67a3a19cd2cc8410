#include "core/optimize/opt_beta_local.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include "core/analyze/spacing.h"
#include "core/error.h"
#include "core/optimize/nelder_mead.h"
#include "core/sort.h"
#include "core/voronoi/cell_finder.h"

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

/// Row by row, left to right; rows as high as the spacing.
std::vector<std::uint32_t> scan_line_order(const PointSet& points, double spacing, const Control& control) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto row = [&](Vec3 p) { return std::floor(p.y / spacing); };
  sort(order.begin(), order.end(), control, [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = points[a], q = points[b];
    if (row(p) != row(q)) return row(p) < row(q);
    return p.x != q.x ? p.x < q.x : a < b;
  });
  return order;
}

/// A grid cell is as wide as the spacing; white noise puts a dozen points in the fullest.
void require_local(const NeighborGrid& grid) {
  constexpr std::size_t most = 512;
  if (grid.fullest_cell() <= most) return;
  throw Error(ErrorCode::degenerate_input, "the points are so clustered that " +
                                               std::to_string(grid.fullest_cell()) +
                                               " of them lie within one mean spacing; remove repetitions, or "
                                               "give these points a domain that they are spread over");
}

SweepRecord record(int sweep, const PointSet& points, const Control& control) {
  const GlobalRatio ratio = measure_ratio(points, control);
  return {sweep, ratio.beta(), ratio.r_c, ratio.r_f};
}

class Sweeper {
 public:
  Sweeper(PointSet& points, double damping, const Control& control)
      : points_(points),
        spacing_(hexagonal_spacing(points.domain->area(), points.size())),
        damping_(damping),
        order_(scan_line_order(points, spacing_, control)),
        grid_(points, spacing_),
        finder_(points, grid_, 2 * spacing_, control) {
    require_local(grid_);
  }

  void sweep(const Control& control) {
    for (const std::uint32_t i : order_) {
      control.check();
      visit(i);
    }
  }

 private:
  void visit(std::uint32_t i) {
    finder_.load(i);
    const auto beta_i = [&](Vec2 u) {
      const CellFinder::Radii radii = finder_.radii_at(u);
      return radii.r_c / radii.r_f;
    };
    const Trial best = nelder_mead(beta_i, mps_rho * spacing_ / 10, nelder_mead_steps);
    if (best.at == Vec2{}) return;
    const Vec3 from = points_[i], to = points_.domain->step(from, damping_ * best.at);
    points_.set(i, to);
    grid_.move(i, from, to);
  }

  PointSet& points_;
  double spacing_, damping_;
  std::vector<std::uint32_t> order_;
  NeighborGrid grid_;
  CellFinder finder_;
};

}  // namespace

OptimizeResult opt_beta_local(const PointSet& input, const OptBetaLocalOptions& options, Control& control) {
  require_options(options);
  require_usable(input, control);
  PointSet points = input;
  // Without damping, sweeps towards an easy target overshoot and make the global ratio worse.
  Sweeper sweeper(points, options.damping.value_or(options.beta > 0.9 ? 0.7 : 1.0), control);
  OptimizeResult result{input, false, 0, {record(0, input, control)}};
  double best_beta = result.history[0].beta;
  while (best_beta > options.beta && result.sweeps < options.max_sweeps) {
    sweeper.sweep(control);
    const SweepRecord now = record(++result.sweeps, points, control);
    result.history.push_back(now);
    if (now.beta < best_beta) {
      best_beta = now.beta;
      result.points.coordinates = points.coordinates;
    }
    control.report(
        {static_cast<double>(result.sweeps) / options.max_sweeps, now.sweep, now.beta, now.r_c, now.r_f});
  }
  result.converged = best_beta <= options.beta;
  result.visits = result.sweeps;
  return result;
}

}  // namespace wellspaced

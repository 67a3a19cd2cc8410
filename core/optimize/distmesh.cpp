#include "core/optimize/distmesh.h"

#include <cmath>
#include <limits>

#include "core/optimize/best_state.h"
#include "core/optimize/move_all.h"
#include "core/optimize/require.h"

namespace wellspaced {
namespace {

constexpr double f_scale = 1.2, delta_t = 0.2;
constexpr std::size_t between_checks = 8192;

double root_mean_square_edge(const StarMesh& mesh, const Control& control) {
  double sum = 0, count = 0;  // each edge from both ends
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    if (i % between_checks == 0) control.check();
    const Star& star = mesh.star(i);
    for (int k = 0; k < star.degree; ++k) sum += norm2(mesh.offset(i, star.neighbor[k]));
    count += star.degree;
  }
  return std::sqrt(sum / count);
}

}  // namespace

std::vector<Vec2> distmesh_moves(const StarMesh& mesh, const Control& control) {
  const double rest = f_scale * root_mean_square_edge(mesh, control);
  std::vector<Vec2> moves(mesh.size());
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    if (i % between_checks == 0) control.check();
    const Star& star = mesh.star(i);
    Vec2 force;
    for (int k = 0; k < star.degree; ++k) {
      const Vec2 bar = mesh.offset(i, star.neighbor[k]);
      const double length = norm(bar);
      if (length < rest) force = force - ((rest - length) / length) * bar;
    }
    moves[i] = delta_t * force;
  }
  return moves;
}

OptimizeResult distmesh(const PointSet& input, const DistMeshOptions& options, Control& control) {
  require_sweeps(options.max_sweeps);
  require_tolerance(options.tolerance);
  StarMesh mesh(input, control);
  mesh.legalize_all(control);
  BestState best(input, mesh, control);
  best.record(0, 0);
  double moved = std::numeric_limits<double>::infinity();
  for (int sweep = 1; sweep <= options.max_sweeps && moved > options.tolerance; ++sweep) {
    const std::vector<Vec2> moves = distmesh_moves(mesh, control);
    moved = move_all(mesh, moves, input, control) * longest(moves);
    best.record(sweep, static_cast<double>(sweep) / options.max_sweeps);
  }
  return best.result();
}

}  // namespace wellspaced

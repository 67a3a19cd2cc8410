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

/// All edges of all points: of a StarMesh they are at hand.
struct MeshSpokes {
  const StarMesh& mesh;

  explicit MeshSpokes(const StarMesh& of) : mesh(of) {}
  template <class Use>
  void operator()(std::size_t i, const Use& use) const {
    const Star& star = mesh.star(i);
    for (int k = 0; k < star.degree; ++k) use(mesh.offset(i, star.neighbor[k]));
  }
};

/// Of a MovingSet they are those that cells share.
class CellSpokes {
 public:
  CellSpokes(const MovingSet& set, const Control& control) : ways_(set.size()) {
    set.for_each_cell(control, [&](std::size_t i, CellFinder& cells) { ways_[i] = set.spokes(i, cells); });
  }

  template <class Use>
  void operator()(std::size_t i, const Use& use) const {
    for (const Vec2 way : ways_[i]) use(way);
  }

 private:
  std::vector<std::vector<Vec2>> ways_;
};

template <class Spokes>
double root_mean_square_edge(const Spokes& spokes, std::size_t n, const Control& control) {
  double sum = 0, count = 0;  // each edge from both ends
  for (std::size_t i = 0; i < n; ++i) {
    if (i % between_checks == 0) control.check();
    spokes(i, [&](Vec2 bar) {
      sum += norm2(bar);
      ++count;
    });
  }
  return std::sqrt(sum / count);
}

template <class Spokes>
std::vector<Vec2> moves_of(const Spokes& spokes, std::size_t n, const Control& control) {
  const double rest = f_scale * root_mean_square_edge(spokes, n, control);
  std::vector<Vec2> moves(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i % between_checks == 0) control.check();
    Vec2 force;
    spokes(i, [&](Vec2 bar) {
      const double length = norm(bar);
      if (length < rest) force = force - ((rest - length) / length) * bar;
    });
    moves[i] = delta_t * force;
  }
  return moves;
}

template <class State>
OptimizeResult relax(State& mesh, const PointSet& input, const DistMeshOptions& options, Control& control) {
  mesh.legalize_all(control);
  BestState<State> best(input, mesh, control);
  best.record(0, 0);
  double moved = std::numeric_limits<double>::infinity();
  for (int sweep = 1; sweep <= options.max_sweeps && moved > options.tolerance; ++sweep) {
    const std::vector<Vec2> moves = distmesh_moves(mesh, control);
    moved = move_all(mesh, moves, input, control) * longest(moves);
    best.record(sweep, static_cast<double>(sweep) / options.max_sweeps);
  }
  return best.result();
}

}  // namespace

std::vector<Vec2> distmesh_moves(const StarMesh& mesh, const Control& control) {
  return moves_of(MeshSpokes(mesh), mesh.size(), control);
}

std::vector<Vec2> distmesh_moves(const MovingSet& set, const Control& control) {
  std::vector<Vec2> moves = moves_of(CellSpokes(set, control), set.size(), control);
  for (std::size_t i = 0; i < moves.size(); ++i) moves[i] = set.free_part(i, moves[i]);
  return moves;
}

OptimizeResult distmesh(const PointSet& input, const DistMeshOptions& options, Control& control) {
  require_sweeps(options.max_sweeps);
  require_tolerance(options.tolerance);
  if (is_plain_torus(input)) {
    StarMesh mesh(input, control);
    return relax(mesh, input, options, control);
  }
  MovingSet set(input, control);
  return relax(set, input, options, control);
}

}  // namespace wellspaced

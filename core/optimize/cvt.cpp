#include "core/optimize/cvt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/optimize/best_state.h"
#include "core/optimize/lbfgs.h"
#include "core/optimize/move_all.h"
#include "core/optimize/require.h"
#include "core/voronoi/moving_set.h"
#include "core/voronoi/star_cell.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {
namespace {

/// All cells of a state, a StarMesh or a MovingSet.
struct Cells {
  std::vector<Vec2> to_centroid;
  std::vector<double> area;
  double energy = 0;
  MeshRadii radii;

  void evaluate(const MovingSet& set, const Control& control) {
    to_centroid.resize(set.size());
    area.resize(set.size());
    std::vector<MovingSet::CellIntegrals> all(set.size());
    MovingSet::BlockRadii blocks(set.size());
    set.for_each_cell(control, [&](std::size_t i, CellFinder& cells) {
      all[i] = set.integrals(i, cells);
      set.include_radii(i, cells, blocks);
    });
    radii = blocks.total();
    energy = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
      to_centroid[i] = set.free_part(i, all[i].to_centroid);
      area[i] = all[i].mass;
      energy += all[i].energy;
    }
  }

  void evaluate(const StarMesh& mesh, const Control& control) {
    constexpr std::size_t between_checks = 8192;
    to_centroid.resize(mesh.size());
    area.resize(mesh.size());
    energy = 0;
    double shortest2 = std::numeric_limits<double>::infinity(), outermost2 = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
      if (i % between_checks == 0) control.check();
      const CellMoments m = moments(StarCell(mesh, i));
      // Else it is no Voronoi cell, which happens where the mesh lacks edges that reach around the torus.
      const bool inside = norm2(m.centroid) < m.outermost2;
      to_centroid[i] = inside ? m.centroid : Vec2{};
      area[i] = m.area;
      energy += m.energy;
      shortest2 = std::min(shortest2, m.shortest2);
      outermost2 = std::max(outermost2, m.outermost2);
    }
    radii = {std::sqrt(shortest2), std::sqrt(outermost2)};
  }

  std::vector<Vec2> gradient() const {
    std::vector<Vec2> g(area.size());
    for (std::size_t i = 0; i < g.size(); ++i) g[i] = (-2 * area[i]) * to_centroid[i];
    return g;
  }

  /// With this for the Hessian's inverse a Newton step is Lloyd's.
  std::vector<double> inverse_diagonal() const {
    std::vector<double> d(area.size());
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = 1 / (2 * area[i]);
    return d;
  }
};

template <class State>
class Relaxation {
 public:
  Relaxation(const PointSet& input, const CvtOptions& options, Control& control)
      : input_(input),
        options_(options),
        control_(control),
        mesh_(input, control),
        best_(input, mesh_, control) {
    mesh_.legalize_all(control);
    cells_.evaluate(mesh_, control);
    record();
  }

  OptimizeResult run() {
    const bool lloyd = options_.variant == CvtOptions::Variant::lloyd;
    while (sweeps_ < options_.max_sweeps) {
      const double moved = lloyd ? sweep_lloyd() : sweep_accelerated();
      if (moved > options_.tolerance) continue;
      break;
    }
    return best_.result();
  }

 private:
  /// How far the farthest point moved.
  double sweep_lloyd() {
    const double part = move_all(mesh_, cells_.to_centroid, input_, control_);
    const double moved = part * longest(cells_.to_centroid);
    cells_.evaluate(mesh_, control_);
    ++sweeps_;
    record();
    return moved;
  }

  /// The same; 0 if not even the steepest descent leads down any more.
  double sweep_accelerated() {
    const std::vector<Vec2> gradient = cells_.gradient();
    if (!input_.domain->is_flat()) lbfgs_.forget();  // each point's frame is another one now
    for (;;) {
      std::vector<Vec2> direction = lbfgs_.direction(gradient, cells_.inverse_diagonal(), control_);
      cap(direction);
      const double part = descend(direction, dot(gradient, direction));
      if (part > 0) {
        for (Vec2& v : direction) v = part * v;
        const double moved = longest(direction);
        std::vector<Vec2> change = cells_.gradient();
        for (std::size_t i = 0; i < change.size(); ++i) change[i] = change[i] - gradient[i];
        lbfgs_.remember(std::move(direction), std::move(change));
        record();
        return moved;
      }
      if (!lbfgs_.remembers() || sweeps_ == options_.max_sweeps) return 0;
      lbfgs_.forget();
    }
  }

  /// Halves the step until the energy falls by enough of what its slope promises. The part of the direction
  /// that was gone; 0: all is as before.
  double descend(const std::vector<Vec2>& direction, double slope) {
    constexpr double enough = 1e-4;
    constexpr int most_tries = 5;
    const typename State::Snapshot before = mesh_.snapshot();
    const Cells cells_before = cells_;
    std::vector<Vec2> step = direction;
    double part = 1;
    for (int tries = 0; tries < most_tries && sweeps_ < options_.max_sweeps && slope < 0; ++tries) {
      ++sweeps_;
      const double made = part * move_all(mesh_, step, input_, control_);
      cells_.evaluate(mesh_, control_);
      if (made > 0 && cells_.energy <= cells_before.energy + enough * made * slope) return made;
      mesh_.restore(before);
      cells_ = cells_before;
      for (Vec2& v : step) v = 0.5 * v;
      part /= 2;
    }
    return 0;
  }

  /// Far steps lead to where the energy's second derivatives say nothing.
  static void cap(std::vector<Vec2>& direction) {
    constexpr double longest_step = 0.5;
    const double length = longest(direction);
    if (length <= longest_step) return;
    for (Vec2& v : direction) v = (longest_step / length) * v;
  }

  void record() {
    best_.record(sweeps_, static_cast<double>(sweeps_) / options_.max_sweeps, cells_.radii);
    if (options_.on_energy) options_.on_energy(sweeps_, cells_.energy / static_cast<double>(mesh_.size()));
  }

  const PointSet& input_;
  const CvtOptions& options_;
  Control& control_;
  State mesh_;
  BestState<State> best_;
  Cells cells_;
  Lbfgs lbfgs_;
  int sweeps_ = 0;
};

}  // namespace

OptimizeResult cvt(const PointSet& input, const CvtOptions& options, Control& control) {
  require_sweeps(options.max_sweeps);
  require_tolerance(options.tolerance);
  if (is_plain_torus(input)) return Relaxation<StarMesh>(input, options, control).run();
  return Relaxation<MovingSet>(input, options, control).run();
}

}  // namespace wellspaced

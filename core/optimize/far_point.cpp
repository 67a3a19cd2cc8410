#include "core/optimize/far_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/optimize/best_state.h"
#include "core/optimize/require.h"
#include "core/optimize/tournament.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/star_mesh.h"

namespace wellspaced {
namespace {

/// A place without points around it, seen from one of the nearest.
struct EmptyCircle {
  std::size_t seen_from = 0;
  Vec2 center;
  double radius2 = 0;
};

/// The largest of the circles around the triangles of a point.
EmptyCircle largest_circle_at(const StarMesh& mesh, std::size_t i) {
  EmptyCircle largest{i, {}, 0};
  const Star& star = mesh.star(i);
  Vec2 a = mesh.offset(i, star.neighbor[star.degree - 1]);
  for (int k = 0; k < star.degree; ++k) {
    const Vec2 b = mesh.offset(i, star.neighbor[k]), center = circumcenter(a, b);
    if (norm2(center) > largest.radius2) largest = {i, center, norm2(center)};
    a = b;
  }
  return largest;
}

double nearest_distance2(const StarMesh& mesh, std::size_t i) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < mesh.star(i).degree; ++k)
    least = std::min(least, norm2(mesh.offset(i, mesh.star(i).neighbor[k])));
  return least;
}

double mean_nearest_distance(const StarMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) sum += std::sqrt(nearest_distance2(mesh, i));
  return sum / static_cast<double>(mesh.size());
}

class FarthestPoints {
 public:
  FarthestPoints(StarMesh& mesh, const Control& control)
      : mesh_(mesh), control_(control), mean_(mean_nearest_distance(mesh)), radius2_(mesh.size()) {
    for (std::size_t i = 0; i < mesh_.size(); ++i) radius2_.set(i, largest_circle_at(mesh_, i).radius2);
  }

  /// How far the mean distance to the nearest point grew; 0 if the sweep had to be taken back.
  double sweep() {
    constexpr std::size_t between_checks = 512;
    const StarMesh::Snapshot before = mesh_.snapshot();
    for (std::size_t i = 0; i < mesh_.size(); ++i) {
      if (i % between_checks == 0) control_.check();
      if (visit(i)) continue;
      mesh_.restore(before);
      return 0;
    }
    const double mean = mean_nearest_distance(mesh_), gain = mean - mean_;
    mean_ = mean;
    return gain;
  }

 private:
  /// False: the mesh has no way to take the point back.
  bool visit(std::size_t i) {
    constexpr double worthwhile = 1 + 2e-6;  // by more than rounding
    constexpr double senseless = 1e6;        // as of triangles that rounding makes flat
    const double here2 = nearest_distance2(mesh_, i);
    const FixedPoint here = mesh_.at(i);
    const Star neighbors = mesh_.star(i);
    if (!mesh_.remove(i)) return true;
    radius2_.set(i, 0);
    refresh(neighbors);
    const EmptyCircle gap = largest_circle();
    const bool farther = gap.radius2 > worthwhile * here2 && gap.radius2 < senseless;
    const bool moved = farther && put(i, mesh_.moved(gap.seen_from, gap.center), gap.seen_from);
    if (!moved && !put(i, here, neighbors.neighbor[0])) return false;
    radius2_.set(i, largest_circle_at(mesh_, i).radius2);
    refresh(mesh_.star(i));
    return true;
  }

  /// Inserts the point, or leaves it out where the mesh can't have it.
  bool put(std::size_t i, FixedPoint place, std::size_t near) {
    return mesh_.insert(i, place, near) && (mesh_.is_delaunay_at(i) || !mesh_.remove(i));
  }

  /// Flips that rounding makes far away leave keys that are too large: they are put right when they win.
  EmptyCircle largest_circle() {
    for (;;) {
      const std::size_t i = radius2_.winner();
      const EmptyCircle circle = largest_circle_at(mesh_, i);
      if (circle.radius2 >= radius2_.key(i)) return circle;
      radius2_.set(i, circle.radius2);
    }
  }

  void refresh(const Star& star) {
    for (int k = 0; k < star.degree; ++k)
      radius2_.set(star.neighbor[k], largest_circle_at(mesh_, star.neighbor[k]).radius2);
  }

  StarMesh& mesh_;
  const Control& control_;
  double mean_;
  Tournament radius2_;  // of the largest circle around a triangle of the point
};

}  // namespace

OptimizeResult far_point(const PointSet& input, const FarPointOptions& options, Control& control) {
  require_sweeps(options.max_sweeps);
  require_tolerance(options.tolerance);
  StarMesh mesh(input, control);
  mesh.legalize_all(control);
  BestState best(input, mesh, control);
  best.record(0, 0);
  FarthestPoints points(mesh, control);
  for (int sweep = 1; sweep <= options.max_sweeps; ++sweep) {
    const double gain = points.sweep();
    best.record(sweep, static_cast<double>(sweep) / options.max_sweeps);
    if (gain < options.tolerance) break;
  }
  return best.result();
}

}  // namespace wellspaced

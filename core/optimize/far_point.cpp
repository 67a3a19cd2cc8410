#include "core/optimize/far_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/optimize/best_state.h"
#include "core/optimize/nelder_mead.h"
#include "core/optimize/require.h"
#include "core/optimize/tournament.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/moving_set.h"
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

/// The same on any domain. Depths are in units, a place's being that of the point that it is seen from.
/// Points on the boundary stay on their curve, and go to where they are farthest from all others there,
/// within what they see.
class FarthestPlaces {
 public:
  FarthestPlaces(MovingSet& set, const Control& control)
      : set_(set), control_(control), finder_(set.finder(control)), depth_(set.size()) {
    for (std::size_t i = 0; i < set_.size(); ++i) {
      if (i % 256 == 0) control_.check();
      depth_.set(i, look(i).depth);
    }
    mean_ = mean_nearest();
  }

  /// How far the mean distance to the nearest point grew.
  double sweep() {
    for (std::size_t i = 0; i < set_.size(); ++i) {
      control_.check();
      if (set_.freedom(i).dimensions == 2) visit(i);
      if (set_.freedom(i).dimensions == 1) slide(i);
    }
    const double mean = mean_nearest(), gain = mean - mean_;
    mean_ = mean;
    return gain;
  }

 private:
  struct Hole {
    double depth = 0;
    Vec2 way;  // there, in the frame of the point that sees it
  };

  void load(std::size_t i) { set_.find_cell(i, finder_); }

  /// The deepest corner inside the domain of point i's cell.
  Hole look(std::size_t i) {
    load(i);
    Hole deepest;
    for (const Cell& part : finder_.parts()) {
      const std::span<const Cell::Corner> corners = part.corners();
      for (std::size_t k = 0; k < corners.size(); ++k) {
        if (corners[k].label < 0 || corners[k == 0 ? corners.size() - 1 : k - 1].label < 0) continue;
        const double length = norm(corners[k].at), distance = set_.domain().chart_to_distance(length);
        if (distance / set_.unit(i) > deepest.depth)
          deepest = {distance / set_.unit(i), (distance / length) * corners[k].at};
      }
    }
    return deepest;
  }

  double nearest(std::size_t i) {
    load(i);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Neighbor& neighbor : finder_.neighbors())
      if (neighbor.id != i)
        nearest = std::min(nearest, norm(set_.domain().way_to(set_[i], neighbor)) / set_.unit(i));
    return nearest;
  }

  double mean_nearest() {
    double sum = 0;
    for (std::size_t i = 0; i < set_.size(); ++i) {
      if (i % 256 == 0) control_.check();
      sum += nearest(i);
    }
    return sum / static_cast<double>(set_.size());
  }

  void visit(std::size_t i) {
    constexpr double worthwhile = 1 + 2e-6;  // by more than rounding
    const Vec3 here = set_[i];
    const double depth_here = nearest(i);
    const std::vector<std::uint32_t> around = seen();
    set_.take_out(i);
    depth_.set(i, 0);
    refresh(around);
    const Hole hole = largest();
    const std::size_t from = depth_.winner();
    const Vec3 there = set_.domain().place_at(set_[from], hole.way);
    const bool is_inside = !set_.domain().why_outside(there) && set_.domain().freedom(there).dimensions == 2;
    set_.put_back(i, is_inside && hole.depth > worthwhile * depth_here ? there : here);
    depth_.set(i, look(i).depth);
    refresh(seen());
  }

  void slide(std::size_t i) {
    constexpr int steps = 10;
    const double size = set_.unit(i) / 10;
    finder_.load(static_cast<std::uint32_t>(i), set_.reach(i));
    const Vec2 along = set_.freedom(i).along;
    const auto conflict = [&](double t) {
      return -finder_.radii_at(set_.domain().possible(set_[i], t * along)).r_f;
    };
    const double best = nelder_mead_on_line(conflict, size, steps);
    if (best == 0) return;
    load(i);
    const std::vector<std::uint32_t> before = seen();
    set_.move_to(i, set_.domain().step(set_[i], set_.domain().possible(set_[i], best * along)));
    depth_.set(i, look(i).depth);
    refresh(seen());
    refresh(before);
  }

  /// Those who share an edge with the cell that is at hand.
  std::vector<std::uint32_t> seen() const {
    std::vector<std::uint32_t> ids;
    for (const Cell& part : finder_.parts())
      for (const Cell::Corner& corner : part.corners())
        if (corner.label >= 0) ids.push_back(finder_.neighbors()[static_cast<std::size_t>(corner.label)].id);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  void refresh(const std::vector<std::uint32_t>& ids) {
    for (const std::uint32_t j : ids) depth_.set(j, look(j).depth);
  }

  /// Keys of cells that changed without being a neighbor's are put right when they win.
  Hole largest() {
    for (;;) {
      const std::size_t i = depth_.winner();
      const Hole hole = look(i);
      if (hole.depth >= depth_.key(i)) return hole;
      depth_.set(i, hole.depth);
    }
  }

  MovingSet& set_;
  const Control& control_;
  CellFinder finder_;
  Tournament depth_;
  double mean_ = 0;
};

template <class Points, class State>
OptimizeResult relax(Points& points, BestState<State>& best, const FarPointOptions& options) {
  best.record(0, 0);
  for (int sweep = 1; sweep <= options.max_sweeps; ++sweep) {
    const double gain = points.sweep();
    best.record(sweep, static_cast<double>(sweep) / options.max_sweeps);
    if (gain < options.tolerance) break;
  }
  return best.result();
}

}  // namespace

OptimizeResult far_point(const PointSet& input, const FarPointOptions& options, Control& control) {
  require_sweeps(options.max_sweeps);
  require_tolerance(options.tolerance);
  if (is_plain_torus(input)) {
    StarMesh mesh(input, control);
    mesh.legalize_all(control);
    BestState<StarMesh> best(input, mesh, control);
    FarthestPoints points(mesh, control);
    return relax(points, best, options);
  }
  MovingSet set(input, control);
  BestState<MovingSet> best(input, set, control);
  FarthestPlaces places(set, control);
  return relax(places, best, options);
}

}  // namespace wellspaced

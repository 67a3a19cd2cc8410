#include "core/generate/hole_filler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace wellspaced {
namespace {

constexpr std::uint32_t nobody = ~0u;
constexpr std::size_t few = 16;             ///< points on a curved domain
constexpr std::size_t few_on_surface = 64;  ///< of many faces
constexpr std::size_t many_faces = 2000;

}  // namespace

bool HoleFiller::ComesLater::operator()(const Hole& a, const Hole& b) const {
  return std::tuple(-a.depth, a.at.z, a.at.y, a.at.x) > std::tuple(-b.depth, b.at.z, b.at.y, b.at.x);
}

HoleFiller::HoleFiller(PointSet& points, NeighborGrid& grid, const DiskRule& rule, Control& control,
                       Search search)
    : points_(points),
      grid_(grid),
      rule_(rule),
      control_(control),
      deepened_(search == Search::wide && !points.domain->has_exact_cells() ? 1.15 : 1),
      far_as_(search == Search::wide ? 2.5 : 1.05),
      has_many_faces_(!points.domain->has_exact_cells() && points.domain->triangles().size() > many_faces),
      finder_(points, grid, 0, control),
      settler_(points, grid) {}

void HoleFiller::fill() {
  const double enough = rule_.coverage * (1 + 1e-9);
  Hole hole{};
  looks_at_cells_ = !(has_many_faces_ && points_.size() < few_on_surface);
  while (!looks_at_cells_) {
    heap_.clear();
    look_at_places(enough);
    if (!take_deepest(enough, hole)) return;
    insert(hole, enough);
  }
  // Corners that are settled may have led to one hole where there are two.
  for (bool again = true; again;) {
    const std::size_t before = points_.size();
    heap_.clear();
    collect(enough);
    while (take_deepest(enough, hole)) insert(hole, enough);
    again = points_.size() > before && !points_.domain->has_exact_cells();
  }
}

double HoleFiller::fill_to(std::size_t count) {
  const bool once = points_.domain->has_exact_cells();
  Hole hole{};
  while (points_.size() < count) {
    const std::size_t before = points_.size();
    const bool are_few = before < few && !points_.domain->is_flat();
    looks_at_cells_ = !(has_many_faces_ && before < few_on_surface);
    heap_.clear();
    if (looks_at_cells_) collect(0);
    if (are_few || !looks_at_cells_) look_at_places(0);
    const std::size_t until = once && !are_few ? count : std::min(count, before + before / 8 + 1);
    while (points_.size() < until && take_deepest(0, hole)) insert(hole, 0);
    if (points_.size() == before) break;
  }
  return hole.depth;
}

/// Few points on a curved domain have cells with corners that charts don't reach, or get wrong; where there
/// are many faces, too, each look at a corner goes over most of them.
void HoleFiller::look_at_places(double deeper_than) {
  constexpr std::size_t places = 2048;
  if (!far_) {
    far_.emplace(*points_.domain, places);
    depths_.assign(far_->places().size(), std::numeric_limits<double>::infinity());
  }
  for (; seen_ < points_.size(); ++seen_) {
    control_.check();
    const double r = rule_.radius(points_[seen_]);
    const double reach = far_as_ * rule_.reach(r);
    far_->see_from(points_[seen_], reach, [&](std::size_t k, double d) {
      depths_[k] = std::min(depths_[k], d / rule_.distance(rule_.radius(far_->places()[k]), r));
    });
  }
  double deepest = deeper_than;
  for (const std::size_t k : far_->summits(depths_)) {
    const Vec3 place = far_->places()[k];
    // No corner is farther from the next place than that.
    if (depths_[k] + far_->gap() / rule_.radius(place) <= deepest) continue;
    look_at_place(place, depths_[k]);
    if (!heap_.empty()) deepest = std::max(deepest, heap_.front().depth);
  }
}

void HoleFiller::look_at_place(Vec3 place, double depth) {
  const Domain& domain = *points_.domain;
  if (domain.freedom(place).dimensions < 2) return;
  Hole hole{depth, place};
  if (std::isinf(depth)) {  // there is no point within reach
    hole.depth = far_as_ * rule_.coverage;
  } else if (!domain.has_exact_cells()) {
    hole.at = settler_.settle(place, depth * rule_.radius(place), false).at;
    hole.depth = depth_of(hole);
  }
  heap_.push_back(hole);
  std::push_heap(heap_.begin(), heap_.end(), ComesLater());
}

void HoleFiller::collect(double deeper_than) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i % 256 == 0) control_.check();
    look(static_cast<std::uint32_t>(i), deeper_than);
  }
}

void HoleFiller::look(std::uint32_t i, double deeper_than) {
  const Domain& domain = *points_.domain;
  const double r = rule_.radius(points_[i]);
  finder_.load(i, 2.5 * rule_.coverage * r);
  finder_.cell_at({});
  for (const Cell& part : finder_.parts())
    for (std::size_t k = 0; k < part.corners().size(); ++k) {
      const double length = norm(part.corners()[k].at);
      if (!(length > 0)) continue;
      const double distance = domain.chart_to_distance(length);
      const Vec3 at = domain.place_at(points_[i], (distance / length) * part.corners()[k].at);
      look_at_corner({at, distance}, part.is_outer(k), r, deeper_than);
    }
}

/// Of the cell of a point with radius r. Between two parts of a cell there is no hole; but where a seam of a
/// chart ends, a cell meets itself behind a vertex, and no place around is farther away.
void HoleFiller::look_at_corner(CornerSettler::Corner corner, bool is_outer, double r, double deeper_than) {
  const Domain& domain = *points_.domain;
  const std::optional<Vec3> on_rim = is_outer ? domain.boundary_point_at(corner.at) : std::nullopt;
  if (is_outer && !on_rim && domain.has_exact_cells()) return;
  if (on_rim) corner.at = *on_rim;
  const auto depth = [&] { return corner.distance / rule_.distance(rule_.radius(corner.at), r); };
  if (depth() * deepened_ <= deeper_than) return;
  if (!domain.has_exact_cells()) corner = settler_.settle(corner.at, corner.distance, on_rim.has_value());
  if (depth() <= deeper_than) return;
  heap_.push_back({depth(), corner.at});
  std::push_heap(heap_.begin(), heap_.end(), ComesLater());
}

/// As of now: points may have come since the hole was found.
double HoleFiller::depth_of(const Hole& hole) {
  const Domain& domain = *points_.domain;
  const Vec3 at = hole.at;
  const double r = rule_.radius(at);
  neighbors_.clear();
  const double reach =
      std::min(std::max(1.5, 1.01 * hole.depth / rule_.coverage) * rule_.reach(r), 1.01 * domain.farthest());
  grid_.gather(at, nobody, reach, neighbors_);
  domain.localize(at, reach, neighbors_);
  double depth = std::numeric_limits<double>::infinity();
  for (const Neighbor& q : neighbors_)
    depth = std::min(depth, norm(domain.way_to(at, q)) / rule_.distance(r, rule_.radius(points_[q.id])));
  return depth;
}

/// One that has become a little shallower may have done so by rounding only.
bool HoleFiller::take_deepest(double deeper_than, Hole& deepest) {
  constexpr double little = 1e-2;
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), ComesLater());
    const Hole hole = heap_.back();
    heap_.pop_back();
    const double depth = depth_of(hole);
    if (depth <= deeper_than || depth < hole.depth * (1 - little)) continue;  // new corners were found since
    if (depth < hole.depth * (1 - 1e-9)) {
      heap_.push_back({depth, hole.at});
      std::push_heap(heap_.begin(), heap_.end(), ComesLater());
      continue;
    }
    deepest = hole;
    return true;
  }
  return false;
}

void HoleFiller::insert(const Hole& hole, double deeper_than) {
  control_.check();
  const auto added = static_cast<std::uint32_t>(points_.size());
  points_.push_back(hole.at);
  grid_.add(added);
  if (looks_at_cells_) look(added, deeper_than);  // all new corners are its own
}

}  // namespace wellspaced

#include "core/voronoi/cell_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/math.h"
#include "core/sort.h"

namespace wellspaced {
namespace {

constexpr std::size_t crowd = 256;  ///< a neighborhood of so many may take long

/// Ties by id keep the order one for all.
bool is_nearer(const Neighbor& a, const Neighbor& b) {
  const double a2 = norm2(a.offset), b2 = norm2(b.offset);
  return a2 != b2 ? a2 < b2 : a.id < b.id;
}

/// Distance of a convex polygon's nearest place; infinite if it is empty.
double nearest_to_origin(std::span<const Cell::Corner> polygon) {
  double nearest = std::numeric_limits<double>::infinity();
  bool is_inside = !polygon.empty();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k].at, along = polygon[k + 1 == polygon.size() ? 0 : k + 1].at - a;
    const double part = norm2(along) > 0 ? std::clamp(-dot(a, along) / norm2(along), 0.0, 1.0) : 0;
    nearest = std::min(nearest, norm(a + part * along));
    is_inside = is_inside && cross(a, along) >= 0;
  }
  return is_inside ? 0 : nearest;
}

}  // namespace

CellFinder::CellFinder(const PointSet& points, const NeighborGrid& grid, double reach, const Control& control)
    : points_(&points),
      grid_(&grid),
      control_(&control),
      first_reach_(reach),
      settler_(points, grid),
      is_flat_(points.domain->is_flat()),
      has_boundary_(points.domain->boundary_length() > 0) {
  // No cell has a larger outradius, so nothing farther than twice that can matter.
  farthest_reach_ = 2.01 * points.domain->farthest();
}

void CellFinder::load(std::uint32_t i, double reach) {
  self_ = i;
  base_ = (*points_)[i];
  most_ = crowd;
  gather(std::min(reach, farthest_reach_));
}

void CellFinder::gather(double reach) {
  reach_ = reach;
  neighbors_.clear();
  grid_->gather(base_, self_, reach, neighbors_);
  if (neighbors_.size() > most_) leave_the_farthest();
  points_->domain->localize(base_, reach_, neighbors_);
  has_own_images_ =
      std::any_of(neighbors_.begin(), neighbors_.end(), [this](const Neighbor& n) { return n.id == self_; });
  sorted_ = false;
  star_use_ = StarUse::not_loaded;
}

/// Where so many are in reach, most of them are too far away to matter; else the next look keeps more. On the
/// domain nothing is nearer than through space.
void CellFinder::leave_the_farthest() {
  control_->check();
  const auto last = neighbors_.begin() + static_cast<std::ptrdiff_t>(most_);
  std::nth_element(neighbors_.begin(), last, neighbors_.end(), is_nearer);
  reach_ = norm(last->offset);
  neighbors_.erase(last, neighbors_.end());
  most_ *= 4;
}

void CellFinder::sort_neighbors() {
  // Near ones first: they cut most, and the rest is then rejected in O(1).
  if (neighbors_.size() < crowd)
    std::sort(neighbors_.begin(), neighbors_.end(), is_nearer);
  else
    sort(neighbors_.begin(), neighbors_.end(), *control_, is_nearer);
  sorted_ = true;
}

void CellFinder::cut(Vec2 u) {
  if (!sorted_) sort_neighbors();
  half_planes_.resize(neighbors_.size());
  points_->domain->bisectors(base_, u, neighbors_, half_planes_);
  for (std::size_t k = 0; k < neighbors_.size() && has_own_images_; ++k)
    if (neighbors_[k].id == self_)  // it moves along
      points_->domain->bisectors(base_, {}, {&neighbors_[k], 1}, {&half_planes_[k], 1});
  cell_.reset(points_->domain->distance_to_chart(reach_));
  for (std::size_t k = 0; k < half_planes_.size(); ++k) {
    if (k % crowd == crowd - 1) control_->check();
    cell_.clip(half_planes_[k], static_cast<std::int32_t>(k));
  }
}

void CellFinder::clip_to_domain(Vec2 u) {
  clipped_ = has_boundary_ && points_->domain->pieces(base_, reach_, pieces_);
  if (!clipped_) return;
  for (Vec2& corner : pieces_.corners) corner = corner - u;
  parts_.resize(pieces_.ends.size());
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    parts_[k].reset(pieces_[k]);
    for (const Cell::Corner& corner : cell_.corners())
      if (corner.label >= 0)
        parts_[k].clip(half_planes_[static_cast<std::size_t>(corner.label)], corner.label);
  }
}

double CellFinder::outradius2() const {
  double most = 0;
  for (const Cell& part : parts()) most = std::max(most, part.outradius2());
  return most;
}

double CellFinder::outradius(double at_least) {
  const Domain& domain = *points_->domain;
  if (domain.has_exact_cells()) return distance_of_farthest();
  constexpr double slack = 0.9;  // corners may turn out to be farther away than they say
  double most = 0;
  for (const Cell& part : parts())
    for (std::size_t k = 0; k < part.corners().size(); ++k)
      if (norm(part.corners()[k].at) > std::max(at_least, slack * most))
        most = std::max(most, distance_of_corner(part, k));
  return most;
}

double CellFinder::distance_of_corner(const Cell& part, std::size_t k) {
  const Domain& domain = *points_->domain;
  const Vec2 corner = part.corners()[k].at;
  const double claimed = domain.chart_to_distance(norm(corner));
  if (domain.has_exact_cells()) return claimed;
  return settler_.settle(domain.place_at(base_, corner), claimed, part.is_outer(k)).distance;
}

PolygonMoments CellFinder::moments() {
  PolygonMoments sum;
  for (const Cell& part : parts()) {
    polygon_.clear();
    for (const Cell::Corner& corner : part.corners()) polygon_.push_back(corner.at);
    sum += points_->domain->moments(polygon_);
  }
  return sum;
}

/// What the two charts leave out between them falls with how far they are looked at, and with its square.
double CellFinder::area() {
  const Domain& domain = *points_->domain;
  if (clipped_ || !std::isfinite(domain.horizon()) || cell_.closed()) return moments().area;
  const double unit = domain.distance_to_chart(domain.horizon() / 2), near = 1e4, far = 1e5;
  const auto both = [&](double wide) { return area_within(wide * unit, 1) + area_within(wide * unit, -1); };
  return (far * both(far) - near * both(near)) / (far - near);
}

/// Of the square of that half side in the chart; side: 1 here, -1 at the opposite place.
double CellFinder::area_within(double reach, double side) {
  Cell half;
  half.reset(reach);
  for (const HalfPlane& h : half_planes_) half.clip({h.n, side * h.c}, 0);
  polygon_.clear();
  for (const Cell::Corner& corner : half.corners()) polygon_.push_back(corner.at);
  return points_->domain->moments(polygon_).area;
}

/// A part that reaches into the starting square's rim is farther away than half of it.
bool CellFinder::is_complete(double moved) const {
  if (!clipped_ && !cell_.closed()) return false;
  return moved + 2 * points_->domain->chart_to_distance(std::sqrt(outradius2())) <= reach_;
}

void CellFinder::find_cell(Vec2 u) {
  const double moved = norm(u);
  for (;;) {
    cut(u);
    clip_to_domain(u);
    if (is_complete(moved) || reach_ >= farthest_reach_ + moved) return;
    gather(std::min(1.5 * reach_ + moved, farthest_reach_ + moved));
  }
}

const Cell& CellFinder::cell_at(Vec2 u) {
  find_cell(u);
  if (!points_->domain->has_exact_cells()) leave_out_seams(u);
  return cell_;
}

/// Both sides of a seam are convex. What is beside it sees past the vertex as if the other side were turned
/// around that by all that is missing.
void CellFinder::leave_out_seams(Vec2 u) {
  seams_.clear();
  // As far as a sample may be from a place of the cell that it is nearest to.
  points_->domain->seams(base_, norm(u) + 2 * std::sqrt(outradius2()), seams_);
  for (const Seam& seam : seams_) {
    halves_.clear();
    for (const Cell& part : parts())
      for (const double side : {1.0, -1.0}) {
        Cell half = part;
        clip_to_side(seam, side, u, half);
        if (half.corners().size() >= 3) halves_.push_back(std::move(half));
      }
    parts_.swap(halves_);
    clipped_ = true;
  }
}

/// side: 1: left of the seam's axis, -1: right of it.
void CellFinder::clip_to_side(const Seam& seam, double side, Vec2 u, Cell& half) const {
  const auto turned = [](Vec2 v, double angle) {
    const CosSin turn = portable_cos_sin(angle / (2 * pi));
    return Vec2{turn.cos * v.x - turn.sin * v.y, turn.sin * v.x + turn.cos * v.y};
  };
  const auto keep_left_of = [&](Vec2 way) { half.clip({{way.y, -way.x}, -cross(way, seam.at - u)}, -1); };
  keep_left_of(side * seam.axis);
  keep_left_of(side * turned(seam.axis, side * seam.half_angle));
  for (std::size_t k = 0; k < neighbors_.size() && half.corners().size() >= 3; ++k) {
    Neighbor seen = neighbors_[k];
    const Vec2 from_vertex = Vec2{seen.offset.x, seen.offset.y} - seam.at;
    if (side * cross(seam.axis, from_vertex) > 0) continue;
    const Vec2 at = seam.at + turned(from_vertex, 2 * side * seam.half_angle);
    seen.offset = {at.x, at.y, 0};
    HalfPlane bisector;
    points_->domain->bisectors(base_, u, {&seen, 1}, {&bisector, 1});
    half.clip(bisector, static_cast<std::int32_t>(k));
  }
}

CellFinder::Radii CellFinder::radii_at(Vec2 u) {
  if (const auto radii = radii_by_star(u)) return *radii;
  return radii_by_clipping(u);
}

void CellFinder::load_star() {
  // An own image bounds the cell, but is no other sample and moves along: leave that to clipping.
  const bool suits = is_flat_ && !has_own_images_ && neighbors_.size() <= CandidateStar::most_neighbors;
  star_use_ = suits ? StarUse::loaded : StarUse::unsuitable;
  if (suits) star_.load(neighbors_);
}

std::optional<CellFinder::Radii> CellFinder::radii_by_star(Vec2 u) {
  if (star_use_ == StarUse::not_loaded) load_star();
  if (star_use_ == StarUse::unsuitable) return std::nullopt;
  const auto squares = star_.squares_at(u);
  if (!squares) return std::nullopt;
  const Radii radii{std::sqrt(squares->nearest2), std::sqrt(squares->outradius2)};
  const double moved = norm(u);
  if (moved + 2 * radii.r_c > reach_) return std::nullopt;
  if (has_boundary_ && points_->domain->pieces(base_, moved + radii.r_c, pieces_)) return std::nullopt;
  return radii;
}

/// What seams leave out is seen elsewhere, so it doesn't matter here.
CellFinder::Radii CellFinder::radii_by_clipping(Vec2 u) {
  find_cell(u);
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < half_planes_.size(); ++k) {
    if (neighbors_[k].id == self_) continue;  // an own image bounds the cell but is no other sample
    const HalfPlane& h = half_planes_[k];
    const double n2 = norm2(h.n);
    nearest2 = std::min(nearest2, n2 > 0 ? h.c * std::fabs(h.c) / n2 : 0);
  }
  const Domain& domain = *points_->domain;
  return {2 * domain.chart_to_distance(std::sqrt(std::max(0.0, nearest2))), distance_of_farthest()};
}

/// As the chart has it; and where the cell goes on past where that ends, beyond.
double CellFinder::distance_of_farthest() {
  const Domain& domain = *points_->domain;
  if (!clipped_ && std::isfinite(domain.horizon()) && !cell_.closed()) return distance_beyond_horizon();
  return domain.chart_to_distance(std::sqrt(outradius2()));
}

/// Ways to the opposite place lead on into all directions, so what is nearest to that is farthest from here.
double CellFinder::distance_beyond_horizon() {
  const Domain& domain = *points_->domain;
  Cell beyond;
  for (const double wide : {1e2, 1e6}) {  // in what the chart shows of half the way to the horizon
    const double reach = wide * domain.distance_to_chart(domain.horizon() / 2);
    beyond.reset(reach);
    for (const HalfPlane& h : half_planes_) beyond.clip({h.n, -h.c}, 0);
    const double nearest = nearest_to_origin(beyond.corners());
    if (nearest < reach) return 2 * domain.horizon() - domain.chart_to_distance(nearest);
  }
  return domain.horizon();
}

}  // namespace wellspaced

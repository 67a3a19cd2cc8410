#include "core/voronoi/cell_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/sort.h"

namespace wellspaced {
namespace {

constexpr std::size_t crowd = 256;  ///< a neighborhood of so many may take long

}  // namespace

CellFinder::CellFinder(const PointSet& points, const NeighborGrid& grid, double reach, const Control& control)
    : points_(&points), grid_(&grid), control_(&control), first_reach_(reach) {
  // No cell of a periodic box has an outradius above half its diagonal, so nothing farther than this can
  // matter.
  farthest_reach_ = 2 * norm(points.domain->box().size);
}

void CellFinder::load(std::uint32_t i, double reach) {
  self_ = i;
  base_ = (*points_)[i];
  gather(reach);
}

void CellFinder::gather(double reach) {
  reach_ = reach;
  neighbors_.clear();
  grid_->gather(base_, self_, reach, neighbors_);
  // Near ones first: they cut most, and the rest is then rejected in O(1). Ties by id keep the order one for
  // all.
  const auto nearer = [](const Neighbor& a, const Neighbor& b) {
    const double a2 = norm2(a.offset), b2 = norm2(b.offset);
    return a2 != b2 ? a2 < b2 : a.id < b.id;
  };
  if (neighbors_.size() < crowd)
    std::sort(neighbors_.begin(), neighbors_.end(), nearer);
  else
    sort(neighbors_.begin(), neighbors_.end(), *control_, nearer);
  half_planes_.resize(neighbors_.size());
}

void CellFinder::cut(Vec2 u) {
  points_->domain->bisectors(base_, u, neighbors_, half_planes_);
  cell_.reset(reach_);
  for (std::size_t k = 0; k < half_planes_.size(); ++k) {
    if (k % crowd == crowd - 1) control_->check();
    cell_.clip(half_planes_[k], static_cast<std::int32_t>(k));
  }
}

const Cell& CellFinder::cell_at(Vec2 u) {
  const double moved = norm(u);
  for (;;) {
    cut(u);
    const double outradius = std::sqrt(cell_.outradius2());
    const bool complete =
        cell_.closed() && moved + 2 * points_->domain->chart_to_distance(outradius) <= reach_;
    if (complete || reach_ >= farthest_reach_ + moved) return cell_;
    gather(std::min(1.5 * reach_ + moved, farthest_reach_ + moved));
  }
}

CellFinder::Radii CellFinder::radii_at(Vec2 u) {
  cell_at(u);
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < half_planes_.size(); ++k) {
    if (neighbors_[k].id == self_) continue;  // an own image bounds the cell but is no other sample
    const HalfPlane& h = half_planes_[k];
    nearest2 = std::min(nearest2, h.c * std::fabs(h.c) / norm2(h.n));
  }
  const Domain& domain = *points_->domain;
  return {2 * domain.chart_to_distance(std::sqrt(std::max(0.0, nearest2))),
          domain.chart_to_distance(std::sqrt(cell_.outradius2()))};
}

}  // namespace wellspaced

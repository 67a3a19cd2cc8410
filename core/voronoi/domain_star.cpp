#include "core/voronoi/domain_star.h"

#include <algorithm>
#include <cmath>

#include "core/math.h"

namespace wellspaced {

void DomainStar::load(const MovingSet& set, std::size_t i, CellFinder& cells) {
  cells.load(static_cast<std::uint32_t>(i), set.reach(i));
  cells.cell_at({});
  labels_.clear();
  for (const Cell& part : cells.parts())
    for (const Cell::Corner& corner : part.corners())
      if (corner.label >= 0) labels_.push_back(corner.label);
  std::sort(labels_.begin(), labels_.end());
  labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
  spokes_.clear();
  for (const std::int32_t label : labels_) {
    const Neighbor& neighbor = cells.neighbors()[static_cast<std::size_t>(label)];
    spokes_.push_back({set.domain().way_to(set[i], neighbor), neighbor.id});
  }
  const auto direction = [](const Spoke& s) { return portable_atan2(s.way.y, s.way.x); };
  std::sort(spokes_.begin(), spokes_.end(),
            [&](const Spoke& a, const Spoke& b) { return direction(a) < direction(b); });
  if (!set.domain().has_exact_cells()) merge_images(set.freedom(i).dimensions == 2);
  if (set.freedom(i).dimensions < 2) open_outside(set, i);
}

/// What lies behind a vertex of a mesh is seen past its left and its right: one neighbor, the nearer one of
/// the two, where these follow each other; on the boundary within half a turn, for the outside is no vertex.
void DomainStar::merge_images(bool is_inside) {
  for (std::size_t k = 0; k < spokes_.size() && spokes_.size() > 3;) {
    const std::size_t next = k + 1 == spokes_.size() ? 0 : k + 1;
    const bool within_half_a_turn = cross(spokes_[k].way, spokes_[next].way) > 0;
    if (spokes_[k].id != spokes_[next].id || !(is_inside || within_half_a_turn)) {
      ++k;
      continue;
    }
    const bool first_is_nearer = norm2(spokes_[k].way) <= norm2(spokes_[next].way);
    spokes_.erase(spokes_.begin() + static_cast<std::ptrdiff_t>(first_is_nearer ? next : k));
  }
}

/// A point on the boundary has the outside between two of its neighbors.
void DomainStar::open_outside(const MovingSet& set, std::size_t i) {
  constexpr double near = 1e-3;
  for (std::size_t k = 0; k < spokes_.size(); ++k) {
    const Spoke& next = spokes_[k + 1 == spokes_.size() ? 0 : k + 1];
    const Vec2 a = (1 / norm(spokes_[k].way)) * spokes_[k].way, b = (1 / norm(next.way)) * next.way;
    const double turn = cross(a, b);
    // Half a turn and more is outside in any case; the middle of a smaller angle tells.
    if (turn <= 1e-9 || spokes_.size() == 1) {
      spokes_[k].closes = false;
      continue;
    }
    const Vec2 middle = (near * set.unit(i) / norm(a + b)) * (a + b);
    spokes_[k].closes = set.domain().holds(set[i], middle);
  }
}

}  // namespace wellspaced

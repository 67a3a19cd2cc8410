#include "core/voronoi/moving_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/domain/sizing.h"
#include "core/error.h"
#include "core/parallel.h"

namespace wellspaced {
namespace {

constexpr std::size_t block = 256;

/// A grid cell is as wide as the spacing; white noise puts a dozen points in the fullest.
void require_local(const NeighborGrid& grid) {
  constexpr std::size_t most = 512;
  if (grid.fullest_cell() <= most) return;
  throw Error(ErrorCode::degenerate_input, "the points are so clustered that " +
                                               std::to_string(grid.fullest_cell()) +
                                               " of them lie within one mean spacing; remove repetitions, or "
                                               "give these points a domain that they are spread over");
}

}  // namespace

MovingSet::MovingSet(const PointSet& points, const Control& control)
    : points_(points),
      grid_(points_, hexagonal_spacing(*points.domain, points.size())),
      units_(points.size()),
      freedoms_(points.size()),
      marks_(points.size()) {
  require_usable(points, control);
  require_local(grid_);
  for (std::size_t i = 0; i < size(); ++i) freedoms_[i] = domain().freedom(points_[i]);
  set_units(control);
}

/// n = sum over all cells of 2 A_i / (sqrt(3) u_i^2), and half the boundary's length in units, u_i = c r_i.
void MovingSet::set_units(const Control& control) {
  spacing_ = hexagonal_spacing(domain(), size());
  if (points_.sizing == nullptr) {
    std::fill(units_.begin(), units_.end(), spacing_);
    return;
  }
  const std::vector<double> radii = radii_of(points_, points_.sizing.get());
  std::vector<double> areas(size());
  parallel_blocks(size(), block, control, [&](std::size_t begin, std::size_t end) {
    CellFinder cells = finder(control);
    for (std::size_t i = begin; i < end; ++i) {
      cells.load(static_cast<std::uint32_t>(i), 2.3 * spacing_);
      cells.cell_at({});
      areas[i] = cells.moments().area;
    }
  });
  double inside = 0, rim_count = 0, rim_inverse = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    inside += 2 * areas[i] / (std::sqrt(3.0) * radii[i] * radii[i]);
    if (freedoms_[i].dimensions == 2) continue;
    ++rim_count;
    rim_inverse += 1 / radii[i];
  }
  const double rim = rim_count > 0 ? domain().boundary_length() / 2 * rim_inverse / rim_count : 0;
  const auto n = static_cast<double>(size());
  spacing_ = (rim + std::sqrt(rim * rim + 4 * n * inside)) / (2 * n);
  for (std::size_t i = 0; i < size(); ++i) units_[i] = spacing_ * radii[i];
}

void MovingSet::move_to(std::size_t i, Vec3 to) {
  const Vec3 from = points_[i];
  points_.set(i, to);
  grid_.move(static_cast<std::uint32_t>(i), from, points_[i]);
  renew(i);
}

/// What depends on where the point is.
void MovingSet::renew(std::size_t i) {
  if (points_.sizing != nullptr) units_[i] = spacing_ * points_.sizing->at(points_[i]);
  if (freedoms_[i].dimensions == 1) freedoms_[i] = domain().freedom(points_[i]);
}

void MovingSet::put(const Places& places) {
  points_.coordinates = places;
  grid_ = NeighborGrid(points_, hexagonal_spacing(domain(), size()));
  for (std::size_t i = 0; i < size(); ++i) renew(i);
  marks_.clear();
}

MeshRadii MovingSet::measure(const Control& control) const {
  std::vector<MeshRadii> parts((size() + block - 1) / block);
  parallel_blocks(size(), block, control, [&](std::size_t begin, std::size_t end) {
    CellFinder cells = finder(control);
    MeshRadii& part = parts[begin / block];
    part = {std::numeric_limits<double>::infinity(), 0};
    for (std::size_t i = begin; i < end; ++i) {
      if (i % 64 == 0) control.check();
      const MeshRadii radii = radii_at(i, cells);
      part = {std::min(part.shortest, radii.shortest), std::max(part.outermost, radii.outermost)};
    }
  });
  MeshRadii all = parts.front();
  for (const MeshRadii& part : parts)
    all = {std::min(all.shortest, part.shortest), std::max(all.outermost, part.outermost)};
  return all;
}

MeshRadii MovingSet::radii_at(std::size_t i, CellFinder& cells) const {
  cells.load(static_cast<std::uint32_t>(i), reach(i));
  cells.cell_at({});
  MeshRadii radii{std::numeric_limits<double>::infinity(), 0};
  for (const Neighbor& neighbor : cells.neighbors()) {
    if (neighbor.id == i || both_fixed(i, neighbor.id)) continue;
    const double unit = std::min(units_[i], units_[neighbor.id]);
    radii.shortest = std::min(radii.shortest, norm(domain().way_to(points_[i], neighbor)) / unit);
    if (points_.sizing == nullptr) break;  // nearest first
  }
  radii.outermost = domain().chart_to_distance(std::sqrt(cells.outradius2())) / units_[i];
  return radii;
}

}  // namespace wellspaced

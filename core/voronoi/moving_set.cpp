#include "core/voronoi/moving_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/domain/sizing.h"
#include "core/error.h"
#include "core/parallel.h"

namespace wellspaced {
namespace {

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
  std::fill(units_.begin(), units_.end(), spacing_);
  if (points_.sizing == nullptr) return;
  const std::vector<double> radii = radii_of(points_, points_.sizing.get());
  std::vector<double> areas(size());
  for_each_cell(control, [&](std::size_t i, CellFinder& cells) { areas[i] = cells.area(); });
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

void MovingSet::put_back(std::size_t i, Vec3 to) {
  points_.set(i, to);
  grid_.put_back(static_cast<std::uint32_t>(i), to);
  renew(i);
}

Vec2 MovingSet::free_part(std::size_t i, Vec2 move) const {
  const Freedom& freedom = freedoms_[i];
  if (freedom.dimensions == 2) return move;
  return freedom.dimensions == 1 ? dot(move, freedom.along) * freedom.along : Vec2{};
}

std::vector<Vec2> MovingSet::spokes(std::size_t i, const CellFinder& cells) const {
  std::vector<std::int32_t> labels;
  for (const Cell& part : cells.parts())
    for (const Cell::Corner& corner : part.corners())
      if (corner.label >= 0 && std::find(labels.begin(), labels.end(), corner.label) == labels.end())
        labels.push_back(corner.label);
  std::vector<Vec2> ways;
  for (const std::int32_t label : labels)
    ways.push_back((1 / units_[i]) *
                   domain().way_to(points_[i], cells.neighbors()[static_cast<std::size_t>(label)]));
  return ways;
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
  BlockRadii blocks(size());
  for_each_cell(control, [&](std::size_t i, CellFinder& cells) { include_radii(i, cells, blocks); });
  return blocks.total();
}

void MovingSet::include_radii(std::size_t i, CellFinder& cells, BlockRadii& blocks) const {
  MeshRadii& radii = blocks.of(i);
  for (const Neighbor& neighbor : cells.neighbors()) {
    if (neighbor.id == i || both_fixed(i, neighbor.id)) continue;
    const double unit = std::min(units_[i], units_[neighbor.id]);
    radii.shortest = std::min(radii.shortest, norm(domain().way_to(points_[i], neighbor)) / unit);
    if (points_.sizing == nullptr) break;  // nearest first
  }
  constexpr double slack = 0.9;  // corners may turn out to be farther away than they say
  radii.outermost =
      std::max(radii.outermost, cells.outradius(slack * radii.outermost * units_[i]) / units_[i]);
}

MovingSet::CellIntegrals MovingSet::integrals(std::size_t i, CellFinder& cells) const {
  const PolygonMoments m = points_.sizing == nullptr ? cells.moments() : weighted_moments(i, cells);
  const double u = units_[i], u2 = u * u;
  return {m.area / u2, (1 / (m.area * u)) * m.first, m.second / (u2 * u2)};
}

/// Triangles around each part's first corner, each with the weight of its middle, as r(x) is there in
/// relation to the point's own.
PolygonMoments MovingSet::weighted_moments(std::size_t i, CellFinder& cells) const {
  PolygonMoments sum;
  const double own = points_.sizing->at(points_[i]);
  for (const Cell& part : cells.parts()) {
    const std::span<const Cell::Corner> corners = part.corners();
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const std::array<Vec2, 3> triangle = {corners[0].at, corners[k - 1].at, corners[k].at};
      const Vec2 middle = (1.0 / 3) * (triangle[0] + triangle[1] + triangle[2]);
      const double ratio = own / points_.sizing->at(domain().place_at(points_[i], middle));
      PolygonMoments m = domain().moments(triangle);
      const double weight = ratio * ratio * ratio * ratio;
      m.area *= weight;
      m.first = weight * m.first;
      m.second *= weight;
      sum += m;
    }
  }
  return sum;
}

}  // namespace wellspaced

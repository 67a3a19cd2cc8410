#include "core/voronoi/stars.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "core/domain/near_pair.h"
#include "core/parallel.h"
#include "core/voronoi/cell_finder.h"
#include "core/voronoi/gift_wrap.h"
#include "core/voronoi/grid_order.h"
#include "core/voronoi/neighbors.h"

namespace wellspaced {

namespace {

/// `reach`: how far each point looks at first.
void visit_stars_within(const PointSet& points, double reach, const Control& control,
                        const StarVisitor& visit) {
  const NeighborGrid grid(points, hexagonal_spacing(points.domain->area(), points.size()));
  parallel_blocks(points.size(), 1024, control, [&](std::size_t begin, std::size_t end) {
    CellFinder finder(points, grid, reach, control);
    std::vector<Spoke> spokes;
    for (std::size_t i = begin; i < end; ++i) {
      // A block may take seconds where very many points are near each other.
      if (i % 16 == 0) control.check();
      finder.load(static_cast<std::uint32_t>(i));
      spokes.clear();
      for (const Cell::Corner& corner : finder.cell_at({}).corners()) {
        const Neighbor& neighbor = finder.neighbors()[static_cast<std::size_t>(corner.label)];
        spokes.push_back({{neighbor.offset.x, neighbor.offset.y}, neighbor.id});
      }
      visit(i, spokes);
    }
  });
}

/// The ways that don't prove their stars with each other's must not be believed blindly.
void require_closed(std::span<const Spoke> spokes) {
  if (spokes.size() < 3) throw hidden_triangles();
}

/// Points nearer to each other have cells of sizes so different that what is small for one is not for the
/// other. That is for exact predicates.
double kernel_distance(const PointSet& points) {
  return 1e-5 * hexagonal_spacing(points.domain->area(), points.size());
}

/// A nearest sample is always a Delaunay neighbor.
bool any_near(const GridOrder& order, std::span<const Star> stars, double distance, const Control& control) {
  std::atomic<bool> near = false;
  parallel_blocks(order.size(), 8192, control, [&](std::size_t begin, std::size_t end) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < stars[i].degree; ++k)
        nearest2 = std::min(nearest2, norm2(order.offset(i, stars[i].neighbor[k])));
    if (nearest2 < distance * distance) near = true;
  });
  return near;
}

}  // namespace

Error hidden_triangles() {
  return {
      ErrorCode::degenerate_input,
      "the points are so nearly on one line, or on top of each other, that rounding hides their triangles; "
      "move some of them"};
}

bool is_even(const PointSet& points) {
  constexpr double points_a_cell = 24;
  if (points.size() < 500) return true;  // looking at all of them is cheap
  const double spacing = hexagonal_spacing(points.domain->area(), points.size());
  const NeighborGrid grid(points, spacing * std::sqrt(points_a_cell));
  return grid.empty_cells() == 0 && static_cast<double>(grid.fullest_cell()) <= 8 * points_a_cell;
}

void visit_stars_by_kernel(const PointSet& points, const Control& control, const StarVisitor& visit) {
  const double spacing = hexagonal_spacing(points.domain->area(), points.size());
  visit_stars_within(points, 2.3 * spacing, control, visit);
}

bool visit_stars_by_wrapping(const PointSet& points, const Control& control, const StarVisitor& visit) {
  const double spacing = hexagonal_spacing(points.domain->area(), points.size());
  const GridOrder order = grid_order(points, wrap_cell * spacing, control);
  const auto stars = wrap_stars(order, control);
  if (!stars || any_near(order, *stars, kernel_distance(points), control)) return false;
  parallel_blocks(order.size(), 4096, control, [&](std::size_t begin, std::size_t end) {
    std::array<Spoke, Star::most> spokes;
    for (std::size_t i = begin; i < end; ++i) {
      const Star& star = (*stars)[i];
      for (int k = 0; k < star.degree; ++k) {
        const std::uint32_t j = star.neighbor[k];
        spokes[static_cast<std::size_t>(k)] = {order.offset(i, j), order.original[j]};
      }
      visit(order.original[i], {spokes.data(), static_cast<std::size_t>(star.degree)});
    }
  });
  return true;
}

void visit_stars(const PointSet& points, const Control& control, const StarVisitor& visit) {
  if (visit_stars_by_wrapping(points, control, visit)) return;
  const StarVisitor visit_closed = [&](std::size_t i, std::span<const Spoke> spokes) {
    require_closed(spokes);
    visit(i, spokes);
  };
  if (is_even(points) && !find_near_pair(points, kernel_distance(points), control))
    visit_stars_by_kernel(points, control, visit_closed);
  else
    visit_stars_by_cgal(points, control, visit_closed);
}

}  // namespace wellspaced

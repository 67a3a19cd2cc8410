#include "core/voronoi/stars.h"

#include <array>
#include <cmath>
#include <vector>

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

}  // namespace

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
  if (!stars) return false;
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
  if (is_even(points))
    visit_stars_by_kernel(points, control, visit);
  else
    visit_stars_by_cgal(points, control, visit);
}

}  // namespace wellspaced

#include "core/optimize/capacity_step.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/voronoi/star_cell.h"

namespace wellspaced {
namespace {

constexpr double longest_step = 0.2;
constexpr double thinnest = 1e-3;             // twice the area that a triangle must keep
const double mean_area = std::sqrt(3.0) / 2;  // of a cell, in units of d_hex squared

bool keeps_positive(const StarMesh& mesh, std::uint32_t j, Vec2 by) {
  const Star& star = mesh.star(j);
  Vec2 a = mesh.offset(j, star.neighbor[star.degree - 1]) - by;
  for (int k = 0; k < star.degree; ++k) {
    const Vec2 b = mesh.offset(j, star.neighbor[k]) - by;
    if (!(cross(a, b) >= thinnest)) return false;
    a = b;
  }
  return true;
}

void suspect_and_mark_around(StarMesh& mesh, std::uint32_t j, Suspects& suspects) {
  const Star& star = mesh.star(j);
  mesh.mark(j);
  for (int k = 0; k < star.degree; ++k) {
    mesh.mark(star.neighbor[k]);
    suspects.add(j, star.neighbor[k]);
    suspects.add(star.neighbor[k], star.neighbor[star.after(k)]);
  }
}

void move_if_possible(StarMesh& mesh, std::uint32_t j, Vec2 by, Suspects& suspects) {
  constexpr int most_halvings = 4;
  const double length = norm(by);
  if (length > longest_step) by = (longest_step / length) * by;
  for (int halvings = 0; halvings <= most_halvings; ++halvings, by = 0.5 * by) {
    if (!keeps_positive(mesh, j, by)) continue;
    mesh.move_to(j, mesh.moved(j, by));
    suspect_and_mark_around(mesh, j, suspects);
    return;
  }
}

}  // namespace

double area_deviation(const StarMesh& mesh, std::size_t i) { return area(StarCell(mesh, i)) / mean_area - 1; }

bool capacity_step(StarMesh& mesh, std::size_t i, double most) {
  const StarCell cell(mesh, i);
  const double excess = area(cell) - mean_area;
  if (!(std::abs(excess) > most * mean_area)) return false;
  double length[Star::most] = {}, square_sum = 0;
  for (int k = 0; k < cell.degree; ++k) {
    length[k] = norm(cell.corner[k] - cell.corner[cell.before(k)]);
    square_sum += length[k] * length[k];
  }
  Suspects suspects{mesh.everywhere()};
  const Star star = mesh.star(i);  // a copy: flips change the mesh's
  for (int k = 0; k < star.degree; ++k) {
    const double inwards = 2 * excess / square_sum * length[k];
    move_if_possible(mesh, star.neighbor[k], (-inwards / norm(cell.spoke[k])) * cell.spoke[k], suspects);
  }
  mesh.mark(i);
  mesh.legalize(suspects);
  return true;
}

namespace {

/// An edge of a cell: the neighbor beyond it, the way there and the edge's length, in units.
struct CellSide {
  std::uint32_t neighbor;
  Vec2 way;
  double length;
};

std::vector<CellSide> sides_of(const MovingSet& set, std::size_t i, CellFinder& cells) {
  std::vector<CellSide> sides;
  for (const Cell& part : cells.parts()) {
    const std::span<const Cell::Corner> corners = part.corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (corners[k].label < 0) continue;
      const Neighbor& neighbor = cells.neighbors()[static_cast<std::size_t>(corners[k].label)];
      const Vec2 end = corners[k + 1 == corners.size() ? 0 : k + 1].at;
      sides.push_back({neighbor.id, (1 / set.unit(i)) * set.domain().way_to(set[i], neighbor),
                       norm(end - corners[k].at) / set.unit(i)});
    }
  }
  return sides;
}

double mean_inside(const MovingSet& set, const std::vector<double>& areas) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set.freedom(i).dimensions != 2) continue;
    sum += areas[i];
    ++count;
  }
  return count > 0 ? sum / count : 1;
}

double area_in_units(const MovingSet& set, std::size_t i, CellFinder& cells) {
  return cells.area() / (set.unit(i) * set.unit(i));
}

/// What the cell of each point inside that deviates asks of a neighbor, for each unit of the edge between
/// them.
std::vector<double> pulls_of(const MovingSet& set, double most, const Control& control) {
  std::vector<double> areas(set.size()), pulls(set.size());
  set.for_each_cell(control, [&](std::size_t i, CellFinder& cells) {
    areas[i] = area_in_units(set, i, cells);
    for (const CellSide& side : sides_of(set, i, cells)) pulls[i] += side.length * side.length;
  });
  const double mean = mean_inside(set, areas);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double excess = areas[i] - mean;
    const bool deviates = set.freedom(i).dimensions == 2 && std::abs(excess) > most * mean;
    pulls[i] = deviates ? excess / pulls[i] : 0;
  }
  return pulls;
}

}  // namespace

std::vector<double> area_deviations(const MovingSet& set, const Control& control) {
  std::vector<double> areas(set.size());
  set.for_each_cell(control,
                    [&](std::size_t i, CellFinder& cells) { areas[i] = area_in_units(set, i, cells); });
  const double mean = mean_inside(set, areas);
  for (std::size_t i = 0; i < set.size(); ++i)
    areas[i] = set.freedom(i).dimensions == 2 ? areas[i] / mean - 1 : 0;
  return areas;
}

std::size_t capacity_sweep(MovingSet& set, double most, const Control& control) {
  const std::vector<double> pulls = pulls_of(set, most, control);
  std::vector<Vec2> moves(set.size());
  set.for_each_cell(control, [&](std::size_t j, CellFinder& cells) {
    for (const CellSide& side : sides_of(set, j, cells))
      moves[j] = moves[j] + (pulls[side.neighbor] * side.length / norm(side.way)) * side.way;
  });
  std::size_t moved = 0;
  for (std::size_t j = 0; j < set.size(); ++j) {
    const double length = norm(moves[j]);
    const Vec2 move = length > longest_step ? (longest_step / length) * moves[j] : moves[j];
    const Vec2 possible = set.domain().possible(set[j], set.unit(j) * move);
    if (possible == Vec2{}) continue;
    set.move_to(j, set.domain().step(set[j], possible));
    set.mark(j);
    ++moved;
  }
  return moved;
}

}  // namespace wellspaced

#include "core/optimize/capacity_step.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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

}  // namespace wellspaced

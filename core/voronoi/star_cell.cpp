#include "core/voronoi/star_cell.h"

#include <algorithm>

namespace wellspaced {

StarCell::StarCell(const StarMesh& mesh, std::size_t i) : degree(mesh.star(i).degree) {
  const Star& star = mesh.star(i);
  double length2[Star::most] = {};
  for (int k = 0; k < degree; ++k) {
    spoke[k] = mesh.offset(i, star.neighbor[k]);
    length2[k] = norm2(spoke[k]);
  }
  for (int k = 0; k < degree; ++k) {
    const int next = star.after(k);
    const Vec2 a = spoke[k], b = spoke[next];
    const double h = 0.5 / cross(a, b);
    corner[k] = {h * (b.y * length2[k] - a.y * length2[next]), h * (a.x * length2[next] - b.x * length2[k])};
  }
}

CellMoments moments(const StarCell& cell) {
  CellMoments m;
  Vec2 p = cell.corner[cell.degree - 1];
  double p2 = norm2(p);
  m.shortest2 = norm2(cell.spoke[0]);
  for (int k = 0; k < cell.degree; ++k) {
    const Vec2 q = cell.corner[k];
    const double q2 = norm2(q), twice_area = cross(p, q);
    m.area += twice_area;
    m.centroid = m.centroid + twice_area * (p + q);
    m.energy += twice_area * (p2 + dot(p, q) + q2);
    m.shortest2 = std::min(m.shortest2, norm2(cell.spoke[k]));
    m.outermost2 = std::max(m.outermost2, q2);
    p = q;
    p2 = q2;
  }
  m.centroid = (1 / (3 * m.area)) * m.centroid;
  m.area /= 2;
  m.energy /= 12;
  return m;
}

double area(const StarCell& cell) {
  double twice_area = 0;
  for (int k = 0; k < cell.degree; ++k) twice_area += cross(cell.corner[cell.before(k)], cell.corner[k]);
  return twice_area / 2;
}

}  // namespace wellspaced

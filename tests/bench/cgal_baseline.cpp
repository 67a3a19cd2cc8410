#include "tests/bench/cgal_baseline.h"

#include <algorithm>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "core/voronoi/cell.h"
#include "core/voronoi/stars.h"

namespace wellspaced::bench {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double cgal_delaunay(const PointSet& points) {
  std::vector<Kernel::Point_2> corners;
  corners.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) corners.emplace_back(points[i].x, points[i].y);
  const CGAL::Delaunay_triangulation_2<Kernel> triangulation(corners.begin(), corners.end());
  double largest = 0;
  for (const auto& face : triangulation.finite_face_handles()) {
    const Kernel::Point_2 a = face->vertex(0)->point(), b = face->vertex(1)->point(),
                          c = face->vertex(2)->point();
    largest = std::max(largest,
                       norm2(circumcenter({b.x() - a.x(), b.y() - a.y()}, {c.x() - a.x(), c.y() - a.y()})));
  }
  return largest;
}

double cgal_lloyd(const PointSet& points) {
  double moved = 0;
  visit_stars_by_cgal(points, Control(), [&](std::size_t, std::span<const Spoke> spokes) {
    Vec2 moment;
    double twice_area = 0;
    Vec2 before = circumcenter(spokes.back().offset, spokes.front().offset);
    for (std::size_t k = 0; k < spokes.size(); ++k) {
      const Vec2 next = circumcenter(spokes[k].offset, spokes[k + 1 == spokes.size() ? 0 : k + 1].offset);
      const double part = cross(before, next);
      moment = moment + part * (before + next);
      twice_area += part;
      before = next;
    }
    moved += norm2((1 / (3 * twice_area)) * moment);
  });
  return moved / static_cast<double>(points.size());
}

}  // namespace wellspaced::bench

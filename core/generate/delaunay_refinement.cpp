#include "core/generate/delaunay_refinement.h"

#include <algorithm>

#include "core/generate/farthest_point.h"
#include "core/generate/generate.h"
#include "core/generate/poisson_disk.h"
#include "core/generate/row_order.h"

namespace wellspaced {
namespace {

constexpr double density = 0.662;  // n r^2 / A, measured from 10,000 points to a million

/// With beta <= 1 on a torus of any aspect; the second point only where it is far enough from the first.
PointSet start(const std::shared_ptr<const Torus>& torus, std::size_t most, double radius) {
  const Vec3 second{0.45 * torus->width(), 0.38 * torus->height(), 0};
  PointSet points{torus, {0, 0}};
  if (most > 1 && torus->distance({}, second) >= radius) points.push_back(second);
  return points;
}

}  // namespace

double delaunay_refinement_count(double area, double radius) { return density * area / (radius * radius); }

PointSet delaunay_refinement(const std::shared_ptr<const Torus>& torus, double radius, Control& control) {
  require_radius(*torus, radius);
  PointSet points = start(torus, 2, radius);
  FarthestPointEnd end;
  end.coverage = radius;
  insert_farthest(points, end, control);
  bring_into_rows(points, 0, radius, control);
  control.report({1});
  return points;
}

PointSet delaunay_refinement_of_count(const std::shared_ptr<const Torus>& torus, std::uint64_t count,
                                      Control& control) {
  PointSet points = start(torus, count, 0);
  FarthestPointEnd end;
  end.count = count;
  insert_farthest(points, end, control);
  bring_into_rows(points, 0, radius_for_count(*torus, static_cast<double>(count)), control);
  control.report({1});
  return points;
}

}  // namespace wellspaced

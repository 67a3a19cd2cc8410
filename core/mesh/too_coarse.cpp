#include "core/mesh/too_coarse.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/analyze/spacing.h"
#include "core/domain/sphere.h"
#include "core/domain/surface_mesh.h"
#include "core/math.h"
#include "core/mesh/border_chains.h"
#include "core/text.h"

namespace wellspaced {
namespace {

/// A place of the border near which there should be a point.
std::optional<std::string> bare_border(const PointSet& points) {
  for (const BorderChain& chain : border_chains(points)) {
    for (const BorderChain::Link& link : chain.links)
      if (link.point == BorderChain::none)
        return "the corner " + short_text(points.domain->boundary_point(chain.curve, link.along)) +
               " of the domain's border is no point";
    if (chain.links.size() < 3 && chain.closed)
      return "the closed border through " + short_text(points.domain->boundary_point(chain.curve, 0)) +
             " has " + std::to_string(chain.links.size()) + " points on it, of at least 3";
  }
  return {};
}

std::optional<std::string> half_of_sphere(const PointSet& points, double r_c) {
  const auto* const sphere = dynamic_cast<const Sphere*>(points.domain.get());
  if (sphere == nullptr) return {};
  const double quarter = sphere->radius() * pi / 2;
  if (r_c < quarter * (1 - 1e-9)) return {};
  return "they lie in one half of the sphere, with a coverage radius of " + short_number(r_c) +
         ", and triangles that cover it need less than a quarter turn, " + short_number(quarter) +
         "; add points in the other half";
}

Error refusal(const std::string& because) {
  return {ErrorCode::infeasible, "the points are too few to follow the domain: " + because};
}

std::string with_smallest_feature(const PointSet& points, double r_c) {
  std::string because;
  double would_do = r_c / 2;
  if (const auto* const mesh = dynamic_cast<const SurfaceMesh*>(points.domain.get())) {
    const SmallestFeature feature = mesh->smallest_feature();
    if (feature.length < r_c && feature.length > r_c / 8) would_do = feature.length;
    because = "; the smallest feature is " + short_number(feature.length) + ", " + feature.description;
  }
  return short_number(would_do) + " would do" + because;
}

}  // namespace

Error too_coarse(const PointSet& points, const Control& control) {
  if (const auto bare = bare_border(points))
    return refusal(*bare + "; sample the border and its corners first, as poisson-disk does");
  const double r_c = measure_spacing(points, control).r_c;
  if (const auto half = half_of_sphere(points, r_c)) return refusal(*half);
  return refusal("with a coverage radius of " + short_number(r_c) +
                 ", their Delaunay triangles are no surface of the same topology; " +
                 with_smallest_feature(points, r_c));
}

}  // namespace wellspaced

#include "proto/small_features.h"

#include "core/domain/polygon.h"
#include "core/domain/surface_mesh.h"
#include "proto/fields.h"

namespace wellspaced {
namespace {

template <class Feature>
void require(const Feature& feature, double radius, const std::string& where) {
  if (radius <= feature.length) return;
  throw Error(ErrorCode::infeasible,
              "points " + number_text(radius) + " apart can't follow the smallest feature of the domain, " +
                  feature.description + ": ask for a radius of at most " + number_text(feature.length) +
                  ", or set allow_small_features to true, and what is smaller is passed over",
              where);
}

}  // namespace

void require_no_smaller_feature(const Domain& domain, double radius, const std::string& where) {
  if (const auto* const polygon = dynamic_cast<const Polygon*>(&domain))
    require(polygon->smallest_feature(), radius, where);
  if (const auto* const mesh = dynamic_cast<const SurfaceMesh*>(&domain))
    require(mesh->smallest_feature(), radius, where);
}

}  // namespace wellspaced

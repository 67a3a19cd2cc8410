#pragma once

#include <memory>
#include <vector>

#include "core/domain/unfolding.h"

namespace wellspaced::testing {

/// CGAL's exact geodesic distances (Chen and Han) from one place of a mesh to others.
class GeodesicOracle {
 public:
  explicit GeodesicOracle(const TriangleMesh& mesh);
  ~GeodesicOracle();

  std::vector<double> distances(const MeshPlace& from, const std::vector<MeshPlace>& to);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace wellspaced::testing

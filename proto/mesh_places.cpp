#include "proto/mesh_places.h"

#include <vector>

#include "core/domain/surface_mesh.h"
#include "proto/json_writer.h"

namespace wellspaced {

std::string place_members(const PointSet& points) {
  const auto& mesh = dynamic_cast<const SurfaceMesh&>(*points.domain);
  std::string text = ",\"face\":[";
  std::vector<double> weights;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const MeshPlace place = mesh.locate(points[i]);
    if (i > 0) text += ',';
    text += std::to_string(place.face);
    weights.insert(weights.end(), place.weights.begin(), place.weights.end());
  }
  return text + "],\"barycentric\":" + rows_to_json(weights.data(), points.size(), 3);
}

}  // namespace wellspaced

#pragma once

#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "core/domain/surface_mesh.h"

namespace wellspaced {

/// A mesh as a request brings it, before the domain has looked at it.
struct SurfaceMeshText {
  Triangles triangles;
  TriangleMesh::Crossings crossings = TriangleMesh::Crossings::refuse;
};

/// The same as read_surface_mesh, unchecked.
SurfaceMeshText read_surface_mesh_text(const nlohmann::json& value, const std::string& pointer);

/// {"type": "mesh", "vertices": [[x, y, z], ...], "faces": [[i, j, k], ...]}, and "allow_self_intersections".
/// Errors: invalid_parameters at the first value that is not what it should be; those of TriangleMesh, at the
/// face or vertex.
std::shared_ptr<const SurfaceMesh> read_surface_mesh(const nlohmann::json& value, const std::string& pointer);

/// Reads back as the same bits.
nlohmann::ordered_json surface_mesh_to_json(const SurfaceMesh& domain);

}  // namespace wellspaced

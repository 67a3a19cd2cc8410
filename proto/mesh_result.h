#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/mesh/mesh.h"
#include "core/mesh/mesh_quality.h"

namespace wellspaced {

/// The quality report as users see it. `domain_area`: what the area is of.
nlohmann::ordered_json quality_to_json(const MeshQuality& quality, double domain_area);
/// Its JSON Schema.
nlohmann::ordered_json quality_schema();

/// ,"vertices":[...],"faces":[...] and which point is which: the end of a JSON result, numbers with as many
/// coordinates as the domain has.
std::string mesh_members(const Mesh& mesh, int dimension);

/// What of a mesh is in the head of a kept result, and its arrays.
nlohmann::ordered_json mesh_head(const Mesh& mesh);
void append_mesh(std::string& bytes, const Mesh& mesh);
/// Takes them from the front of `data`; nothing if there are too few bytes.
std::shared_ptr<const Mesh> take_mesh(const nlohmann::ordered_json& head, std::string_view& data);

}  // namespace wellspaced

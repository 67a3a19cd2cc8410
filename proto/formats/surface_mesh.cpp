#include "proto/formats/surface_mesh.h"

#include <array>
#include <cstdint>
#include <utility>

#include "core/error.h"
#include "proto/fields.h"

namespace wellspaced {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& message, const std::string& where) {
  throw Error(ErrorCode::invalid_parameters, message, where);
}

/// The rows of an array of arrays of three, each entry by `read(entry, where)`.
template <class Row, class Read>
std::vector<Row> read_rows(const json& value, const char* what, const std::string& pointer,
                           const Read& read) {
  if (!value.is_array())
    refuse("expected an array of " + std::string(what) + ", found " + describe(value), pointer);
  std::vector<Row> rows;
  rows.reserve(value.size());
  for (const json& entry : value) {
    const std::string where = pointer + "/" + std::to_string(rows.size());
    if (!entry.is_array() || entry.size() != 3)
      refuse("expected " + std::string(what) + ", three numbers each, found " +
                 (entry.is_array() ? std::to_string(entry.size()) + " of them" : describe(entry)),
             where);
    rows.push_back(
        {read(entry[0], where + "/0"), read(entry[1], where + "/1"), read(entry[2], where + "/2")});
  }
  return rows;
}

double read_coordinate(const json& value, const std::string& where) {
  if (!value.is_number()) refuse("expected a number, found " + describe(value), where);
  return value.get<double>();
}

std::uint32_t read_index(const json& value, const std::string& where) {
  const double index = value.is_number() ? value.get<double>() : -1;
  if (!(index >= 0 && index < 4294967296.0 && index == static_cast<std::uint32_t>(index)))
    refuse("expected the index of a vertex, counted from 0, found " + describe(value), where);
  return static_cast<std::uint32_t>(index);
}

}  // namespace

SurfaceMeshText read_surface_mesh_text(const json& value, const std::string& pointer) {
  Fields fields(value, pointer);
  fields.find("type");
  const json& vertices = fields.require("vertices", "[[x, y, z], ...]");
  const json& faces = fields.require("faces", "[[i, j, k], ...], indices of vertices, counted from 0");
  const bool allow = fields.flag("allow_self_intersections").value_or(false);
  fields.refuse_unknown();
  return {{read_rows<Vec3>(vertices, "vertices, [x, y, z]", fields.pointer_to("vertices"), read_coordinate),
           read_rows<std::array<std::uint32_t, 3>>(faces, "faces, [i, j, k]", fields.pointer_to("faces"),
                                                   read_index)},
          allow ? TriangleMesh::Crossings::allow : TriangleMesh::Crossings::refuse};
}

std::shared_ptr<const SurfaceMesh> read_surface_mesh(const json& value, const std::string& pointer) {
  SurfaceMeshText text = read_surface_mesh_text(value, pointer);
  try {
    return std::make_shared<const SurfaceMesh>(TriangleMesh(std::move(text.triangles), text.crossings));
  } catch (const Error& error) {
    throw error.within(pointer);
  }
}

nlohmann::ordered_json surface_mesh_to_json(const SurfaceMesh& domain) {
  nlohmann::ordered_json vertices = nlohmann::ordered_json::array(), faces = vertices;
  for (const Vec3& v : domain.mesh().vertices()) vertices.push_back({v.x, v.y, v.z});
  for (const auto& face : domain.mesh().faces()) faces.push_back(face);
  nlohmann::ordered_json result = {
      {"type", "mesh"}, {"vertices", std::move(vertices)}, {"faces", std::move(faces)}};
  if (domain.mesh().crossings() == TriangleMesh::Crossings::allow) result["allow_self_intersections"] = true;
  return result;
}

}  // namespace wellspaced

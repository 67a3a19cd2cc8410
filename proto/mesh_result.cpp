#include "proto/mesh_result.h"

#include <cstring>
#include <vector>

#include "proto/json_writer.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

ordered_json spread_to_json(const Spread& spread) {
  return {{"min", spread.least}, {"mean", spread.mean}, {"max", spread.most}};
}

ordered_json described(const char* type, const char* description) {
  return {{"type", type}, {"description", description}};
}

ordered_json spread_schema(const char* description) {
  const ordered_json number = {{"type", "number"}};
  return {{"type", "object"},
          {"description", description},
          {"properties", {{"min", number}, {"mean", number}, {"max", number}}},
          {"required", {"min", "mean", "max"}}};
}

ordered_json histogram_schema(const char* description) {
  return {{"type", "object"},
          {"description", description},
          {"properties",
           {{"low", {{"type", "number"}}},
            {"width", {{"type", "number"}}},
            {"counts", {{"type", "array"}, {"items", {{"type", "integer"}}}}}}}};
}

void append_point(std::string& out, std::uint32_t point) {
  out += point == Mesh::no_point ? "null" : std::to_string(point);
}

void append_points(std::string& out, const char* name, const std::vector<std::uint32_t>& points) {
  out += std::string(",\"") + name + "\":[";
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k != 0) out += ',';
    append_point(out, points[k]);
  }
  out += ']';
}

template <class Number>
void append_array(std::string& bytes, const std::vector<Number>& numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

template <class Number>
bool take_array(std::string_view& data, std::size_t count, std::vector<Number>& numbers) {
  if (data.size() / sizeof(Number) < count) return false;
  numbers.resize(count);
  if (count != 0) std::memcpy(numbers.data(), data.data(), count * sizeof(Number));
  data.remove_prefix(count * sizeof(Number));
  return true;
}

}  // namespace

ordered_json quality_to_json(const MeshQuality& quality, double domain_area) {
  ordered_json valence = ordered_json::object();
  for (const auto& [corners, count] : quality.valence) valence[std::to_string(corners)] = count;
  ordered_json out = {{"vertices", quality.vertices}, {"faces", quality.faces}};
  if (quality.topology) {
    out["edges"] = quality.topology->edges;
    out["boundary_edges"] = quality.topology->boundary_edges;
    out["boundary_length"] = quality.topology->boundary_length;
    out["euler_characteristic"] = quality.topology->euler_characteristic;
  }
  out["area"] = quality.area;
  out["domain_area"] = domain_area;
  out["face_area"] = spread_to_json(quality.face_area);
  out["edge_length"] = spread_to_json(quality.edge_length);
  out["angle_deg"] = spread_to_json(quality.angle_deg);
  out["angles"] = {{"low", 0}, {"width", 5}, {"counts", quality.angles}};
  out["aspect_ratio"] = spread_to_json(quality.aspect_ratio);
  out["aspect_ratios"] = {{"low", 1}, {"width", 0.1}, {"counts", quality.aspect_ratios}};
  out["valence"] = std::move(valence);
  return out;
}

ordered_json quality_schema() {
  return {
      {"type", "object"},
      {"description", "of the mesh as it is, with straight edges"},
      {"properties",
       {{"vertices", described("integer", "images across seams not counted")},
        {"faces", described("integer", "triangles, or parts of cells")},
        {"edges", described("integer", "of Delaunay meshes; across seams, too")},
        {"boundary_edges", described("integer", "edges with one face")},
        {"boundary_length", described("number", "of these together")},
        {"euler_characteristic", described("integer", "vertices - edges + faces")},
        {"area", described("number", "of all faces")},
        {"domain_area", described("number", "what they are to cover; curved ones are a little larger")},
        {"face_area", spread_schema("of one face")},
        {"edge_length", spread_schema("of the edges of faces")},
        {"angle_deg", spread_schema("of the corners of faces")},
        {"angles", histogram_schema("of these; the last bin holds all above")},
        {"aspect_ratio", spread_schema("of triangles, circumradius over twice the inradius; of cells, the "
                                       "longest way across over the shortest; 1 is best")},
        {"aspect_ratios", histogram_schema("of these; the last bin holds all above")},
        {"valence", described("object",
                              "how many vertices inside have that many edges; of cells: how many "
                              "have that many corners")}}},
      {"required", {"vertices", "faces", "area", "domain_area", "angle_deg", "aspect_ratio", "valence"}}};
}

std::string mesh_members(const Mesh& mesh, int dimension) {
  const auto columns = static_cast<std::size_t>(dimension);
  std::vector<double> values;
  values.reserve(mesh.vertices.size() * columns);
  for (const Vec3 at : mesh.vertices) {
    values.insert(values.end(), {at.x, at.y});
    if (columns == 3) values.push_back(at.z);
  }
  std::string out =
      ",\"vertices\":" + rows_to_json(values.data(), mesh.vertices.size(), columns) + ",\"faces\":[";
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    out += f == 0 ? "[" : ",[";
    for (const std::uint32_t v : mesh[f]) {
      if (out.back() != '[') out += ',';
      out += std::to_string(v);
    }
    out += ']';
  }
  out += ']';
  if (!mesh.vertex_points.empty()) append_points(out, "vertex_points", mesh.vertex_points);
  if (!mesh.face_points.empty()) append_points(out, "face_points", mesh.face_points);
  return out;
}

ordered_json mesh_head(const Mesh& mesh) {
  return {{"vertices", mesh.vertices.size()},
          {"corners", mesh.corners.size()},
          {"faces", mesh.faces()},
          {"vertex_points", mesh.vertex_points.size()},
          {"face_points", mesh.face_points.size()}};
}

void append_mesh(std::string& bytes, const Mesh& mesh) {
  append_array(bytes, mesh.vertices);
  append_array(bytes, mesh.corners);
  append_array(bytes, mesh.ends);
  append_array(bytes, mesh.vertex_points);
  append_array(bytes, mesh.face_points);
}

std::shared_ptr<const Mesh> take_mesh(const ordered_json& head, std::string_view& data) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  auto mesh = std::make_shared<Mesh>();
  const bool fine = take_array(data, head.at("vertices"), mesh->vertices) &&
                    take_array(data, head.at("corners"), mesh->corners) &&
                    take_array(data, head.at("faces"), mesh->ends) &&
                    take_array(data, head.at("vertex_points"), mesh->vertex_points) &&
                    take_array(data, head.at("face_points"), mesh->face_points);
  return fine ? mesh : nullptr;
}

}  // namespace wellspaced

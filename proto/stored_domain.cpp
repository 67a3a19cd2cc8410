#include "proto/stored_domain.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <openssl/sha.h>

#include "core/domain/polygon.h"
#include "core/domain/surface_mesh.h"
#include "core/error.h"
#include "proto/formats/mesh.h"
#include "proto/formats/polygon.h"
#include "proto/formats/surface_mesh.h"
#include "proto/json_reader.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

/// Of JSON texts: 2 million vertices of a polygon, or half a million faces.
constexpr std::size_t most_json_values = 8'000'000;

template <class Base>
class Stored final : public Base, public HasId {
 public:
  template <class Content>
  Stored(std::string id, Content&& content) : Base(std::forward<Content>(content)), HasId(std::move(id)) {}
};

std::shared_ptr<const Domain> stored_polygon(std::string id, const PolygonText& text) {
  try {
    return std::make_shared<const Stored<Polygon>>(std::move(id), text.rings);
  } catch (const Error& error) {
    throw text.located(error);
  }
}

std::shared_ptr<const Domain> stored_mesh(std::string id, Triangles triangles,
                                          TriangleMesh::Crossings crossings) {
  return std::make_shared<const Stored<SurfaceMesh>>(std::move(id),
                                                     TriangleMesh(std::move(triangles), crossings));
}

std::shared_ptr<const Domain> stored_json(std::string id, const DomainFile& file) {
  const nlohmann::json value = read_json(file.bytes, {}, 0, most_json_values).root;
  if (!value.is_object() || value.value("type", nlohmann::json()) != "mesh")
    return stored_polygon(std::move(id), read_polygon_text(value, ""));
  SurfaceMeshText text = read_surface_mesh_text(value, "");
  if (file.allow_self_intersections) text.crossings = TriangleMesh::Crossings::allow;
  return stored_mesh(std::move(id), std::move(text.triangles), text.crossings);
}

/// In small letters and without parameters.
std::string essence(std::string_view media_type) {
  std::string text(media_type.substr(0, media_type.find(';')));
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool begins_with_word(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) {
           return a == std::toupper(static_cast<unsigned char>(b));
         });
}

std::string detected_format(std::string_view bytes) {
  const std::string_view text = bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  if (text.starts_with('{')) return "json";
  for (const char* word : {"POLYGON", "MULTIPOLYGON"})
    if (begins_with_word(text, word)) return "wkt";
  return std::string(name_of(detect_mesh_format(bytes)));
}

ordered_json box_of(const std::vector<Vec3>& points, std::size_t dimension) {
  std::array<double, 3> low{}, high{};
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Vec3& p : points) {
    const std::array<double, 3> at = {p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], at[k]);
      high[k] = std::max(high[k], at[k]);
    }
  }
  ordered_json min = ordered_json::array(), max = ordered_json::array();
  for (std::size_t k = 0; k < dimension; ++k) {
    min.push_back(low[k]);
    max.push_back(high[k]);
  }
  return {{"min", std::move(min)}, {"max", std::move(max)}};
}

template <class Feature>
ordered_json feature_json(const Feature& feature) {
  if (!std::isfinite(feature.length)) return nullptr;
  return {{"length", feature.length}, {"description", feature.description}};
}

void add_facts(ordered_json& facts, const SurfaceMesh& domain) {
  const MeshFacts& mesh = domain.mesh().facts();
  facts["vertices"] = mesh.vertices;
  facts["unused_vertices"] = mesh.unused_vertices;
  facts["edges"] = mesh.edges;
  facts["faces"] = mesh.faces;
  facts["components"] = mesh.components;
  facts["boundaries"] = mesh.boundaries;
  facts["euler_characteristic"] = mesh.euler_characteristic;
  facts["genus"] = mesh.genus;
  facts["closed"] = mesh.closed;
  facts["volume"] = mesh.volume ? ordered_json(*mesh.volume) : ordered_json();
  std::vector<Vec3> used;
  for (const auto& face : domain.mesh().faces())
    for (const std::uint32_t v : face) used.push_back(domain.mesh().vertices()[v]);
  facts["box"] = box_of(used, 3);
  facts["smallest_feature"] = feature_json(domain.smallest_feature());
}

void add_facts(ordered_json& facts, const Polygon& domain) {
  const auto rings = domain.rings();
  std::vector<Vec3> vertices;
  for (const auto& ring : rings)
    for (const Vec2 p : ring) vertices.push_back({p.x, p.y, 0});
  facts["vertices"] = vertices.size();
  facts["holes"] = rings.size() - 1;
  facts["euler_characteristic"] = domain.euler_characteristic();
  facts["box"] = box_of(vertices, 2);
  facts["smallest_feature"] = feature_json(domain.smallest_feature());
}

}  // namespace

std::string domain_format_of(std::string_view media_type, std::string_view bytes) {
  const std::string type = essence(media_type);
  if (type == "application/geo+json") return "geojson";
  if (type == "application/json") return "json";
  if (type == "application/wkt" || type == "text/wkt") return "wkt";
  if (const auto format = mesh_format_of_media_type(type)) return std::string(name_of(*format));
  for (const char* general :
       {"", "text/plain", "application/octet-stream", "application/x-www-form-urlencoded"})
    if (type == general) return detected_format(bytes);
  throw Error(ErrorCode::unsupported_media_type,
              "a domain is application/geo+json, application/json, text/wkt, model/off, model/obj or "
              "model/ply; with text/plain or application/octet-stream its first bytes decide");
}

std::string content_id(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), hash.data());
  std::string id;
  for (const unsigned char byte : hash) {
    id += "0123456789abcdef"[byte >> 4];
    id += "0123456789abcdef"[byte & 15];
  }
  return id;
}

bool is_content_id(std::string_view id) {
  return id.size() == 2 * SHA256_DIGEST_LENGTH &&
         id.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::shared_ptr<const Domain> read_domain_file(const DomainFile& file) {
  std::string id = content_id(file.bytes);
  if (file.format == "json" || file.format == "geojson") return stored_json(std::move(id), file);
  if (file.format == "wkt") return stored_polygon(std::move(id), read_wkt(file.bytes, ""));
  const auto format = mesh_format_named(file.format);
  if (!format)
    throw Error(ErrorCode::invalid_parameters, "unknown format; there are: geojson, json, wkt, off, obj, ply",
                "/format");
  return stored_mesh(
      std::move(id), read_mesh(file.bytes, *format),
      file.allow_self_intersections ? TriangleMesh::Crossings::allow : TriangleMesh::Crossings::refuse);
}

ordered_json domain_facts(const Domain& domain) {
  ordered_json facts = {
      {"type", domain.type()}, {"area", domain.area()}, {"boundary_length", domain.boundary_length()}};
  if (const auto* mesh = dynamic_cast<const SurfaceMesh*>(&domain)) add_facts(facts, *mesh);
  if (const auto* polygon = dynamic_cast<const Polygon*>(&domain)) add_facts(facts, *polygon);
  return facts;
}

}  // namespace wellspaced

#include "proto/formats/polygon.h"

#include <utility>

#include "proto/fields.h"

namespace wellspaced {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& message, const std::string& where) {
  throw Error(ErrorCode::invalid_parameters, message, where);
}

std::string entry(const std::string& pointer, std::size_t k) { return pointer + "/" + std::to_string(k); }

const json::array_t& array_of(const json& value, const char* what, const std::string& pointer) {
  if (!value.is_array()) refuse("expected " + std::string(what) + ", found " + describe(value), pointer);
  return value.get_ref<const json::array_t&>();
}

Vec2 read_vertex(const json& value, const std::string& pointer) {
  const auto& numbers = array_of(value, "a vertex, [x, y]", pointer);
  if (numbers.size() > 2)
    refuse("a vertex has two coordinates here, this one has " + std::to_string(numbers.size()) +
               ": the polygon lies in the plane; leave the others out",
           entry(pointer, 2));
  if (numbers.size() < 2)
    refuse("a vertex has two coordinates, this one has " + std::to_string(numbers.size()), pointer);
  for (std::size_t k = 0; k < 2; ++k)
    if (!numbers[k].is_number())
      refuse("expected a number, found " + describe(numbers[k]), entry(pointer, k));
  return {numbers[0].get<double>(), numbers[1].get<double>()};
}

const json& member(const json& object, const char* name, const std::string& pointer) {
  const auto found = object.find(name);
  if (found == object.end())
    refuse(std::string("GeoJSON has \"") + name + "\" here; it is missing", pointer + "/" + name);
  return *found;
}

PolygonText read_geometry(const json& value, const std::string& pointer) {
  if (!value.is_object()) refuse("expected a GeoJSON geometry, found " + describe(value), pointer);
  const json& type = member(value, "type", pointer);
  if (type == "Feature" || type == "FeatureCollection")
    refuse("a " + type.get<std::string>() + " is no geometry; leave out the Feature around it",
           pointer + "/type");
  return read_geojson(value, pointer);
}

PolygonText read_multipolygon(const json& value, const std::string& pointer) {
  const auto& polygons = array_of(value, "an array of polygons", pointer);
  if (polygons.size() != 1)
    refuse("the MultiPolygon has " + std::to_string(polygons.size()) +
               " polygons; a domain is one: make a request for each",
           pointer);
  return read_rings(polygons[0], entry(pointer, 0));
}

/// "ring 1, vertex 4: " of "/rings/1/4".
std::string in_words(std::string_view where) {
  constexpr std::string_view prefix = "/rings/";
  if (!where.starts_with(prefix)) return "";
  const std::string_view numbers = where.substr(prefix.size());
  const std::size_t slash = numbers.find('/');
  std::string words = "ring " + std::string(numbers.substr(0, slash));
  if (slash != std::string_view::npos) words += ", vertex " + std::string(numbers.substr(slash + 1));
  return words + ": ";
}

PolygonText read_source(const json& value, const std::string& pointer) {
  Fields fields(value, pointer);
  const std::string type = fields.text("type").value_or("polygon");
  if (type != "polygon") return read_geojson(value, pointer);
  const json *rings = fields.find("rings"), *geojson = fields.find("geojson");
  const std::optional<std::string> wkt = fields.text("wkt");
  fields.refuse_unknown();
  const int given = (rings != nullptr ? 1 : 0) + (geojson != nullptr ? 1 : 0) + (wkt ? 1 : 0);
  if (given != 1)
    refuse(std::string(given == 0 ? "a polygon needs" : "a polygon takes only") +
               " one of rings, geojson and wkt",
           pointer);
  if (rings != nullptr) return read_rings(*rings, fields.pointer_to("rings"));
  if (geojson != nullptr) return read_geojson(*geojson, fields.pointer_to("geojson"));
  return read_wkt(*wkt, fields.pointer_to("wkt"));
}

}  // namespace

Error PolygonText::located(const Error& error) const {
  constexpr std::string_view prefix = "/rings";
  if (is_text) return {error.code(), in_words(error.where()) + error.what(), pointer};
  const std::string& where = error.where();
  return {error.code(), error.what(),
          pointer + (where.starts_with(prefix) ? where.substr(prefix.size()) : where)};
}

PolygonText read_rings(const json& value, const std::string& pointer) {
  PolygonText text{{}, pointer, false};
  const auto& rings = array_of(value, "an array of rings, the outer one first", pointer);
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const auto& vertices = array_of(rings[k], "a ring, an array of vertices [x, y]", entry(pointer, k));
    text.rings.emplace_back();
    text.rings.back().reserve(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
      text.rings.back().push_back(read_vertex(vertices[i], entry(entry(pointer, k), i)));
  }
  return text;
}

bool is_geojson_type(std::string_view type) {
  for (const char* known : {"Point", "MultiPoint", "LineString", "MultiLineString", "Polygon", "MultiPolygon",
                            "GeometryCollection", "Feature", "FeatureCollection"})
    if (type == known) return true;
  return false;
}

PolygonText read_geojson(const json& value, const std::string& pointer) {
  if (!value.is_object()) refuse("expected a GeoJSON object, found " + describe(value), pointer);
  const json& type = member(value, "type", pointer);
  if (type == "Polygon") return read_rings(member(value, "coordinates", pointer), pointer + "/coordinates");
  if (type == "MultiPolygon")
    return read_multipolygon(member(value, "coordinates", pointer), pointer + "/coordinates");
  if (type == "Feature") return read_geometry(member(value, "geometry", pointer), pointer + "/geometry");
  if (type != "FeatureCollection")
    refuse(type.is_string() && is_geojson_type(type.get_ref<const std::string&>())
               ? "a " + type.get<std::string>() +
                     " is no polygon; there are Polygon, MultiPolygon, Feature and "
                     "FeatureCollection of one polygon"
               : "expected one of GeoJSON's types: Polygon, MultiPolygon, Feature, FeatureCollection",
           pointer + "/type");
  const auto& features =
      array_of(member(value, "features", pointer), "an array of features", pointer + "/features");
  if (features.size() != 1)
    refuse("the FeatureCollection has " + std::to_string(features.size()) +
               " features; a domain is one: make a request for each",
           pointer + "/features");
  if (!features[0].is_object() || features[0].value("type", json()) != "Feature")
    refuse("expected a GeoJSON Feature", pointer + "/features/0");
  return read_geojson(features[0], pointer + "/features/0");
}

PolygonText read_polygon_text(const json& value, const std::string& pointer) {
  return read_source(value, pointer);
}

std::shared_ptr<const Polygon> read_polygon(const json& value, const std::string& pointer) {
  const PolygonText text = read_polygon_text(value, pointer);
  try {
    return std::make_shared<const Polygon>(text.rings);
  } catch (const Error& error) {
    throw text.located(error);
  }
}

nlohmann::ordered_json polygon_to_json(const Polygon& polygon) {
  nlohmann::ordered_json rings = nlohmann::ordered_json::array();
  for (const auto& ring : polygon.rings()) {
    nlohmann::ordered_json vertices = nlohmann::ordered_json::array();
    for (const Vec2 p : ring) vertices.push_back({p.x, p.y});
    rings.push_back(std::move(vertices));
  }
  return {{"type", "polygon"}, {"rings", std::move(rings)}};
}

}  // namespace wellspaced

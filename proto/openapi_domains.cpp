#include "proto/openapi_domains.h"

#include "core/domain/sphere.h"
#include "core/domain/torus.h"
#include "proto/schema_parts.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

/// A rectangle that repeats along both axes unless told otherwise, or along none.
ordered_json rectangle_schema(const char* type, bool repeats, const char* description) {
  ordered_json side = {
      {"type", "number"}, {"minimum", Torus::min_side}, {"maximum", Torus::max_side}, {"default", 1}};
  ordered_json periodic = {{"type", "array"},
                           {"description", "whether it repeats along x, and along y"},
                           {"items", {{"type", "boolean"}}},
                           {"minItems", 2},
                           {"maxItems", 2},
                           {"default", {repeats, repeats}}};
  ordered_json named = {{"type", "string"}, {"enum", {type}}};
  if (repeats) named["default"] = type;
  ordered_json schema =
      closed(object({{"type", named}, {"width", side}, {"height", side}, {"periodic", std::move(periodic)}},
                    repeats ? ordered_json::array() : ordered_json{"type"}));
  schema["title"] = type;
  schema["description"] = description;
  return schema;
}

ordered_json sphere_schema() {
  ordered_json schema = closed(object({{"type", {{"type", "string"}, {"enum", {"sphere"}}}},
                                       {"radius",
                                        {{"type", "number"},
                                         {"minimum", Sphere::min_radius},
                                         {"maximum", Sphere::max_radius},
                                         {"default", 1}}}},
                                      {"type"}));
  schema["title"] = "sphere";
  schema["description"] =
      "The sphere of that radius around the origin: points are [x, y, z] on it, distances go along it.";
  return schema;
}

ordered_json polygon_schema() {
  const ordered_json corner = {
      {"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
  const ordered_json ring = {{"type", "array"}, {"items", corner}, {"minItems", 3}};
  ordered_json rings = {
      {"type", "array"},
      {"description", "the outer ring, then the holes; either way around, the first corner may be repeated"},
      {"items", ring},
      {"minItems", 1}};
  ordered_json properties = {{"type", {{"type", "string"}, {"enum", {"polygon"}}}},
                             {"rings", std::move(rings)},
                             {"geojson", typed("object", "a Polygon, read as planar")},
                             {"wkt", typed("string", "POLYGON ((x y, ...), ...)")}};
  ordered_json schema = closed(object(std::move(properties), {"type"}));
  schema["oneOf"] = ordered_json::array();
  for (const char* source : {"rings", "geojson", "wkt"}) schema["oneOf"].push_back({{"required", {source}}});
  schema["title"] = "polygon";
  schema["description"] =
      "A polygon with holes, not necessarily convex. Its corners are points of every set made on it; other "
      "points of its boundary stay on their edge.";
  return schema;
}

ordered_json mesh_schema() {
  const auto rows = [](ordered_json entry, const char* description) {
    entry = {{"type", "array"}, {"items", std::move(entry)}, {"minItems", 3}, {"maxItems", 3}};
    return ordered_json{
        {"type", "array"}, {"description", description}, {"items", std::move(entry)}, {"minItems", 1}};
  };
  ordered_json properties = {
      {"type", {{"type", "string"}, {"enum", {"mesh"}}}},
      {"vertices", rows({{"type", "number"}}, "[[x, y, z], ...]")},
      {"faces", rows({{"type", "integer"}, {"minimum", 0}},
                     "[[i, j, k], ...], indices of vertices, counted from 0; all the same way around")},
      {"allow_self_intersections",
       {{"type", "boolean"},
        {"description", "faces may cross: distances go as if the sheets did not meet"},
        {"default", false}}}};
  ordered_json schema = closed(object(std::move(properties), {"type", "vertices", "faces"}));
  schema["title"] = "mesh";
  schema["description"] =
      "The surface of a triangle mesh, closed or with border: points are [x, y, z] on it, distances go along "
      "it.";
  return schema;
}

ordered_json uploaded_schema() {
  ordered_json schema = closed(object({{"type", {{"type", "string"}, {"enum", {"polygon", "mesh"}}}},
                                       {"id", {{"type", "string"}, {"pattern", "^[0-9a-f]{64}$"}}}},
                                      {"type", "id"}));
  schema["title"] = "uploaded";
  schema["description"] = "A domain that POST /v1/domains keeps.";
  return schema;
}

ordered_json geojson_schema() {
  const ordered_json types = {"Polygon", "MultiPolygon", "Feature", "FeatureCollection"};
  ordered_json schema = object({{"type", {{"type", "string"}, {"enum", types}}}}, {"type"});
  schema["title"] = "GeoJSON";
  schema["description"] =
      "A GeoJSON object that is or holds one polygon, read as planar; as if it were given as a polygon.";
  return schema;
}

}  // namespace

ordered_json domain_schema() {
  return {
      {"description", "Where points live; the unit torus where none is given."},
      {"oneOf",
       {rectangle_schema("torus", true,
                         "The flat torus [0, width) x [0, height), half-open; the longer side at most 1000 "
                         "times the shorter one."),
        rectangle_schema("box", false,
                         "The same rectangle bounded along one axis or both, and closed there; points with "
                         "a coordinate that is exactly 0 or the side are on the boundary, and stay there."),
        sphere_schema(), polygon_schema(), mesh_schema(), uploaded_schema(), geojson_schema()}}};
}

ordered_json uploaded_domain_schema() {
  const ordered_json text = {{"type", "string"}}, number = {{"type", "number"}},
                     count = {{"type", "integer"}}, corner = {{"type", "array"}, {"items", number}};
  return object({{"id", text},
                 {"format", text},
                 {"bytes", count},
                 {"created", text},
                 {"expires", text},
                 {"allow_self_intersections", {{"type", "boolean"}}},
                 {"type", {{"type", "string"}, {"enum", {"polygon", "mesh"}}}},
                 {"area", number},
                 {"boundary_length", number},
                 {"vertices", count},
                 {"unused_vertices", count},
                 {"edges", count},
                 {"faces", count},
                 {"holes", count},
                 {"components", count},
                 {"boundaries", count},
                 {"euler_characteristic", count},
                 {"genus", count},
                 {"closed", {{"type", "boolean"}}},
                 {"volume", {{"type", {"number", "null"}}}},
                 {"box", object({{"min", corner}, {"max", corner}}, {"min", "max"})},
                 {"smallest_feature",
                  {{"type", {"object", "null"}},
                   {"description", "how fine the finest detail is, and where; an estimate on meshes"},
                   {"properties", {{"length", number}, {"description", text}}}}}},
                {"id", "format", "bytes", "created", "expires", "type", "area"});
}

}  // namespace wellspaced

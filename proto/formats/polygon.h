#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/domain/polygon.h"
#include "core/error.h"

namespace wellspaced {

/// The rings of a polygon as a request brings them, before the domain has looked at them.
struct PolygonText {
  std::vector<std::vector<Vec2>> rings;
  std::string pointer;   ///< where the rings stand: "/domain/coordinates"; for a text, where that does
  bool is_text = false;  ///< there are no pointers to its rings

  /// An error of the domain's at "/rings/k/i", as one at the place that the rings came from. Of a text, the
  /// message says the ring and the vertex instead.
  Error located(const Error& error) const;
};

/// [[[x, y], ...], ...], as GeoJSON's coordinates are.
/// Errors: invalid_parameters at the first value that is not what it should be; a third coordinate, too.
PolygonText read_rings(const nlohmann::json& value, const std::string& pointer);

/// This is a "type" of GeoJSON's, of any kind of object.
bool is_geojson_type(std::string_view type);

/// A GeoJSON object with exactly one polygon: Polygon, MultiPolygon, Feature or FeatureCollection.
/// Coordinates are taken as planar; members that it doesn't need are ignored, as the format wants. Errors:
/// invalid_parameters at the place; several polygons, too. Reference: RFC 7946.
PolygonText read_geojson(const nlohmann::json& value, const std::string& pointer);

/// "POLYGON ((x y, ...), (...))", or a MULTIPOLYGON of one, in any case.
/// Errors: invalid_parameters at `pointer`, with the character (from 1), ring and vertex (from 0); Z and M,
/// too.
PolygonText read_wkt(std::string_view text, const std::string& pointer);

/// {"type": "polygon"} with one of rings, geojson and wkt, or a GeoJSON object: its rings, unchecked.
PolygonText read_polygon_text(const nlohmann::json& value, const std::string& pointer);

/// {"type": "polygon"} with one of rings, geojson and wkt; or a GeoJSON object.
/// Errors: those of the readers and of Polygon, each at its place.
std::shared_ptr<const Polygon> read_polygon(const nlohmann::json& value, const std::string& pointer);

/// {"type": "polygon", "rings": [...]}: reads back as the same bits.
nlohmann::ordered_json polygon_to_json(const Polygon& polygon);

}  // namespace wellspaced

#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/control.h"
#include "core/registry.h"
#include "core/render/pictures/pictures.h"
#include "proto/formats/media.h"
#include "proto/limits.h"
#include "proto/request.h"
#include "proto/result.h"

namespace wellspaced {

/// Of a PNG, in pixels for each of the drawing's.
inline constexpr double least_scale = 0.25, most_scale = 4;

/// A picture that is asked for: "voronoi", or {"name": "voronoi", "color": "valence", "scale": 2}.
struct PictureCall {
  const Picture* picture = nullptr;
  Arguments arguments;
  double scale = 1;             ///< pixels of a PNG for each of the drawing's
  Format format = Format::svg;  ///< that it is drawn for; not part of what is read
};

/// Null and "" stand for the first of all pictures. Errors: invalid_parameters with the field's pointer.
PictureCall read_picture(const nlohmann::json& value, const std::string& where);

/// The picture of a request or result with what a query says of it: another picture, or only some parameters.
nlohmann::json merged_picture(const nlohmann::json& own, const nlohmann::json& query);
/// Before the work. Errors at /picture: invalid_parameters if what is asked for won't have what the picture
/// shows; too_large for more points, time or memory than the limits, or a PNG of too many pixels, at the
/// parameter that is to blame.
void require_drawable(const Request& request, const PictureCall& call, const Limits& limits);

/// Draws a result. Errors: those of require_drawable and of the picture.
Drawing draw_result(const Result& result, const PictureCall& call, const Limits& limits,
                    const Control& control);

/// JSON Schema of a picture in a request.
nlohmann::ordered_json picture_schema();

}  // namespace wellspaced

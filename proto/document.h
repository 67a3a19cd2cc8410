#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "proto/json_reader.h"
#include "proto/limits.h"

namespace wellspaced {

/// Decoded names and values, in their order.
using Query = std::vector<std::pair<std::string, std::string>>;

/// A request as it comes: body, its media type, and the decoded query.
struct RawRequest {
  std::string_view operation;     ///< one of operation_names
  std::string_view content_type;  ///< media type, parameters allowed: "application/json; charset=utf-8"
  std::string_view body;
  Query query;                       ///< without format, and without what it says of a picture
  nlohmann::json picture = nullptr;  ///< what the query says of it, as picture_of_query gives it
};

/// Tells apart what the query says of the work and of a picture. Errors: those of picture_of_query.
RawRequest raw_request(std::string_view operation, std::string_view content_type, std::string_view body,
                       const Query& query);

/// picture=voronoi and picture.color=valence of a query, as in a JSON body; null if there is none of them.
/// Errors: invalid_parameters for one that is given twice.
nlohmann::json picture_of_query(const Query& query);
bool is_picture_parameter(std::string_view name);

/// A request after its bytes are understood, as one JSON object: parameters of a query are where a JSON body
/// would have them ("domain.width" is width in domain, "spectrum.range" the range of the measure spectrum).
/// Lists of points are apart, in `tables`; those of a body that isn't JSON at /points.
///
/// Errors: unsupported_media_type; malformed_request; invalid_parameters and too_large with the pointer of
/// the field.
JsonDocument read_document(const RawRequest& raw, const Limits& limits);

/// How many points that operation may look at.
std::uint64_t point_limit(std::string_view operation, const Limits& limits);

}  // namespace wellspaced

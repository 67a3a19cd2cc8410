#pragma once

#include <string>
#include <utility>

#include <nlohmann/json.hpp>

/// What JSON Schemas of the OpenAPI document are put together from.
namespace wellspaced {

inline nlohmann::ordered_json typed(const char* type, const std::string& description) {
  return {{"type", type}, {"description", description}};
}

inline nlohmann::ordered_json object(nlohmann::ordered_json properties,
                                     nlohmann::ordered_json required = nlohmann::ordered_json::array()) {
  nlohmann::ordered_json out = {{"type", "object"}, {"properties", std::move(properties)}};
  if (!required.empty()) out["required"] = std::move(required);
  return out;
}

/// Takes no fields but its own.
inline nlohmann::ordered_json closed(nlohmann::ordered_json schema) {
  schema["additionalProperties"] = false;
  return schema;
}

}  // namespace wellspaced

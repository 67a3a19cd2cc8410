#pragma once

#include <nlohmann/json.hpp>

namespace wellspaced {

/// components/schemas of the OpenAPI document.
nlohmann::ordered_json openapi_schemas();

/// {"$ref": "#/components/schemas/<name>"}
nlohmann::ordered_json schema_reference(const std::string& name);

/// The one field of optimize that no method brings.
nlohmann::ordered_json enrich_schema();

}  // namespace wellspaced

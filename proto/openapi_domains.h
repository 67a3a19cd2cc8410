#pragma once

#include <nlohmann/json.hpp>

namespace wellspaced {

/// Schema of the field "domain": every way to name one.
nlohmann::ordered_json domain_schema();

/// Schema of what is told of a domain that was uploaded.
nlohmann::ordered_json uploaded_domain_schema();

}  // namespace wellspaced

#pragma once

#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "core/domain/sizing.h"

namespace wellspaced {

/// A sizing function, and how it was asked for.
struct SizingChoice {
  nlohmann::ordered_json json;  ///< null: none
  std::shared_ptr<const Sizing> sizing;
};

/// {"type": "constant", "radius": 0.1} or {"type": "linear", "axis": "y", "from": 0.02, "to": 0.01}.
/// Errors: invalid_parameters with the field's pointer.
SizingChoice read_sizing(const nlohmann::json& value, const Domain& domain, const std::string& where);

nlohmann::ordered_json sizing_schema();

}  // namespace wellspaced

#pragma once

#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "core/domain/sizing.h"

namespace wellspaced {

/// {"type": "constant", "radius": 0.1}, {"type": "linear", "axis": "y", "from": 0.02, "to": 0.01},
/// {"type": "grid", "radii": [[0.1, 0.2], [0.3, 0.4]]}, {"type": "image", "png": "iVBO...", "black": 0.01,
/// "white": 0.02} or {"type": "vertices", "radii": [0.1, 0.2, ...]}. Requires: the domain outlives it.
/// Errors: invalid_parameters with the field's pointer.
std::shared_ptr<const Sizing> read_sizing(const nlohmann::json& value, const Domain& domain,
                                          const std::string& where);
/// What read_sizing turns into the same function; null for none.
nlohmann::ordered_json sizing_to_json(const Sizing* sizing);
/// What it is, for results: least and most radius, Lipschitz constant, and how many radii instead of these.
nlohmann::ordered_json sizing_in_result(const Sizing& sizing);

nlohmann::ordered_json sizing_schema();

}  // namespace wellspaced

#pragma once

#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "core/domain/sizing.h"

namespace wellspaced {

/// {"type": "constant", "radius": 0.1} or {"type": "linear", "axis": "y", "from": 0.02, "to": 0.01}.
/// Errors: invalid_parameters with the field's pointer.
std::shared_ptr<const Sizing> read_sizing(const nlohmann::json& value, const Domain& domain,
                                          const std::string& where);
/// What read_sizing turns into the same function; null for none.
nlohmann::ordered_json sizing_to_json(const Sizing* sizing);
/// The same with its Lipschitz constant, for results.
nlohmann::ordered_json sizing_in_result(const Sizing& sizing);

nlohmann::ordered_json sizing_schema();

}  // namespace wellspaced

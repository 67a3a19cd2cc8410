#pragma once

#include <array>

#include <nlohmann/json.hpp>

#include "core/registry.h"
#include "proto/limits.h"

namespace wellspaced {

inline constexpr std::array<const char*, 4> operation_names = {"generate", "optimize", "analyze", "mesh"};

/// What /v1/operations tells: every operation with its methods, their parameters as JSON Schema, formats and
/// limits. Made from the same registry that requests are validated by.
nlohmann::ordered_json operations_json(const Limits& limits);

/// JSON Schema of one parameter.
nlohmann::ordered_json parameter_schema(const Parameter& parameter);

}  // namespace wellspaced

#pragma once

#include <nlohmann/json.hpp>

#include "proto/limits.h"

namespace wellspaced {

/// The OpenAPI 3.1 description of the service, made from the registry of methods and measures.
///
/// Guarantees: every route of server/routes.cpp is in it and nothing else (tested), every method with its
/// parameters, every problem type. Determinism: the same bytes for the same limits.
nlohmann::ordered_json openapi_json(const Limits& limits);

}  // namespace wellspaced

#pragma once

#include <optional>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "core/control.h"
#include "core/point_set.h"
#include "core/registry.h"

namespace wellspaced {

struct Certificate;
struct Spacing;

/// One measure of `analyze`. Its object in the result is described by its schema.
struct Measure {
  std::string name, title, description, reference;
  nlohmann::ordered_json (*run)(const PointSet&, const Control&) = nullptr;
  nlohmann::ordered_json (*schema)() = nullptr;  ///< JSON Schema of what `run` returns
  Cost cost_a_point;
};

/// All measures. One row each in measures.cpp.
std::span<const Measure> measures();

nlohmann::ordered_json spacing_to_json(const Spacing& spacing);
nlohmann::ordered_json spacing_schema();

/// Each bound is null where there is no certificate.
nlohmann::ordered_json certificate_to_json(const std::optional<Certificate>& certificate);
nlohmann::ordered_json certificate_schema();

}  // namespace wellspaced

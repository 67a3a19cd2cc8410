#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/control.h"
#include "core/point_set.h"
#include "core/registry_measures.h"

namespace wellspaced {

struct Certificate;
class Sizing;
struct Spacing;

/// What a measure looks at.
struct MeasureInput {
  std::span<const PointSet> sets;  ///< usable, of one size and on one domain; at least one
  const Sizing* sizing = nullptr;  ///< that the sets were made for; may be missing
};

/// One measure of `analyze`. Its object in the result is described by its schema.
struct Measure : Method {
  /// Averages over the sets.
  /// Errors: with the parameter's pointer for a bad one; without a pointer for what the points are to blame.
  nlohmann::ordered_json (*run)(const MeasureInput&, const Arguments&, const Control&) = nullptr;
  nlohmann::ordered_json (*schema)() = nullptr;               ///< JSON Schema of what `run` returns
  Cost (*cost)(const SetsSize&, const Arguments&) = nullptr;  ///< of all sets, but for what is kept:
  /// The bytes of what `run` returns, and of its text; nothing to speak of if there is no function.
  double (*kept_bytes)(const SetsSize&, const Arguments&) = nullptr;
  /// What can be refused of the parameters before the work; same errors as `run`.
  void (*check)(const Domain&, double n, const Arguments&) = nullptr;
  bool needs_torus = false;  ///< it means nothing on another domain
};

/// All measures. One row each in measures.cpp.
std::span<const Measure> measures();
/// Nothing if there is none of that name.
const Measure* find_measure(std::string_view name);

/// Errors: invalid_parameters at `where` if the measure means nothing on that domain, saying what to ask for
/// instead.
void require_meaning(const Measure& measure, const Domain& domain, const std::string& where);

/// Averages are over sets of one domain and size. Errors: invalid_parameters at `where`.
void require_same_domain(const Domain& first, const Domain& other, const std::string& where);
void require_same_size(double first, double other, const std::string& where);

nlohmann::ordered_json spacing_to_json(const Spacing& spacing);
nlohmann::ordered_json spacing_schema();

/// Each bound is null where there is no certificate.
nlohmann::ordered_json certificate_to_json(const std::optional<Certificate>& certificate);
nlohmann::ordered_json certificate_schema();

}  // namespace wellspaced

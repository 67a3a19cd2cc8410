#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace wellspaced {

/// A number of a measure's object: where it comes from and what it means.
template <class Of>
struct NumberField {
  const char* name;
  double Of::*value;
  const char* description;
};

/// The object with the mean of each number over all sets.
template <class Of>
nlohmann::ordered_json means_to_json(std::span<const NumberField<Of>> fields, std::span<const Of> sets) {
  nlohmann::ordered_json out;
  for (const NumberField<Of>& field : fields) {
    double sum = 0;
    for (const Of& set : sets) sum += set.*field.value;
    out[field.name] = sum / static_cast<double>(sets.size());
  }
  return out;
}

/// {"type": "object", ...} with the numbers as required properties. `type` may be {"number", "null"}.
template <class Of>
nlohmann::ordered_json numbers_schema(std::span<const NumberField<Of>> fields,
                                      const nlohmann::ordered_json& type = "number") {
  nlohmann::ordered_json properties, required = nlohmann::ordered_json::array();
  for (const NumberField<Of>& field : fields) {
    properties[field.name] = {{"type", type}, {"description", field.description}};
    required.push_back(field.name);
  }
  return {{"type", "object"}, {"required", required}, {"properties", properties}};
}

/// Adds a property that is always there.
inline void add_property(nlohmann::ordered_json& schema, const char* name, nlohmann::ordered_json property) {
  schema["properties"][name] = std::move(property);
  schema["required"].push_back(name);
}

/// A list of numbers; null for NaN and infinity.
inline nlohmann::ordered_json numbers_to_json(std::span<const double> values) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const double value : values)
    out.push_back(std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json());
  return out;
}

/// A list of numbers in which null stands for what is not known.
inline nlohmann::ordered_json numbers_property(const char* description) {
  return {{"type", "array"}, {"description", description}, {"items", {{"type", {"number", "null"}}}}};
}

inline nlohmann::ordered_json number_or_null(const char* description) {
  return {{"type", {"number", "null"}}, {"description", description}};
}

/// Values over all sets of a measure that is made set by set.
template <class Make>
auto of_each(std::size_t sets, const Make& make) {
  std::vector<decltype(make(std::size_t{}))> all;
  all.reserve(sets);
  for (std::size_t s = 0; s < sets; ++s) all.push_back(make(s));
  return all;
}

}  // namespace wellspaced

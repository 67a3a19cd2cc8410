#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace wellspaced {

/// One JSON object of a request: typed access, and no field that nobody asked for.
///
/// Every error is invalid_parameters at the field's pointer (below `pointer`) and says what was found and
/// what is wanted.
class Fields {
 public:
  /// Errors: if `value` is not an object.
  Fields(const nlohmann::json& value, std::string pointer);

  /// The field's value, or nullptr; null counts as not given. Marks the name as known.
  const nlohmann::json* find(const std::string& name);
  const nlohmann::json& require(const std::string& name, std::string_view what);

  std::optional<std::string> text(const std::string& name);
  std::optional<bool> flag(const std::string& name);
  std::optional<double> number(const std::string& name);
  /// A whole number in [0, 2^64); "10.0" and "1e3" are whole, too.
  std::optional<std::uint64_t> whole(const std::string& name);

  /// Call last. Errors: at the first field that was never asked for, naming the known ones.
  void refuse_unknown() const;

  const std::string& pointer() const { return pointer_; }
  std::string pointer_to(const std::string& name) const;

 private:
  const nlohmann::json& object_;
  std::string pointer_;
  std::set<std::string> known_;
};

/// "a string", "the number 1.5", "an array": for error messages; never echoes more than a number.
std::string describe(const nlohmann::json& value);

/// A number for people: 10000, not 10000.0.
std::string number_text(double x);

/// One reference token of a JSON pointer, escaped and cut to a readable length.
std::string pointer_token(std::string_view key);

}  // namespace wellspaced

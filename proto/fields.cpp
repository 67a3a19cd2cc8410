#include "proto/fields.h"

#include <cmath>
#include <utility>

namespace wellspaced {

std::string pointer_token(std::string_view key) {
  std::string token = "/";
  for (const char c : key.substr(0, 100)) {
    if (c == '~')
      token += "~0";
    else if (c == '/')
      token += "~1";
    else
      token += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  if (key.size() > 100) token += "...";
  return token;
}

std::string describe(const nlohmann::json& value) {
  switch (value.type()) {
    case nlohmann::json::value_t::object:
      return "an object";
    case nlohmann::json::value_t::array:
      return "an array";
    case nlohmann::json::value_t::string:
      return "a string";
    case nlohmann::json::value_t::boolean:
      return value.get<bool>() ? "true" : "false";
    case nlohmann::json::value_t::null:
      return "null";
    default:
      return "the number " + number_text(value.get<double>());
  }
}

std::string number_text(double x) {
  constexpr double exact_whole = 0x1p53;
  if (x == std::floor(x) && std::abs(x) <= exact_whole) return std::to_string(static_cast<std::int64_t>(x));
  return nlohmann::json(x).dump();
}

Fields::Fields(const nlohmann::json& value, std::string pointer)
    : object_(value), pointer_(std::move(pointer)) {
  if (!value.is_object())
    throw Error(ErrorCode::invalid_parameters, "expected an object, found " + describe(value), pointer_);
}

std::string Fields::pointer_to(const std::string& name) const { return pointer_ + pointer_token(name); }

const nlohmann::json* Fields::find(const std::string& name) {
  known_.insert(name);
  const auto found = object_.find(name);
  return found == object_.end() || found->is_null() ? nullptr : &*found;
}

const nlohmann::json& Fields::require(const std::string& name, std::string_view what) {
  if (const auto* value = find(name)) return *value;
  throw Error(ErrorCode::invalid_parameters, "the field is missing; give " + std::string(what),
              pointer_to(name));
}

std::optional<std::string> Fields::text(const std::string& name) {
  const auto* value = find(name);
  if (value == nullptr) return {};
  if (value->is_string()) return value->get<std::string>();
  throw Error(ErrorCode::invalid_parameters, "expected a string, found " + describe(*value),
              pointer_to(name));
}

std::optional<bool> Fields::flag(const std::string& name) {
  const auto* value = find(name);
  if (value == nullptr) return {};
  if (value->is_boolean()) return value->get<bool>();
  throw Error(ErrorCode::invalid_parameters, "expected true or false, found " + describe(*value),
              pointer_to(name));
}

std::optional<double> Fields::number(const std::string& name) {
  const auto* value = find(name);
  if (value == nullptr) return {};
  if (value->is_number()) return value->get<double>();
  throw Error(ErrorCode::invalid_parameters, "expected a number, found " + describe(*value),
              pointer_to(name));
}

std::optional<std::uint64_t> Fields::whole(const std::string& name) {
  const auto* value = find(name);
  if (value == nullptr) return {};
  if (value->is_number_unsigned()) return value->get<std::uint64_t>();
  if (value->is_number_integer() && value->get<std::int64_t>() >= 0) return value->get<std::uint64_t>();
  if (value->is_number_float()) {
    const double x = value->get<double>();
    if (x >= 0 && x < 0x1p64 && x == std::floor(x)) return static_cast<std::uint64_t>(x);
  }
  throw Error(ErrorCode::invalid_parameters,
              "expected a whole number from 0 to 2^64 - 1, found " + describe(*value), pointer_to(name));
}

void Fields::refuse_unknown() const {
  for (const auto& [name, value] : object_.items()) {
    if (known_.count(name) != 0) continue;
    std::string list;
    for (const auto& known : known_) list += (list.empty() ? "" : ", ") + known;
    throw Error(ErrorCode::invalid_parameters, "unknown field; known here are: " + list, pointer_to(name));
  }
}

}  // namespace wellspaced

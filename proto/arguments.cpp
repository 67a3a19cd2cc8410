#include "proto/arguments.h"

#include <algorithm>
#include <cmath>

namespace wellspaced {
namespace {

/// Above this a maximum only keeps numbers exact; the operator's limits are what users meet.
constexpr double unbounded = 1e14;

double read_choice(const Parameter& p, const nlohmann::json& value, const std::string& where) {
  const auto found = value.is_string()
                         ? std::find(p.choices.begin(), p.choices.end(), value.get_ref<const std::string&>())
                         : p.choices.end();
  if (found != p.choices.end()) return static_cast<double>(found - p.choices.begin());
  std::string names;
  for (const std::string& choice : p.choices) names += (names.empty() ? "" : ", ") + choice;
  throw Error(ErrorCode::invalid_parameters,
              "must be one of " + names + "; found " + (value.is_string() ? "another word" : describe(value)),
              where);
}

double read_value(const Parameter& p, const nlohmann::json& value, const std::string& where) {
  if (p.type == Parameter::Type::choice) return read_choice(p, value, where);
  const bool whole = p.type == Parameter::Type::integer;
  if (!value.is_number())
    throw Error(ErrorCode::invalid_parameters,
                std::string("expected a ") + (whole ? "whole " : "") + "number, found " + describe(value),
                where);
  const double x = value.get<double>();
  const bool too_low = p.exclusive_minimum ? !(x > p.minimum) : !(x >= p.minimum);
  const bool too_high = p.exclusive_maximum ? !(x < p.maximum) : !(x <= p.maximum);
  const std::string& infeasible = too_low ? p.infeasible_below : p.infeasible_above;
  if ((too_low || too_high) && !infeasible.empty())
    throw Error(ErrorCode::infeasible, infeasible + "; found " + number_text(x), where);
  if (too_low || too_high || (whole && x != std::floor(x)))
    throw Error(ErrorCode::invalid_parameters,
                std::string("must be a ") + (whole ? "whole " : "") + "number " +
                    (too_high && p.maximum > unbounded ? "up to " + number_text(p.maximum) : range_text(p)) +
                    "; found " + number_text(x),
                where);
  return x;
}

void require_one_density(const Method& method, const Arguments& arguments, const Fields& fields) {
  std::string all, first, last_given;
  std::size_t given = 0;
  for (const Parameter& p : method.parameters) {
    if (!p.density) continue;
    if (first.empty()) first = p.name;
    all += (all.empty() ? "" : " or ") + p.name;
    if (arguments.count(p.name) == 0) continue;
    last_given = p.name;
    ++given;
  }
  if (first.empty() || given == 1) return;
  if (given == 0)
    throw Error(ErrorCode::invalid_parameters,
                "give " + all + ": nothing says yet how many points are wanted", fields.pointer_to(first));
  throw Error(ErrorCode::invalid_parameters, "give either " + all + ", not both: each follows from the other",
              fields.pointer_to(last_given));
}

}  // namespace

std::string range_text(const Parameter& p) {
  const std::string low = number_text(p.minimum);
  if (p.maximum > unbounded) return p.exclusive_minimum ? "greater than " + low : "of at least " + low;
  return std::string(p.exclusive_minimum ? "in (" : "in [") + low + ", " + number_text(p.maximum) +
         (p.exclusive_maximum ? ")" : "]");
}

Arguments read_arguments(const Method& method, Fields& fields, bool sized) {
  // A misspelled name is told as such, not as the absence of the right one.
  for (const Parameter& p : method.parameters) fields.find(p.name);
  fields.refuse_unknown();
  Arguments arguments;
  for (const Parameter& p : method.parameters) {
    if (const auto* value = fields.find(p.name))
      arguments[p.name] = read_value(p, *value, fields.pointer_to(p.name));
    else if (p.required)
      throw Error(ErrorCode::invalid_parameters, "the field is missing: " + p.description,
                  fields.pointer_to(p.name));
  }
  if (!sized)
    require_one_density(method, arguments, fields);
  else if (arguments.count("radius") != 0)
    throw Error(ErrorCode::invalid_parameters,
                "the sizing function says the radii; leave radius out, or scale them all by a count",
                fields.pointer_to("radius"));
  return arguments;
}

bool takes_radius(const Method& method) {
  const auto is_radius = [](const Parameter& p) { return p.name == "radius"; };
  return std::any_of(method.parameters.begin(), method.parameters.end(), is_radius);
}

}  // namespace wellspaced

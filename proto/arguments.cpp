#include "proto/arguments.h"

#include <limits>

namespace wellspaced {
namespace {

std::string number_text(double x) {
  return nlohmann::json(x == std::floor(x) && std::abs(x) < 1e15
                            ? nlohmann::json(static_cast<std::int64_t>(x))
                            : nlohmann::json(x))
      .dump();
}

double read_value(const Parameter& p, const nlohmann::json& value, const std::string& where) {
  const bool whole = p.type == Parameter::Type::integer;
  if (!value.is_number())
    throw Error(ErrorCode::invalid_parameters,
                std::string("expected a ") + (whole ? "whole " : "") + "number, found " + describe(value),
                where);
  const double x = value.get<double>();
  const bool too_low = p.exclusive_minimum ? !(x > p.minimum) : !(x >= p.minimum);
  const bool too_high = p.exclusive_maximum ? !(x < p.maximum) : !(x <= p.maximum);
  if (too_low && !p.infeasible_below.empty())
    throw Error(ErrorCode::infeasible, p.infeasible_below + "; found " + value.dump(), where);
  if (too_low || too_high || (whole && x != std::floor(x)))
    throw Error(ErrorCode::invalid_parameters,
                std::string("must be a ") + (whole ? "whole " : "") + "number " + range_text(p) + "; found " +
                    value.dump(),
                where);
  return x;
}

}  // namespace

std::string range_text(const Parameter& p) {
  const std::string low = number_text(p.minimum);
  if (p.maximum > 1e14) return p.exclusive_minimum ? "greater than " + low : "of at least " + low;
  return std::string(p.exclusive_minimum ? "in (" : "in [") + low + ", " + number_text(p.maximum) +
         (p.exclusive_maximum ? ")" : "]");
}

Arguments read_arguments(const Method& method, Fields& fields) {
  Arguments arguments;
  std::string densities, given;
  for (const Parameter& p : method.parameters) {
    if (p.density) densities += (densities.empty() ? "" : " or ") + p.name;
    const auto* value = fields.find(p.name);
    if (value == nullptr) {
      if (p.required)
        throw Error(ErrorCode::invalid_parameters, "the field is missing: " + p.description,
                    fields.pointer_to(p.name));
      continue;
    }
    arguments[p.name] = read_value(p, *value, fields.pointer_to(p.name));
    if (p.density && !given.empty())
      throw Error(ErrorCode::invalid_parameters,
                  "give either " + densities + ", not both: each follows from the other",
                  fields.pointer_to(p.name));
    if (p.density) given = p.name;
  }
  if (!densities.empty() && given.empty())
    throw Error(ErrorCode::invalid_parameters,
                "give " + densities + ": nothing says yet how many points are wanted",
                fields.pointer().empty() ? "/count" : fields.pointer() + "/count");
  return arguments;
}

}  // namespace wellspaced

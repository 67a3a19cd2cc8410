#include "proto/sizing.h"

#include "core/error.h"
#include "proto/fields.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

double radius_field(Fields& fields, const char* name) {
  fields.require(name, "a radius, in lengths of the domain");
  return *fields.number(name);
}

SizingChoice constant(Fields& fields) {
  const double radius = radius_field(fields, "radius");
  fields.refuse_unknown();
  return {{{"type", "constant"}, {"radius", radius}}, std::make_shared<ConstantSizing>(radius)};
}

SizingChoice linear(Fields& fields, const Domain& domain) {
  const std::string axis = fields.text("axis").value_or("x");
  if (axis != "x" && axis != "y")
    throw Error(ErrorCode::invalid_parameters, "must be x or y", fields.pointer_to("axis"));
  const LinearSizingOptions options{axis == "y" ? 1 : 0, radius_field(fields, "from"),
                                    radius_field(fields, "to")};
  fields.refuse_unknown();
  return {{{"type", "linear"}, {"axis", axis}, {"from", options.from}, {"to", options.to}},
          std::make_shared<LinearSizing>(domain, options)};
}

}  // namespace

SizingChoice read_sizing(const json& value, const Domain& domain, const std::string& where) {
  Fields fields(value, where);
  fields.require("type", "constant or linear");
  const std::string type = *fields.text("type");
  try {
    if (type == "constant") return constant(fields);
    if (type == "linear") return linear(fields, domain);
  } catch (const Error& error) {
    if (error.where().starts_with(where)) throw;
    throw error.within(where);
  }
  throw Error(ErrorCode::invalid_parameters, "unknown sizing; there are: constant, linear",
              fields.pointer_to("type"));
}

ordered_json sizing_schema() {
  const ordered_json radius = {{"type", "number"}, {"exclusiveMinimum", 0}};
  const auto variant = [](const char* type, ordered_json properties, ordered_json required) {
    properties["type"] = {{"type", "string"}, {"enum", {type}}};
    required.push_back("type");
    return ordered_json{{"type", "object"},
                        {"properties", std::move(properties)},
                        {"required", std::move(required)},
                        {"additionalProperties", false}};
  };
  ordered_json axis = {{"type", "string"}, {"enum", {"x", "y"}}, {"default", "x"}};
  return {
      {"description",
       "r(x), the radius that the points were made for where they are denser in some places; only its ratios "
       "count. linear: from one side of the domain to the other along an axis."},
      {"oneOf",
       {variant("constant", {{"radius", radius}}, {"radius"}),
        variant("linear", {{"axis", axis}, {"from", radius}, {"to", radius}}, {"from", "to"})}}};
}

}  // namespace wellspaced

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

std::shared_ptr<const Sizing> constant(Fields& fields) {
  const double radius = radius_field(fields, "radius");
  fields.refuse_unknown();
  return std::make_shared<ConstantSizing>(radius);
}

constexpr const char* axes[] = {"x", "y", "z"};

int axis_field(Fields& fields, const Domain& domain) {
  const std::string name = fields.text("axis").value_or("x");
  for (int axis = 0; axis < domain.dimension(); ++axis)
    if (name == axes[axis]) return axis;
  throw Error(ErrorCode::invalid_parameters, domain.dimension() == 3 ? "must be x, y or z" : "must be x or y",
              fields.pointer_to("axis"));
}

std::shared_ptr<const Sizing> linear(Fields& fields, const Domain& domain) {
  const LinearSizingOptions options{axis_field(fields, domain), radius_field(fields, "from"),
                                    radius_field(fields, "to")};
  fields.refuse_unknown();
  return std::make_shared<LinearSizing>(domain, options);
}

}  // namespace

std::shared_ptr<const Sizing> read_sizing(const json& value, const Domain& domain, const std::string& where) {
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

ordered_json sizing_to_json(const Sizing* sizing) {
  if (sizing == nullptr) return nullptr;
  if (const auto* linear = dynamic_cast<const LinearSizing*>(sizing)) {
    const LinearSizingOptions& o = linear->options();
    return {{"type", "linear"}, {"axis", axes[o.axis]}, {"from", o.from}, {"to", o.to}};
  }
  return {{"type", sizing->type()}, {"radius", sizing->least()}};
}

ordered_json sizing_in_result(const Sizing& sizing) {
  ordered_json json = sizing_to_json(&sizing);
  json["lipschitz"] = sizing.lipschitz();
  return json;
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
  ordered_json axis = {{"type", "string"}, {"enum", {"x", "y", "z"}}, {"default", "x"}};
  return {{"description",
           "r(x), the radius that is wanted, or that the points were made for, where they are denser in some "
           "places: "
           "lengths are in units of it. linear: from one side of the domain's box to the other along an "
           "axis, z on a "
           "sphere only."},
          {"oneOf",
           {variant("constant", {{"radius", radius}}, {"radius"}),
            variant("linear", {{"axis", axis}, {"from", radius}, {"to", radius}}, {"from", "to"})}}};
}

}  // namespace wellspaced

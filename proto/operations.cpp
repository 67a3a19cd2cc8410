#include "proto/operations.h"

#include "core/render/pictures/pictures.h"
#include "proto/measures/measures.h"
#include "proto/result.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

ordered_json formats_json(std::string_view operation) {
  ordered_json out = ordered_json::array();
  for (const Format format : formats_of(operation))
    out.push_back({{"name", name_of(format)}, {"media_type", media_type_of(format)}});
  return out;
}

ordered_json method_json(const Method& method) {
  ordered_json properties = ordered_json::object();
  for (const Parameter& p : method.parameters) properties[p.name] = parameter_schema(p);
  ordered_json out = {{"name", method.name}, {"title", method.title}, {"description", method.description}};
  if (!method.reference.empty()) out["reference"] = method.reference;
  out["parameters"] = std::move(properties);
  return out;
}

template <class Row>
ordered_json methods_json(std::span<const Row> rows) {
  ordered_json out = ordered_json::array();
  for (const Row& row : rows) out.push_back(method_json(row));
  return out;
}

ordered_json measures_json() {
  ordered_json out = ordered_json::array();
  for (const Measure& m : measures()) {
    ordered_json row = method_json(m);
    row["result"] = m.schema();
    out.push_back(std::move(row));
  }
  return out;
}

}  // namespace

ordered_json parameter_schema(const Parameter& p) {
  if (p.type == Parameter::Type::choice)
    return {{"type", "string"},
            {"description", p.description},
            {"enum", p.choices},
            {"default", ordered_json::parse(p.fallback)}};
  ordered_json schema = {{"type", p.type == Parameter::Type::integer ? "integer" : "number"}};
  std::string description = p.description;
  if (!p.unit.empty()) description += " (" + p.unit + ")";
  const ordered_json fallback =
      p.fallback.empty() ? ordered_json() : ordered_json::parse(p.fallback, nullptr, false);
  if (!p.fallback.empty() && !fallback.is_number()) description += "; default: " + p.fallback;
  schema["description"] = description;
  const auto bound = [&](double x) {
    return p.type == Parameter::Type::integer ? ordered_json(static_cast<std::int64_t>(x)) : ordered_json(x);
  };
  schema[p.exclusive_minimum ? "exclusiveMinimum" : "minimum"] = bound(p.minimum);
  if (p.maximum < 1e14) schema[p.exclusive_maximum ? "exclusiveMaximum" : "maximum"] = bound(p.maximum);
  if (fallback.is_number()) schema["default"] = fallback;
  return schema;
}

ordered_json operations_json(const Limits& limits) {
  ordered_json out = {{"version", version()}, {"operations", ordered_json::array()}};
  const auto add = [&](const char* name, const char* description, const char* kind, ordered_json methods,
                       std::uint64_t points) {
    out["operations"].push_back({{"name", name},
                                 {"description", description},
                                 {kind, std::move(methods)},
                                 {"formats", formats_json(name)},
                                 {"limits", {{"points", points}}}});
  };
  add("generate", "Makes a point set on a domain.", "methods", methods_json(generators()),
      limits.generate_points);
  add("optimize", "Moves the points of a set until it is as well spaced as asked for.", "methods",
      methods_json(optimizers()), limits.optimize_points);
  add("analyze", "Measures a point set.", "measures", measures_json(), limits.analyze_points);
  add("mesh", "Makes triangles or cells of a point set.", "methods", methods_json(meshers()),
      limits.mesh_points);
  out["pictures"] = methods_json(pictures());
  out["limits"] = {{"body_bytes", limits.body_bytes},
                   {"picture_points", limits.picture_points},
                   {"picture_seconds", limits.picture_seconds},
                   {"sync_seconds", limits.sync_seconds},
                   {"memory_bytes", limits.memory_bytes}};
  return out;
}

}  // namespace wellspaced

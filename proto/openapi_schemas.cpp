#include "proto/openapi_schemas.h"

#include "core/registry.h"
#include "proto/arguments.h"
#include "proto/measures/measures.h"
#include "proto/mesh_result.h"
#include "proto/openapi_domains.h"
#include "proto/operations.h"
#include "proto/picture.h"
#include "proto/result.h"
#include "proto/schema_parts.h"
#include "proto/sizing.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

/// poisson-disk -> PoissonDisk
std::string camel(const std::string& name) {
  std::string out;
  bool up = true;
  for (const char c : name) {
    if (c == '-') {
      up = true;
      continue;
    }
    out += up ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    up = false;
  }
  return out;
}

ordered_json points_schema() {
  return {
      {"type", "array"},
      {"description",
       "[[x, y], ...]; on a sphere or mesh [[x, y, z], ...]; no two nearer to each other than 1e-10 of the "
       "longest side "
       "of the domain's box"},
      {"items", {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 3}}}};
}

/// The fields of a method: its own parameters and the ones that all requests of its operation have.
ordered_json method_schema(const Method& method, const std::string& fallback_method, ordered_json common) {
  ordered_json properties = {{"method", {{"type", "string"}, {"enum", {method.name}}}}};
  const bool named = method.name != fallback_method;
  if (!named) properties["method"]["default"] = method.name;
  ordered_json required = ordered_json::array(), densities = ordered_json::array();
  if (named) required.push_back("method");
  if (common.contains("points")) required.push_back("points");
  for (const Parameter& p : method.parameters) {
    properties[p.name] = parameter_schema(p);
    if (p.required) required.push_back(p.name);
    if (p.density) densities.push_back({{"required", {p.name}}});
  }
  for (auto& [name, schema] : common.items()) properties[name] = schema;
  if (!densities.empty() && common.contains("sizing")) {
    const ordered_json either = densities;
    densities.push_back({{"required", {"sizing"}}, {"not", {{"anyOf", either}}}});
  }
  ordered_json schema = closed(object(std::move(properties), std::move(required)));
  schema["title"] = method.title;
  schema["description"] = method.description;
  if (!densities.empty()) schema["oneOf"] = std::move(densities);
  return schema;
}

/// Without what the method doesn't take.
ordered_json common_of(const Generator& row, ordered_json common) {
  if (!row.takes_sizing) common.erase("sizing");
  if (!takes_radius(row)) common.erase("allow_small_features");
  return common;
}

ordered_json common_of(const Optimizer&, const ordered_json& common) { return common; }

/// One schema a method and their union.
template <class Row>
void add_methods(ordered_json& schemas, const std::string& prefix, std::span<const Row> rows,
                 const ordered_json& common) {
  ordered_json choices = ordered_json::array();
  for (const Row& row : rows) {
    schemas[prefix + camel(row.name)] = method_schema(row, rows.front().name, common_of(row, common));
    choices.push_back(schema_reference(prefix + camel(row.name)));
  }
  schemas[prefix] = {{"oneOf", choices}};
}

ordered_json barycentric_schema() {
  return {{"type", "boolean"},
          {"default", false},
          {"description", "on a mesh: the JSON result tells the face of each point, and where in it"}};
}

ordered_json source_schema() {
  const auto only = [](const char* name, ordered_json schema) {
    return closed(object({{name, std::move(schema)}}, {name}));
  };
  ordered_json inline_set = closed(object({{"points", schema_reference("Points")},
                                           {"domain", schema_reference("Domain")},
                                           {"sizing", schema_reference("Sizing")}},
                                          {"points"}));
  return {{"description", "Points in place, generated or optimized here, or of an earlier job."},
          {"oneOf",
           {schema_reference("Points"), inline_set, only("generate", schema_reference("PointsToGenerate")),
            only("optimize", schema_reference("PointsToOptimize")),
            only("job", typed("string", "id of a job"))}}};
}

ordered_json common_result() {
  return {{"n", typed("integer", "number of points")},
          {"version", typed("string", "of the service that computed this")},
          {"domain", schema_reference("Domain")},
          {"sizing", typed("object", "the sizing function, where there is one, with its Lipschitz constant")},
          {"seed", typed("integer", "of the generator, where there was one")}};
}

void add_results(ordered_json& schemas) {
  ordered_json generate = common_result();
  generate["method"] = typed("string", "that was used");
  generate["parameters"] = {{"type", "object"}};
  generate["points"] = schema_reference("Points");
  generate["face"] = {{"type", "array"},
                      {"description", "with barycentric: the face of the mesh that each point is in, from 0"},
                      {"items", {{"type", "integer"}}}};
  generate["barycentric"] = {
      {"type", "array"},
      {"description", "with barycentric: of each point the weights of its face's corners"},
      {"items", {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}}}};
  ordered_json optimize = generate;
  for (const char* name : {"beta", "r_f", "r_f_free", "r_c", "rho", "beta_i_max", "beta_i_mean"})
    optimize[name] = spacing_schema()["properties"][name];
  const ordered_json proven = certificate_schema();
  for (const auto& [name, schema] : proven["properties"].items()) optimize[name] = schema;
  optimize["sweeps"] = typed("integer", "done in all; the best state may be an earlier one");
  optimize["enriched"] =
      typed("integer", "points inserted at the end of the input, where that was asked for");
  optimize["converged"] = {
      {"type", {"boolean", "null"}},
      {"description",
       "whether the target is reached, for beta: whether beta_upper is at most the target; null for methods "
       "without one"}};
  optimize["history"] = {
      {"type", "array"},
      {"description",
       "[sweep, beta, r_c, r_f], from the input (sweep 0; with its holes filled if `enrich` is set) on"},
      {"items", {{"type", "array"}, {"items", {{"type", "number"}}}}}};
  schemas["GenerateResult"] = object(generate, {"n", "method", "parameters", "version", "domain", "points"});
  schemas["OptimizeResult"] =
      object(optimize, {"n", "method", "parameters", "beta", "r_f", "r_c", "rho", "beta_upper", "r_f_lower",
                        "r_c_upper", "sweeps", "converged", "history", "version", "domain", "points"});
}

/// Of one set or the average over several; `version` is said once for all that is compared.
ordered_json group_result() {
  ordered_json group = common_result();
  group["sets"] = typed("integer", "number of point sets, where they are several");
  group["seed"] = typed("integer", "of the first set, where they were generated");
  group["optimized"] = {{"type", "array"},
                        {"description", "what the optimizer said of each set that came out of one"},
                        {"items", {{"type", "object"}}}};
  for (const Measure& measure : measures()) group[measure.name] = measure.schema();
  return group;
}

void add_analysis(ordered_json& schemas) {
  ordered_json compared = group_result();
  compared["label"] = typed("string", "as asked for");
  compared.erase("version");
  schemas["ComparedResult"] = object(compared, {"label", "n", "domain"});
  ordered_json result = group_result();
  result["compare"] = {{"type", "array"},
                       {"description",
                        "what was compared, in the order of the request; then nothing else is here "
                        "but version"},
                       {"items", schema_reference("ComparedResult")}};
  schemas["AnalyzeResult"] = object(result, {"version"});
}

/// "spacing" or {"measure": "spectrum", "range": 2.5}
ordered_json measures_schema() {
  ordered_json names = ordered_json::array(), choices = ordered_json::array();
  for (const Measure& m : measures()) names.push_back(m.name);
  choices.push_back({{"type", "string"}, {"enum", names}});
  for (const Measure& m : measures()) {
    ordered_json properties = {{"measure", {{"type", "string"}, {"enum", {m.name}}}}};
    for (const Parameter& p : m.parameters) properties[p.name] = parameter_schema(p);
    choices.push_back(closed(object(std::move(properties), {"measure"})));
    choices.back()["title"] = m.title;
    choices.back()["description"] = m.description;
  }
  return {{"type", "array"},
          {"description", "each a name, or an object with its parameters"},
          {"items", {{"oneOf", choices}}},
          {"minItems", 1},
          {"default", {measures().front().name}}};
}

/// The fields that say which sets are averaged over.
ordered_json group_schema() {
  return {{"points", schema_reference("PointSource")},
          {"seeds",
           {{"type", "integer"},
            {"minimum", 1},
            {"maximum", 1000},
            {"default", 1},
            {"description", "as many sets, of the seed of points and the ones after it"}}},
          {"sets",
           {{"type", "array"},
            {"description", "instead of points: sets of one size and domain to average over"},
            {"items", schema_reference("PointSource")},
            {"minItems", 1},
            {"maxItems", 1000}}},
          {"domain", schema_reference("Domain")},
          {"sizing", schema_reference("Sizing")}};
}

void add_analyze_request(ordered_json& schemas) {
  ordered_json compared = group_schema();
  compared["label"] = {{"type", "string"}, {"maxLength", 60}, {"description", "for pictures"}};
  schemas["Compared"] = closed(object(compared));
  ordered_json request = group_schema();
  request["compare"] = {
      {"type", "array"},
      {"description", "instead of points or sets: several of them, measured each on its own"},
      {"items", schema_reference("Compared")},
      {"minItems", 1},
      {"maxItems", 16}};
  request["measures"] = measures_schema();
  request["picture"] = schema_reference("Picture");
  schemas["AnalyzeRequest"] = closed(object(request));
  schemas["AnalyzeRequest"]["oneOf"] = {
      {{"required", {"points"}}}, {{"required", {"sets"}}}, {{"required", {"compare"}}}};
}

void add_mesh(ordered_json& schemas) {
  ordered_json names = ordered_json::array();
  for (const Mesher& method : meshers()) names.push_back(method.name);
  schemas["MeshRequest"] =
      closed(object({{"points", schema_reference("PointSource")},
                     {"domain", schema_reference("Domain")},
                     {"method", {{"type", "string"}, {"enum", names}, {"default", names.front()}}}},
                    {"points"}));
  const ordered_json number = {{"type", {"integer", "null"}}};
  ordered_json result = common_result();
  result["method"] = typed("string", "that was used");
  result["quality"] = quality_schema();
  result["optimized"] = typed("object", "what the optimizer said of the points, where they came out of one");
  result["points"] = schema_reference("Points");
  result["vertices"] = {
      {"type", "array"},
      {"description",
       "of a periodic domain unwrapped: what reaches across a seam has vertices of its own there"},
      {"items", {{"type", "array"}, {"items", {{"type", "number"}}}}}};
  result["faces"] = {{"type", "array"},
                     {"description", "the vertices of each, from 0, counter-clockwise"},
                     {"items", {{"type", "array"}, {"items", {{"type", "integer"}}}}}};
  result["vertex_points"] = {
      {"type", "array"},
      {"description",
       "delaunay: the point that each vertex is, or is an image of; null: a corner of the domain"},
      {"items", number}};
  result["face_points"] = {{"type", "array"},
                           {"description", "voronoi: whose cell each face is, or is part of"},
                           {"items", number}};
  schemas["MeshResult"] =
      object(result, {"n", "method", "quality", "version", "domain", "points", "vertices", "faces"});
}

ordered_json job_schema() {
  ordered_json time = {{"type", {"string", "null"}}, {"format", "date-time"}};
  return object(
      {{"id", typed("string", "")},
       {"operation", typed("string", "")},
       {"status",
        {{"type", "string"}, {"enum", {"accepted", "running", "successful", "failed", "dismissed"}}}},
       {"progress", {{"type", "number"}, {"minimum", 0}, {"maximum", 1}}},
       {"message", typed("string", "")},
       {"attempt", typed("integer", "how often a worker has taken it")},
       {"queue", object({{"position", typed("integer", "1 is next")}})},
       {"created", time},
       {"started", time},
       {"updated", time},
       {"finished", time},
       {"expires", time},
       {"links",
        {{"type", "array"},
         {"items", object({{"rel", typed("string", "")}, {"href", typed("string", "")}})}}},
       {"problem", schema_reference("Problem")}},
      {"id", "operation", "status", "progress", "created", "links"});
}

ordered_json problem_schema() {
  ordered_json error = object({{"pointer", typed("string", "JSON pointer of the field")},
                               {"detail", typed("string", "what is wrong with it, and the way out")}},
                              {"pointer", "detail"});
  return object({{"type", typed("string", "/problems/<name>")},
                 {"title", typed("string", "fixed for a type")},
                 {"status", typed("integer", "HTTP status")},
                 {"detail", typed("string", "this occurrence")},
                 {"errors", {{"type", "array"}, {"items", error}}},
                 {"request_id", typed("string", "for the operator's log")}},
                {"type", "title", "status", "detail"});
}

}  // namespace

ordered_json enrich_schema() {
  return {
      {"type", "boolean"},
      {"default", false},
      {"description",
       "First fill the holes of a set with beta above 1: points are inserted in the middle of the deepest "
       "ones "
       "until the coverage radius is that of maximal Poisson-disk sampling with as many points as were "
       "brought, sqrt(0.6966 area / n), or r_f where that is larger. They come after the others, of which "
       "output i is input i moved."}};
}

ordered_json schema_reference(const std::string& name) { return {{"$ref", "#/components/schemas/" + name}}; }

ordered_json openapi_schemas() {
  ordered_json schemas;
  schemas["Domain"] = domain_schema();
  schemas["Points"] = points_schema();
  schemas["Picture"] = picture_schema();
  schemas["Sizing"] = sizing_schema();
  const ordered_json seed = {
      {"type", "integer"}, {"minimum", 0}, {"default", 0}, {"description", "same seed, same points"}};
  const ordered_json made = {
      {"domain", schema_reference("Domain")},
      {"sizing", schema_reference("Sizing")},
      {"seed", seed},
      {"allow_small_features",
       {{"type", "boolean"},
        {"default", false},
        {"description", "whether a radius may be larger than the smallest feature of a polygon or mesh"}}}};
  ordered_json asked = made;
  asked["picture"] = schema_reference("Picture");
  asked["barycentric"] = barycentric_schema();
  add_methods(schemas, "PointsToGenerate", generators(), made);
  add_methods(schemas, "GenerateRequest", generators(), asked);
  schemas["PointSource"] = source_schema();
  const ordered_json worked_on = {{"points", schema_reference("PointSource")},
                                  {"domain", schema_reference("Domain")},
                                  {"sizing", schema_reference("Sizing")},
                                  {"enrich", enrich_schema()}};
  add_methods(schemas, "PointsToOptimize", optimizers(), worked_on);
  ordered_json optimize = worked_on;
  optimize["picture"] = schema_reference("Picture");
  optimize["barycentric"] = barycentric_schema();
  add_methods(schemas, "OptimizeRequest", optimizers(), optimize);
  add_analyze_request(schemas);
  add_results(schemas);
  add_analysis(schemas);
  add_mesh(schemas);
  schemas["Job"] = job_schema();
  schemas["JobList"] = object({{"jobs", {{"type", "array"}, {"items", schema_reference("Job")}}}}, {"jobs"});
  schemas["UploadedDomain"] = uploaded_domain_schema();
  schemas["DomainList"] =
      object({{"domains", {{"type", "array"}, {"items", schema_reference("UploadedDomain")}}}}, {"domains"});
  schemas["Problem"] = problem_schema();
  return schemas;
}

}  // namespace wellspaced

#include "proto/openapi.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "core/registry.h"
#include "core/render/pictures/pictures.h"
#include "proto/measures/measures.h"
#include "proto/openapi_schemas.h"
#include "proto/operations.h"
#include "proto/result.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

struct StatusText {
  int status;
  const char* text;
};

constexpr StatusText problem_statuses[] = {
    {400, "malformed-request: the bytes can't be read"},
    {404, "not-found, no-such-job, no-such-domain, or result-not-ready (with Retry-After)"},
    {406, "not-acceptable: none of the accepted formats is available"},
    {408, "request-timeout"},
    {409, "conflict or cancelled"},
    {410, "result-expired"},
    {411, "length-required"},
    {413, "payload-too-large"},
    {414, "target-too-long"},
    {415, "unsupported-media-type"},
    {416, "range-not-satisfiable"},
    {417, "expectation-failed"},
    {422,
     "invalid-parameters, infeasible, degenerate-input, too-large or too-large-for-sync; `errors` names the "
     "field"},
    {429, "too-many-jobs (with Retry-After)"},
    {431, "header-too-large"},
    {500, "internal: only the request id is told"},
    {503, "overloaded, draining or storage-unavailable (with Retry-After)"},
    {504, "deadline-exceeded"},
    {505, "version-not-supported: HTTP/1.0 or 1.1 is spoken here"},
    {507, "storage-full"},
};

/// What any request may meet before its route is looked at.
constexpr int statuses_of_any_request[] = {400, 408, 414, 417, 431, 503, 505};

ordered_json problems(const std::vector<int>& statuses) {
  std::set<int> all(statuses.begin(), statuses.end());
  all.insert(std::begin(statuses_of_any_request), std::end(statuses_of_any_request));
  ordered_json out;
  for (const int status : all)
    out[std::to_string(status)] = {{"$ref", "#/components/responses/Problem" + std::to_string(status)}};
  return out;
}

ordered_json header(const char* description) {
  return {{"description", description}, {"schema", {{"type", "string"}}}};
}

ordered_json parameter(const std::string& name, const std::string& in, const std::string& description,
                       ordered_json schema) {
  ordered_json out = {{"name", name}, {"in", in}, {"description", description}};
  if (in == "path") out["required"] = true;
  out["schema"] = std::move(schema);
  return out;
}

/// Takes in what another picture means by a parameter of the same name.
void widen(ordered_json& schema, const ordered_json& other) {
  schema.erase("default");  // it depends on the picture
  if (schema.value("description", "") != other.value("description", ""))
    schema["description"] = schema.value("description", "") + "; or " + other.value("description", "");
  if (schema.contains("minimum") && other.contains("minimum"))
    schema["minimum"] = std::min(schema["minimum"].get<double>(), other["minimum"].get<double>());
  if (schema.contains("maximum") && other.contains("maximum"))
    schema["maximum"] = std::max(schema["maximum"].get<double>(), other["maximum"].get<double>());
}

/// Besides format and picture, the parameters of all pictures: picture.color, ...
ordered_json format_parameters(std::string_view operation) {
  ordered_json names = ordered_json::array(), picture_names = ordered_json::array();
  for (const Format format : formats_of(operation)) names.push_back(name_of(format));
  for (const Picture& picture : pictures()) picture_names.push_back(picture.name);
  ordered_json parameters = {
      parameter("format", "query", "wins over Accept", {{"type", "string"}, {"enum", names}}),
      parameter("picture", "query", "what an SVG or PNG answer shows",
                {{"type", "string"}, {"enum", picture_names}})};
  ordered_json schemas = ordered_json::object();
  const ordered_json choices = openapi_schemas()["Picture"]["oneOf"];
  for (const ordered_json& choice : choices) {
    if (!choice.contains("properties")) continue;
    for (const auto& [name, schema] : choice["properties"].items()) {
      if (name == "name") continue;
      if (!schemas.contains(name))
        schemas[name] = schema;
      else if (schemas[name] != schema)
        widen(schemas[name], schema);
    }
  }
  for (const auto& [name, schema] : schemas.items()) {
    ordered_json plain = schema;
    plain.erase("description");
    parameters.push_back(parameter("picture." + name, "query", schema["description"], std::move(plain)));
  }
  return parameters;
}

ordered_json mesh_format_parameter() {
  ordered_json names = ordered_json::array();
  for (const Format format : formats_of("mesh")) names.push_back(name_of(format));
  return parameter("format", "query", "wins over Accept", {{"type", "string"}, {"enum", names}});
}

ordered_json binary_schema() {
  return {{"type", "string"}, {"contentMediaType", "application/octet-stream"}};
}

/// A result in all formats of its operation.
ordered_json result_content(std::string_view operation, const std::string& schema) {
  ordered_json content;
  for (const Format format : formats_of(operation)) {
    const bool text =
        format == Format::csv || format == Format::svg || format == Format::obj || format == Format::vtu;
    ordered_json of = format == Format::json ? schema_reference(schema)
                      : text                 ? ordered_json{{"type", "string"}}
                                             : binary_schema();
    content[std::string(media_type_of(format))] = {{"schema", std::move(of)}};
  }
  return content;
}

ordered_json example_of(const std::string& operation) {
  ordered_json generate = {{"method", "poisson-disk"}, {"count", 10000}, {"seed", 1}};
  if (operation == "generate") return generate;
  if (operation == "analyze") return {{"points", {{"generate", generate}}}};
  if (operation == "mesh") return {{"points", {{"generate", generate}}}, {"method", "delaunay"}};
  return {{"points", {{"generate", generate}}}, {"method", "opt-beta-local"}, {"beta", 0.85}};
}

/// GenerateRequest, GenerateResult: the schemas of an operation.
std::string schema_name(const std::string& operation, const char* ending) {
  return static_cast<char>(std::toupper(static_cast<unsigned char>(operation[0]))) + operation.substr(1) +
         ending;
}

ordered_json request_body(const std::string& operation) {
  ordered_json content = {{"application/json",
                           {{"schema", schema_reference(schema_name(operation, "Request"))},
                            {"example", example_of(operation)}}}};
  if (operation != "generate") {
    content["application/x-npy"] = {{"schema", binary_schema()}};
    content["text/csv"] = {{"schema", {{"type", "string"}}}, {"example", "x,y\n0.1,0.2\n0.7,0.3\n0.4,0.8\n"}};
  }
  return {{"required", true}, {"content", std::move(content)}};
}

/// Fields of domains that have room in a query: numbers and words, each with what it may be on any of them.
ordered_json plain_domain_fields() {
  ordered_json fields = ordered_json::object();
  const ordered_json domains = openapi_schemas()["Domain"]["oneOf"];
  for (const ordered_json& domain : domains)
    for (const auto& [name, schema] : domain["properties"].items()) {
      if (schema.value("type", "") == "array" || schema.value("type", "") == "object") continue;
      if (!fields.contains(name)) {
        fields[name] = schema;
        continue;
      }
      if (!schema.contains("enum")) continue;
      for (const ordered_json& choice : schema["enum"]) fields[name]["enum"].push_back(choice);
    }
  return fields;
}

/// What goes into the query when the body is a table of points, from the schemas of the same JSON request.
void add_table_parameters(ordered_json& parameters, const std::string& operation) {
  const std::string where = " (with points as npy or csv in the body; else a field of the body)";
  const auto add = [&](const std::string& name, ordered_json schema) {
    std::string description = schema.value("description", name);
    schema.erase("description");
    parameters.push_back(parameter(name, "query", description + where, std::move(schema)));
  };
  if (operation == "optimize") {
    ordered_json names = ordered_json::array();
    ordered_json schemas = ordered_json::object();
    for (const Optimizer& method : optimizers()) names.push_back(method.name);
    add("method", {{"type", "string"}, {"enum", names}, {"default", names.front()}});
    for (const Optimizer& method : optimizers())
      for (const Parameter& p : method.parameters) {
        ordered_json schema = parameter_schema(p);
        if (!schemas.contains(p.name))
          schemas[p.name] = std::move(schema);
        else if (schemas[p.name] != schema)
          schemas[p.name].erase("default");  // it depends on the method
      }
    for (const auto& [name, schema] : schemas.items()) add(name, schema);
    add("enrich", enrich_schema());
  } else if (operation == "mesh") {
    ordered_json names = ordered_json::array();
    for (const Mesher& method : meshers()) names.push_back(method.name);
    add("method", {{"type", "string"}, {"enum", names}, {"default", names.front()}});
  } else {
    ordered_json names = ordered_json::array();
    for (const Measure& m : measures()) names.push_back(m.name);
    add("measures", {{"type", "array"}, {"items", {{"type", "string"}, {"enum", names}}}, {"minItems", 1}});
    parameters.back()["style"] = "form";
    parameters.back()["explode"] = false;
    for (const Measure& m : measures())
      for (const Parameter& p : m.parameters) add(m.name + "." + p.name, parameter_schema(p));
  }
  if (operation != "generate" && operation != "mesh") {
    add("sizing.type",
        {{"type", "string"}, {"enum", {"constant", "linear"}}, {"description", "of a sizing function"}});
    add("sizing.axis", {{"type", "string"}, {"enum", {"x", "y", "z"}}, {"description", "of a linear one"}});
    for (const char* name : {"sizing.radius", "sizing.from", "sizing.to"})
      add(name, {{"type", "number"}, {"description", "a radius of the sizing function"}});
  }
  const ordered_json fields = plain_domain_fields();
  for (const auto& [name, schema] : fields.items()) add("domain." + name, schema);
}

ordered_json run_responses(const std::string& operation) {
  ordered_json responses;
  responses["200"] = {
      {"description", "The result"},
      {"headers",
       {{"Wellspaced-Job", header("id under which the result is kept")},
        {"Wellspaced-Summary",
         header(
             "for formats without a summary of their own: the JSON result without its arrays, one line")}}},
      {"content", result_content(operation, schema_name(operation, "Result"))}};
  responses["202"] = {{"description", "The job is on disk; its result can be fetched later"},
                      {"headers",
                       {{"Location", header("the job")},
                        {"Retry-After", header("seconds")},
                        {"Preference-Applied", header("respond-async")}}},
                      {"content", {{"application/json", {{"schema", schema_reference("Job")}}}}}};
  responses.update(problems({404, 406, 409, 410, 411, 413, 415, 422, 429, 500, 504, 507}));
  return responses;
}

ordered_json operation_path(const std::string& name, const std::string& summary) {
  ordered_json parameters = name == "mesh" ? ordered_json{mesh_format_parameter()} : format_parameters(name);
  if (name != "generate") add_table_parameters(parameters, name);
  parameters.push_back(
      parameter("Prefer", "header",
                "respond-async: 202 at once; respond-async, wait=5: 200 if done within 5 s, else 202",
                {{"type", "string"}}));
  return {{"post",
           {{"operationId", name},
            {"tags", {"operations"}},
            {"summary", summary},
            {"description", "The same request gives the same bytes, synchronous or not."},
            {"parameters", std::move(parameters)},
            {"requestBody", request_body(name)},
            {"responses", run_responses(name)}}}};
}

ordered_json get(const char* id, const char* tag, const char* summary, ordered_json content,
                 const std::vector<int>& statuses, ordered_json parameters = ordered_json::array()) {
  ordered_json out = {{"operationId", id}, {"tags", {tag}}, {"summary", summary}};
  if (!parameters.empty()) out["parameters"] = std::move(parameters);
  out["responses"] = {{"200", {{"description", "OK"}, {"content", std::move(content)}}}};
  out["responses"].update(problems(statuses));
  return out;
}

ordered_json json_content(ordered_json schema) {
  return {{"application/json", {{"schema", std::move(schema)}}}};
}
ordered_json text_content() { return {{"text/plain", {{"schema", {{"type", "string"}}}}}}; }

ordered_json job_paths() {
  const ordered_json id = parameter("id", "path", "of the job", {{"type", "string"}});
  const ordered_json text = {{"type", "string"}};
  ordered_json paths;
  paths["/v1/jobs"] = {
      {"get",
       get("listJobs", "jobs", "List jobs, newest first", json_content(schema_reference("JobList")), {422},
           {parameter(
                "status", "query", "only these",
                {{"type", "string"}, {"enum", {"accepted", "running", "successful", "failed", "dismissed"}}}),
            parameter("operation", "query", "only these", text),
            parameter("limit", "query", "jobs a page",
                      {{"type", "integer"}, {"minimum", 1}, {"maximum", 500}, {"default", 50}}),
            parameter("cursor", "query", "from Link: rel=next", text)})}};
  ordered_json remove = {
      {"operationId", "deleteJob"},
      {"tags", {"jobs"}},
      {"summary", "Cancel a live job; with purge=true, delete a finished one"},
      {"parameters",
       {id,
        parameter("purge", "query", "needed for finished jobs, so that a repeated cancel destroys nothing",
                  {{"type", "boolean"}})}},
      {"responses",
       {{"200", {{"description", "Cancel requested"}, {"content", json_content(schema_reference("Job"))}}},
        {"204", {{"description", "Deleted"}}}}}};
  remove["responses"].update(problems({404, 409, 503}));
  paths["/v1/jobs/{id}"] = {
      {"get", get("getJob", "jobs", "Status of a job; Prefer: wait=20 waits for its end",
                  json_content(schema_reference("Job")), {404, 503},
                  {id, parameter("Prefer", "header", "wait=seconds, at most 60", text)})},
      {"delete", remove}};
  paths["/v1/jobs/{id}/events"] = {
      {"get", get("getJobEvents", "jobs", "Server-sent events status, progress and done",
                  {{"text/event-stream", {{"schema", text}}}}, {404, 503},
                  {id, parameter("Last-Event-ID", "header", "go on after this one", text)})}};
  paths["/v1/jobs/{id}/events"]["get"]["responses"]["204"] = {
      {"description", "Nothing will come after Last-Event-ID"}};
  ordered_json parameters = format_parameters("generate");
  parameters.insert(parameters.begin(), id);
  parameters.push_back(parameter("Range", "header", "one range of bytes", text));
  parameters.push_back(parameter("If-None-Match", "header", "an ETag", text));
  ordered_json content = result_content("generate", "GenerateResult");
  content["application/json"]["schema"] = {
      {"oneOf",
       {schema_reference("GenerateResult"), schema_reference("OptimizeResult"),
        schema_reference("AnalyzeResult"), schema_reference("MeshResult")}}};
  ordered_json result = get("getJobResult", "jobs", "Result of a job", content,
                            {404, 406, 409, 410, 416, 422, 500, 503, 504}, parameters);
  result["responses"]["206"] = {{"description", "The range asked for"}};
  result["responses"]["304"] = {{"description", "Not modified"}};
  paths["/v1/jobs/{id}/result"] = {{"get", result}};
  return paths;
}

ordered_json domain_paths() {
  const ordered_json id = parameter("id", "path", "of the domain", {{"type", "string"}});
  const ordered_json domain = json_content(schema_reference("UploadedDomain"));
  ordered_json content;
  for (const char* type : {"application/geo+json", "application/json"})
    content[type] = {{"schema", {{"type", "object"}}}};
  for (const char* type : {"text/wkt", "model/off", "model/obj", "model/ply", "application/octet-stream"})
    content[type] = {{"schema", {{"type", "string"}}}};
  ordered_json post = {
      {"operationId", "postDomain"},
      {"tags", {"domains"}},
      {"summary", "Keep a polygon or surface mesh, to be referred to by its id"},
      {"description",
       "The id is the SHA-256 of the bytes. Kept as long as a result, and as long as a live job or a kept "
       "result lies on it."},
      {"parameters",
       {parameter("format", "query", "wins over Content-Type; general types are told apart by first bytes",
                  {{"type", "string"}, {"enum", {"geojson", "json", "wkt", "off", "obj", "ply"}}}),
        parameter("allow_self_intersections", "query", "of meshes: faces may cross", {{"type", "boolean"}})}},
      {"requestBody", {{"required", true}, {"content", std::move(content)}}},
      {"responses",
       {{"200", {{"description", "It was there already"}, {"content", domain}}},
        {"201",
         {{"description", "Kept"},
          {"headers", {{"Location", header("the domain")}}},
          {"content", domain}}}}}};
  post["responses"].update(problems({411, 413, 415, 422, 500, 507}));
  ordered_json remove = {{"operationId", "deleteDomain"},
                         {"tags", {"domains"}},
                         {"summary", "Delete a domain that no live job and no kept result lies on"},
                         {"parameters", {id}},
                         {"responses", {{"204", {{"description", "Deleted"}}}}}};
  remove["responses"].update(problems({404, 409, 503}));
  ordered_json paths;
  paths["/v1/domains"] = {
      {"post", std::move(post)},
      {"get", get("listDomains", "domains", "List domains, by id",
                  json_content(schema_reference("DomainList")), {422},
                  {parameter("limit", "query", "domains a page",
                             {{"type", "integer"}, {"minimum", 1}, {"maximum", 500}, {"default", 50}}),
                   parameter("cursor", "query", "from Link: rel=next", {{"type", "string"}})})}};
  paths["/v1/domains/{id}"] = {
      {"get", get("getDomain", "domains", "What a domain is", domain, {404, 503}, {id})},
      {"delete", std::move(remove)}};
  return paths;
}

ordered_json service_paths() {
  const ordered_json any = {{"type", "object"}};
  ordered_json paths;
  paths["/v1/operations"] = {
      {"get", get("listOperations", "service", "Methods, parameters, formats and limits", json_content(any),
                  {503})}};
  paths["/v1/operations/{operation}"] = {
      {"get",
       get("getOperation", "service", "One operation", json_content(any), {404},
           {parameter("operation", "path", "its name", {{"type", "string"}, {"enum", operation_names}})})}};
  paths["/livez"] = {{"get", get("getLivez", "service", "The process answers", text_content(), {503})}};
  paths["/readyz"] = {{"get", get("getReadyz", "service", "New work is taken", text_content(), {503})}};
  paths["/version"] = {{"get", get("getVersion", "service", "Name and version", json_content(any), {503})}};
  paths["/metrics"] = {{"get", get("getMetrics", "service", "Prometheus text", text_content(), {503})}};
  paths["/openapi.json"] = {{"get", get("getOpenapi", "service", "This document", json_content(any), {503})}};
  paths["/"] = {{"get", get("getRoot", "service", "Where to go from here", text_content(), {503})}};
  return paths;
}

}  // namespace

ordered_json openapi_json(const Limits& limits) {
  ordered_json paths;
  paths["/v1/generate"] = operation_path("generate", "Make a point set");
  paths["/v1/optimize"] = operation_path("optimize", "Make a point set well spaced");
  paths["/v1/analyze"] = operation_path("analyze", "Measure a point set");
  paths["/v1/mesh"] = operation_path("mesh", "Make triangles or cells of a point set");
  paths.update(domain_paths());
  paths.update(job_paths());
  paths.update(service_paths());
  ordered_json responses;
  for (const auto& [status, text] : problem_statuses)
    responses["Problem" + std::to_string(status)] = {
        {"description", text},
        {"content", {{"application/problem+json", {{"schema", schema_reference("Problem")}}}}}};
  ordered_json out = {
      {"openapi", "3.1.0"},
      {"info",
       {{"title", "wellspaced"},
        {"version", version()},
        {"summary", "Well-spaced blue-noise point sets"},
        {"description",
         "Generates, optimizes, analyzes and meshes point sets that are random and yet cover their domain "
         "evenly, "
         "measured by beta = r_c / r_f, coverage radius over conflict radius. Limits here: body " +
             std::to_string(limits.body_bytes) + " bytes, " + std::to_string(limits.generate_points) +
             " points."},
        {"license", {{"name", "GPL-3.0-or-later"}, {"identifier", "GPL-3.0-or-later"}}}}},
      {"servers", {{{"url", "/"}, {"description", "where this document came from"}}}},
      {"security", ordered_json::array()},
      {"tags",
       {{{"name", "operations"}, {"description", "The work"}},
        {{"name", "domains"}, {"description", "Polygons and meshes that are kept"}},
        {{"name", "jobs"}, {"description", "Work that is waited for elsewhere"}},
        {{"name", "service"}, {"description", "The service itself"}}}},
      {"paths", std::move(paths)},
      {"components", {{"schemas", openapi_schemas()}, {"responses", std::move(responses)}}}};
  return out;
}

}  // namespace wellspaced

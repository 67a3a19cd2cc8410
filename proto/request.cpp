#include "proto/request.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/domain/torus.h"
#include "core/generate/enrich.h"
#include "core/generate/generate.h"
#include "proto/arguments.h"
#include "proto/fields.h"
#include "proto/formats/media.h"
#include "proto/json_reader.h"

namespace wellspaced {
namespace {

using nlohmann::json;

/// A request after its bytes are understood: one JSON object, and the points that were not JSON.
struct Document {
  json root;
  std::optional<Table> points;
  std::string points_pointer;
};

/// "0.5" in a query means the number: what a JSON body would hold.
json scalar_from_text(const std::string& text) {
  const json value = json::parse(text, nullptr, false);
  return value.is_number() ? value : json(text);
}

/// measures=a,b is a list, enrich=true no text; both are the only ones of their kind.
json value_from_text(const std::string& name, const std::string& text) {
  if (name == "enrich" && (text == "true" || text == "false")) return text == "true";
  if (name != "measures") return scalar_from_text(text);
  json list = json::array();
  std::size_t from = 0;
  for (std::size_t to = 0; to != std::string::npos; from = to + 1) {
    to = text.find(',', from);
    list.push_back(text.substr(from, to == std::string::npos ? to : to - from));
  }
  return list;
}

/// domain.width=2 stands for {"domain": {"width": 2}}.
json object_from_query(const std::vector<std::pair<std::string, std::string>>& query) {
  json root = json::object();
  for (const auto& [key, value] : query) {
    const auto dot = key.find('.');
    const bool nested = dot != std::string::npos;
    const std::string outer = key.substr(0, dot), name = nested ? key.substr(dot + 1) : key;
    if (nested && !root.contains(outer)) root[outer] = json::object();
    json& parent = nested ? root[outer] : root;
    if (!parent.is_object() || parent.contains(name))
      throw Error(ErrorCode::invalid_parameters, "the parameter is given twice; give it once",
                  (nested ? pointer_token(outer) : "") + pointer_token(name));
    parent[name] = value_from_text(name, value);
  }
  return root;
}

/// The points of a body that is not JSON. Errors point to where the points would be in a JSON body.
Table read_table(Format format, std::string_view body, std::size_t row_limit) {
  try {
    return format == Format::npy ? read_npy(body, row_limit) : read_csv(body, row_limit);
  } catch (const Error& error) {
    throw error.within("/points");
  }
}

std::uint64_t point_limit(std::string_view operation, const Limits& limits) {
  if (operation == "optimize") return limits.optimize_points;
  return operation == "analyze" ? limits.analyze_points : limits.generate_points;
}

Document read_document(const RawRequest& raw, const Limits& limits) {
  const Format format = input_format(raw.content_type);
  const auto rows = static_cast<std::size_t>(point_limit(raw.operation, limits));
  if (format == Format::json) {
    if (!raw.query.empty())
      throw Error(
          ErrorCode::invalid_parameters,
          "with a JSON body, parameters go into the body; only format and picture are read from the query",
          pointer_token(raw.query.front().first));
    static constexpr std::array<std::string_view, 2> tables = {"/points", "/points/points"};
    JsonDocument document = read_json(raw.body, tables, rows);
    return {std::move(document.root), std::move(document.points), std::move(document.points_pointer)};
  }
  if (raw.operation == "generate")
    throw Error(ErrorCode::unsupported_media_type,
                "generate takes no points; send its parameters as application/json");
  for (const auto& [name, value] : raw.query)
    if (name == "width" || name == "height")
      throw Error(ErrorCode::invalid_parameters,
                  "the sides of the torus are the parameters domain.width and domain.height", "/" + name);
  json root = object_from_query(raw.query);
  if (root.contains("points"))
    throw Error(ErrorCode::invalid_parameters, "the points are the body; leave this parameter out",
                "/points");
  root["points"] = json::array();
  return {std::move(root), read_table(format, raw.body, rows), "/points"};
}

template <class Row>
std::string names_of(std::span<const Row> rows) {
  std::string names;
  for (const Row& row : rows) names += (names.empty() ? "" : ", ") + row.name;
  return names;
}

template <class Row>
const Row& find_row(std::span<const Row> rows, const std::string& name, const std::string& where) {
  for (const Row& row : rows)
    if (row.name == name) return row;
  throw Error(ErrorCode::invalid_parameters, "unknown name; there are: " + names_of(rows), where);
}

std::shared_ptr<const Domain> domain_field(Fields& fields) {
  const json* value = fields.find("domain");
  return value != nullptr ? read_domain(*value, fields.pointer_to("domain")) : std::make_shared<Torus>();
}

void require_count(double points, std::uint64_t limit, const std::string& where) {
  if (points <= static_cast<double>(limit)) return;
  throw Error(ErrorCode::too_large,
              (std::isfinite(points) ? "about " + number_text(std::round(points)) : "Countless") +
                  " points are asked for, but the limit here is " + std::to_string(limit) + "; ask for fewer",
              where);
}

GenerateRequest generate_request(Fields& fields, std::uint64_t limit) {
  GenerateRequest request;
  request.domain = domain_field(fields);
  request.method = &find_row(generators(), fields.text("method").value_or(generators().front().name),
                             fields.pointer_to("method"));
  request.seed = fields.whole("seed").value_or(0);
  request.arguments = read_arguments(*request.method, fields);
  const std::string density = fields.pointer_to(request.arguments.count("count") != 0 ? "count" : "radius");
  require_count(request.method->expected_count(*request.domain, request.arguments), limit, density);
  try {
    if (request.method->check != nullptr) request.method->check(*request.domain, request.arguments);
  } catch (const Error& error) {
    throw error.within(fields.pointer());
  }
  return request;
}

PointSet inline_points(std::shared_ptr<const Domain> domain, Document& document) {
  Table& table = *document.points;
  const auto dimension = static_cast<std::size_t>(domain->dimension());
  if (table.rows != 0 && table.columns != dimension)
    throw Error(ErrorCode::invalid_parameters,
                "points of a " + std::string(domain->type()) + " have " + std::to_string(dimension) +
                    " coordinates; these have " + std::to_string(table.columns),
                document.points_pointer);
  PointSet points{std::move(domain), std::move(table.values)};
  try {
    require_usable(points, Control());
  } catch (const Error& error) {
    throw error.within(document.points_pointer);
  }
  return points;
}

PointSet job_points_field(Fields& fields, const JobPoints& job_points) {
  const std::string id = *fields.text("job");
  fields.refuse_unknown();
  try {
    return job_points(id);
  } catch (const Error& error) {
    throw Error(error.code(), error.what(), fields.pointer_to("job"));
  }
}

/// {"generate": {...}} or {"job": "..."} or {"points": [...], "domain": {...}}
PointSource source_object(const json& value, Document& document, std::uint64_t limit,
                          const JobPoints& job_points) {
  Fields fields(value, "/points");
  const json *generate = fields.find("generate"), *job = fields.find("job"), *points = fields.find("points");
  if ((generate != nullptr) + (job != nullptr) + (points != nullptr) != 1)
    throw Error(ErrorCode::invalid_parameters, "give exactly one of generate, job or points", "/points");
  if (generate != nullptr) {
    fields.refuse_unknown();
    Fields inner(*generate, "/points/generate");
    return generate_request(inner, limit);
  }
  if (job != nullptr) return job_points_field(fields, job_points);
  if (!document.points)
    throw Error(ErrorCode::invalid_parameters, "expected an array of points, found " + describe(*points),
                "/points/points");
  std::shared_ptr<const Domain> domain = domain_field(fields);
  fields.refuse_unknown();
  return inline_points(std::move(domain), document);
}

PointSource point_source(Fields& fields, Document& document, std::uint64_t limit,
                         const JobPoints& job_points) {
  const json& value = fields.require("points", "[[x, y], ...], {\"generate\": {...}} or {\"job\": \"...\"}");
  if (value.is_array()) {
    if (!document.points) document.points = Table{};
    return inline_points(domain_field(fields), document);
  }
  PointSource source = source_object(value, document, limit, job_points);
  if (fields.find("domain") != nullptr)
    throw Error(ErrorCode::invalid_parameters, "the points bring their own domain; put it where they are",
                "/domain");
  // What a radius gives is known only after the work.
  if (const auto* generated = std::get_if<GenerateRequest>(&source))
    if (argument(generated->arguments, "count").value_or(3) < 3)
      throw Error(ErrorCode::degenerate_input, "at least 3 points are needed here", "/points/generate/count");
  return source;
}

double source_points(const PointSource& source) {
  if (const auto* points = std::get_if<PointSet>(&source)) return static_cast<double>(points->size());
  const auto& generate = std::get<GenerateRequest>(source);
  return generate.method->expected_count(*generate.domain, generate.arguments);
}

const Domain& source_domain(const PointSource& source) {
  const auto* points = std::get_if<PointSet>(&source);
  return points != nullptr ? *points->domain : *std::get<GenerateRequest>(source).domain;
}

double worked_on_points(const OptimizeRequest& request) {
  const double n = source_points(request.points);
  if (!request.enrich) return n;
  const Domain& domain = source_domain(request.points);
  return n + most_inserted(domain, radius_for_count(domain, std::max(1.0, n)));
}

void require_room_to_enrich(const OptimizeRequest& request, std::uint64_t limit) {
  const double most = worked_on_points(request);
  if (most <= static_cast<double>(limit)) return;
  throw Error(ErrorCode::too_large,
              "with its holes filled the set may have up to " + number_text(std::round(most)) +
                  " points, but the limit here is " + std::to_string(limit) +
                  "; bring fewer points, or leave enrich out",
              "/enrich");
}

OptimizeRequest optimize_request(Fields& fields, Document& document, const Limits& limits,
                                 const JobPoints& job_points) {
  OptimizeRequest request;
  // The method's own fields first: they are cheap to check, the points are not.
  request.method =
      &find_row(optimizers(), fields.text("method").value_or(optimizers().front().name), "/method");
  fields.find("points");
  fields.find("domain");
  request.enrich = fields.flag("enrich").value_or(false);
  request.arguments = read_arguments(*request.method, fields);
  request.points = point_source(fields, document, limits.optimize_points, job_points);
  if (request.enrich) require_room_to_enrich(request, limits.optimize_points);
  return request;
}

std::vector<const Measure*> measures_field(Fields& fields) {
  const json* value = fields.find("measures");
  if (value == nullptr) return {&measures().front()};
  if (!value->is_array() || value->empty())
    throw Error(ErrorCode::invalid_parameters,
                "expected an array of one or more names (there are: " + names_of(measures()) + "), found " +
                    (value->is_array() ? "an empty one" : describe(*value)),
                "/measures");
  std::vector<const Measure*> wanted;
  for (std::size_t k = 0; k < value->size(); ++k) {
    const std::string where = "/measures/" + std::to_string(k);
    if (!(*value)[k].is_string())
      throw Error(ErrorCode::invalid_parameters, "expected a string, found " + describe((*value)[k]), where);
    const Measure* measure = &find_row(measures(), (*value)[k].get<std::string>(), where);
    if (std::find(wanted.begin(), wanted.end(), measure) != wanted.end())
      throw Error(ErrorCode::invalid_parameters, "the measure is named twice", where);
    wanted.push_back(measure);
  }
  return wanted;
}

AnalyzeRequest analyze_request(Fields& fields, Document& document, const Limits& limits,
                               const JobPoints& job_points) {
  AnalyzeRequest request;
  request.measures = measures_field(fields);
  fields.find("points");
  fields.find("domain");
  fields.refuse_unknown();
  request.points = point_source(fields, document, limits.analyze_points, job_points);
  return request;
}

Cost times(double n, Cost cost) { return {n * cost.seconds, n * cost.bytes}; }
/// One after the other: what the first one needed is free again.
Cost operator+(Cost a, Cost b) { return {a.seconds + b.seconds, std::max(a.bytes, b.bytes)}; }

Cost generate_cost(const GenerateRequest& request) {
  return times(request.method->expected_count(*request.domain, request.arguments),
               request.method->cost_a_point);
}

Cost source_cost(const PointSource& source) {
  const auto* generate = std::get_if<GenerateRequest>(&source);
  return generate != nullptr ? generate_cost(*generate) : times(source_points(source), {0, 32});
}

}  // namespace

std::shared_ptr<const Domain> read_domain(const json& value, const std::string& pointer) {
  Fields fields(value, pointer);
  const std::string type = fields.text("type").value_or("torus");
  if (type != "torus")
    throw Error(ErrorCode::invalid_parameters, "unknown domain; there is: torus", fields.pointer_to("type"));
  const double width = fields.number("width").value_or(1), height = fields.number("height").value_or(1);
  fields.refuse_unknown();
  try {
    return std::make_shared<Torus>(width, height);
  } catch (const Error& error) {
    throw error.within(pointer);
  }
}

nlohmann::ordered_json domain_to_json(const Domain& domain) {
  const Box box = domain.box();
  return {{"type", domain.type()}, {"width", box.size.x}, {"height", box.size.y}};
}

Request read_request(const RawRequest& raw, const Limits& limits, const JobPoints& job_points) {
  Document document = read_document(raw, limits);
  Fields fields(document.root, "");
  Request request;
  request.picture = fields.text("picture").value_or("");
  if (!request.picture.empty()) require_picture(request.picture, "/picture");
  if (raw.operation == "generate") {
    request.operation = generate_request(fields, limits.generate_points);
  } else if (raw.operation == "optimize") {
    request.operation = optimize_request(fields, document, limits, job_points);
  } else {
    request.operation = analyze_request(fields, document, limits, job_points);
  }
  require_affordable(request, limits);
  return request;
}

double expected_points(const Request& request) {
  if (const auto* optimize = std::get_if<OptimizeRequest>(&request.operation))
    return worked_on_points(*optimize);
  if (const auto* analyze = std::get_if<AnalyzeRequest>(&request.operation))
    return source_points(analyze->points);
  const auto& generate = std::get<GenerateRequest>(request.operation);
  return generate.method->expected_count(*generate.domain, generate.arguments);
}

Cost expected_cost(const Request& request) {
  constexpr Cost writing = {3e-7, 200};    // a point of the result, as text at worst
  constexpr Cost enriching = {8e-6, 300};  // a point that there is in the end
  const double n = expected_points(request);
  if (const auto* optimize = std::get_if<OptimizeRequest>(&request.operation))
    return source_cost(optimize->points) + times(optimize->enrich ? n : 0, enriching) +
           times(n, optimize->method->cost_a_point(optimize->arguments)) + times(n, writing);
  if (const auto* analyze = std::get_if<AnalyzeRequest>(&request.operation)) {
    Cost cost = source_cost(analyze->points);
    for (const Measure* measure : analyze->measures) cost = cost + times(n, measure->cost_a_point);
    return cost;
  }
  return generate_cost(std::get<GenerateRequest>(request.operation)) + times(n, writing);
}

/// The field that says how many points there are.
std::string size_field(const Request& request) {
  const auto* generate = std::get_if<GenerateRequest>(&request.operation);
  if (generate == nullptr) return "/points";
  return argument(generate->arguments, "count") ? "/count" : "/radius";
}

void require_affordable(const Request& request, const Limits& limits) {
  const double bytes = expected_cost(request).bytes;
  if (bytes <= static_cast<double>(limits.memory_bytes)) return;
  throw Error(ErrorCode::too_large,
              "the job would need about " + std::to_string(static_cast<std::uint64_t>(bytes) >> 20) +
                  " MiB of memory, but the limit here is " + std::to_string(limits.memory_bytes >> 20) +
                  " MiB; ask for fewer points",
              size_field(request));
}

}  // namespace wellspaced

#include "proto/document.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/error.h"
#include "proto/fields.h"
#include "proto/formats/csv.h"
#include "proto/formats/media.h"
#include "proto/formats/npy.h"
#include "proto/measures/measures.h"

namespace wellspaced {
namespace {

using nlohmann::json;

/// "0.5" in a query means the number: what a JSON body would hold; ".5" does, too.
json scalar_from_text(const std::string& text) {
  const json value = json::parse(text, nullptr, false);
  if (value.is_number()) return value;
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  const bool whole = read.ec == std::errc() && read.ptr == end && std::isfinite(number);
  return whole ? json(number) : json(text);
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
json object_from_query(const Query& query) {
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

std::string how_to_write_parameters(const Measure& measure) {
  if (measure.parameters.empty()) return "the measure " + measure.name + " has no parameters; leave this out";
  const std::string name = measure.name + "." + measure.parameters.front().name;
  return "a measure is named in measures alone, and its parameters are written like " + name + "=...";
}

/// {"measures": ["a"], "a": {"x": 1}} becomes {"measures": [{"measure": "a", "x": 1}]}.
void move_measure_parameters(json& root) {
  json none = json::array();
  const bool listed = root.contains("measures") && root["measures"].is_array();
  for (json& wanted : listed ? root["measures"] : none) {
    const std::string name = wanted.get<std::string>();
    const auto given = root.find(name);
    const Measure* const measure = find_measure(name);
    if (measure == nullptr || given == root.end()) continue;
    if (!given->is_object() || given->contains("measure"))
      throw Error(ErrorCode::invalid_parameters, how_to_write_parameters(*measure),
                  pointer_token(name) + (given->is_object() ? "/measure" : ""));
    json call = {{"measure", name}};
    call.update(*given);
    wanted = std::move(call);
    root.erase(given);
  }
  for (const Measure& measure : measures())
    if (root.contains(measure.name))
      throw Error(
          ErrorCode::invalid_parameters,
          "these are parameters of a measure that is not asked for; add " + measure.name + " to measures",
          pointer_token(measure.name));
}

/// "picture.color" is /picture/color, as in a JSON body.
std::string pointer_of(const std::string& key) {
  return key == "picture" ? "/picture" : "/picture" + pointer_token(key.substr(sizeof "picture." - 1));
}

/// The points of a body that is not JSON. Errors point to where the points would be in a JSON body.
Table read_table(Format format, std::string_view body, std::size_t row_limit) {
  try {
    return format == Format::npy ? read_npy(body, row_limit) : read_csv(body, row_limit);
  } catch (const Error& error) {
    throw error.within("/points");
  }
}

JsonDocument read_json_body(const RawRequest& raw, std::size_t rows) {
  if (!raw.query.empty())
    throw Error(
        ErrorCode::invalid_parameters,
        "with a JSON body, parameters go into the body; only format and picture are read from the query",
        pointer_token(raw.query.front().first));
  static constexpr std::array<std::string_view, 2> places = {"/**/points", "/**/sets/*"};
  return read_json(raw.body, places, rows);
}

}  // namespace

bool is_picture_parameter(std::string_view name) { return name == "picture" || name.starts_with("picture."); }

json picture_of_query(const Query& query) {
  json picture;
  for (const auto& [key, text] : query) {
    if (!is_picture_parameter(key)) continue;
    const std::string name = key == "picture" ? "name" : key.substr(sizeof "picture." - 1);
    if (picture.contains(name))
      throw Error(ErrorCode::invalid_parameters, "given twice; give it once", pointer_of(key));
    if (text.empty())
      throw Error(ErrorCode::invalid_parameters, "it is empty; give a value or leave it out",
                  pointer_of(key));
    picture[name] = name != "name" ? scalar_from_text(text) : json(text);
  }
  // A name alone is the short form, and errors then point to it.
  return picture.is_object() && picture.size() == 1 && picture.contains("name") ? picture["name"] : picture;
}

RawRequest raw_request(std::string_view operation, std::string_view content_type, std::string_view body,
                       const Query& query) {
  RawRequest raw{operation, content_type, body, {}, picture_of_query(query)};
  for (const auto& parameter : query)
    if (!is_picture_parameter(parameter.first)) raw.query.push_back(parameter);
  return raw;
}

std::uint64_t point_limit(std::string_view operation, const Limits& limits) {
  if (operation == "optimize") return limits.optimize_points;
  if (operation == "mesh") return limits.mesh_points;
  return operation == "analyze" ? limits.analyze_points : limits.generate_points;
}

JsonDocument read_document(const RawRequest& raw, const Limits& limits) {
  const Format format = input_format(raw.content_type);
  const auto rows = static_cast<std::size_t>(point_limit(raw.operation, limits));
  if (format == Format::json) return read_json_body(raw, rows);
  if (raw.operation == "generate")
    throw Error(ErrorCode::unsupported_media_type,
                "generate takes no points; send its parameters as application/json");
  for (const auto& [name, value] : raw.query)
    if (name == "width" || name == "height")
      throw Error(ErrorCode::invalid_parameters,
                  "the sides of the torus are the parameters domain.width and domain.height", "/" + name);
  json root = object_from_query(raw.query);
  for (const char* name : {"points", "sets", "compare"})
    if (root.contains(name))
      throw Error(ErrorCode::invalid_parameters,
                  "the points are the body, one set of them; leave this parameter out, or send all as JSON",
                  pointer_token(name));
  if (raw.operation == "analyze") move_measure_parameters(root);
  root["points"] = json::array();
  JsonDocument document{std::move(root), {}};
  document.tables.push_back({"/points", read_table(format, raw.body, rows)});
  return document;
}

}  // namespace wellspaced

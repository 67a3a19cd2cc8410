#include "proto/request.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/domain/box_domain.h"
#include "core/domain/sphere.h"
#include "core/domain/surface_mesh.h"
#include "core/domain/torus.h"
#include "proto/arguments.h"
#include "proto/fields.h"
#include "proto/find_row.h"
#include "proto/formats/polygon.h"
#include "proto/formats/surface_mesh.h"
#include "proto/picture.h"
#include "proto/result.h"
#include "proto/source_reader.h"
#include "proto/stored_domain.h"

namespace wellspaced {
namespace {

using nlohmann::json;

/// What says which sets are averaged over.
constexpr const char* group_fields[] = {"points", "sets", "seeds", "domain", "sizing"};

/// "spacing" or {"measure": "spectrum", "range": 2.5}
MeasureCall measure_call(const json& value, const std::string& where) {
  if (!value.is_string() && !value.is_object())
    throw Error(
        ErrorCode::invalid_parameters,
        "expected a string, the measure's name, or an object with measure and its parameters, found " +
            describe(value),
        where);
  const json call_object = value.is_string() ? json{{"measure", value}} : value;
  Fields fields(call_object, where);
  fields.require("measure", "its name, one of: " + names_of(measures()));
  MeasureCall call;
  call.pointer = where;
  call.measure =
      &find_row(measures(), *fields.text("measure"), value.is_string() ? where : where + "/measure");
  call.arguments = read_arguments(*call.measure, fields);
  return call;
}

std::vector<MeasureCall> measures_field(Fields& fields) {
  const json* value = fields.find("measures");
  if (value == nullptr) return {{&measures().front(), {}, "/measures"}};
  if (!value->is_array() || value->empty())
    throw Error(ErrorCode::invalid_parameters,
                "expected an array of one or more names (there are: " + names_of(measures()) + "), found " +
                    (value->is_array() ? "an empty one" : describe(*value)),
                "/measures");
  std::vector<MeasureCall> calls;
  for (std::size_t k = 0; k < value->size(); ++k) {
    const std::string where = "/measures/" + std::to_string(k);
    MeasureCall call = measure_call((*value)[k], where);
    const auto same = [&](const MeasureCall& other) { return other.measure == call.measure; };
    if (std::any_of(calls.begin(), calls.end(), same))
      throw Error(ErrorCode::invalid_parameters, "the measure is named twice", where);
    calls.push_back(std::move(call));
  }
  return calls;
}

/// How many points a set will have, where that is known before the work: not what a radius gives, nor how
/// many points fill holes.
std::optional<double> known_size(const PointSource& source) {
  if (const auto* generated = std::get_if<GenerateRequest>(&source.from))
    return argument(generated->arguments, "count");
  if (const auto* optimized = std::get_if<std::shared_ptr<const OptimizeRequest>>(&source.from))
    return (*optimized)->enrich ? std::nullopt : known_size((*optimized)->points);
  return static_cast<double>(std::get<PointSet>(source.from).size());
}

/// Sets of one group are of one size and domain: what is known of them before the work.
void require_alike(const SourceGroup& group) {
  std::optional<double> size;
  for (const PointSource& set : group.sets) {
    require_same_domain(domain_of(group.sets.front()), domain_of(set), set.pointer);
    const std::optional<double> known = known_size(set);
    if (size && known) require_same_size(*size, *known, set.pointer);
    if (known) size = known;
  }
}

/// [{"label": "...", "points": ...}, {"label": "...", "sets": [...]}, ...]
std::vector<SourceGroup> compared_groups(const json& value, SourceReader& reader) {
  constexpr std::size_t most_groups = 16;
  if (!value.is_array() || value.empty() || value.size() > most_groups)
    throw Error(ErrorCode::invalid_parameters,
                "expected an array of 1 to 16 objects, each with points or sets, and a label if you like",
                "/compare");
  std::vector<SourceGroup> groups;
  for (std::size_t g = 0; g < value.size(); ++g) {
    Fields fields(value[g], "/compare/" + std::to_string(g));
    for (const char* name : group_fields) fields.find(name);
    const std::string label = fields.text("label").value_or("");
    constexpr std::ptrdiff_t longest_label = 60;
    const auto begins_character = [](unsigned char c) { return (c & 0xc0) != 0x80; };
    if (std::count_if(label.begin(), label.end(), begins_character) > longest_label)
      throw Error(ErrorCode::invalid_parameters, "a label has at most 60 characters",
                  fields.pointer_to("label"));
    fields.refuse_unknown();
    groups.push_back(reader.group(fields));
    groups.back().label = label;
  }
  return groups;
}

double points_of(const SourceGroup& group) {
  double sum = 0;
  for (const PointSource& set : group.sets) sum += expected_points(set);
  return sum;
}

void require_total(const std::vector<SourceGroup>& groups, std::uint64_t limit) {
  double total = 0;
  for (const SourceGroup& group : groups) total += points_of(group);
  if (total <= static_cast<double>(limit)) return;
  const auto fewer = [](const SourceGroup& a, const SourceGroup& b) { return points_of(a) < points_of(b); };
  throw Error(ErrorCode::too_large,
              "the sets have about " + number_text(std::round(total)) +
                  " points together, but the limit here is " + std::to_string(limit) +
                  "; ask for fewer sets or points",
              std::max_element(groups.begin(), groups.end(), fewer)->pointer);
}

/// What is known of a measure of these sets before the work.
void require_possible(const MeasureCall& call, const SourceGroup& group) {
  const Domain& domain = domain_of(group.sets.front());
  require_meaning(*call.measure, domain, call.pointer);
  if (call.measure->check == nullptr) return;
  try {
    call.measure->check(domain, expected_points(group.sets.front()), call.arguments);
  } catch (const Error& error) {
    throw error.within(call.pointer);
  }
}

AnalyzeRequest analyze_request(Fields& fields, SourceReader& reader, const Limits& limits) {
  AnalyzeRequest request;
  request.measures = measures_field(fields);
  for (const char* name : group_fields) fields.find(name);
  const json* compared = fields.find("compare");
  fields.refuse_unknown();
  request.compares = compared != nullptr;
  if (compared != nullptr) {
    for (const char* name : group_fields)
      if (fields.find(name) != nullptr)
        throw Error(ErrorCode::invalid_parameters, "what is compared brings its own points; put this there",
                    fields.pointer_to(name));
    request.groups = compared_groups(*compared, reader);
  } else {
    request.groups = {reader.group(fields)};
  }
  require_total(request.groups, limits.analyze_points);
  for (const SourceGroup& group : request.groups) {
    require_alike(group);
    for (const MeasureCall& call : request.measures) require_possible(call, group);
  }
  return request;
}

MeshRequest mesh_request(Fields& fields, SourceReader& reader) {
  MeshRequest request;
  request.method = &find_row(meshers(), fields.text("method").value_or(meshers().front().name), "/method");
  fields.find("points");
  fields.find("domain");
  fields.refuse_unknown();
  request.points = reader.points(fields);
  return request;
}

/// [true, false]: along which axes a rectangle repeats.
std::optional<std::array<bool, 2>> periodic_field(Fields& fields) {
  const json* value = fields.find("periodic");
  if (value == nullptr) return std::nullopt;
  if (!value->is_array() || value->size() != 2 || !(*value)[0].is_boolean() || !(*value)[1].is_boolean())
    throw Error(ErrorCode::invalid_parameters,
                "expected two booleans, whether the domain repeats along x and along y, as in [true, false]",
                fields.pointer_to("periodic"));
  return std::array<bool, 2>{(*value)[0].get<bool>(), (*value)[1].get<bool>()};
}

/// A torus, or a box if it isn't periodic along both axes.
std::shared_ptr<const Domain> rectangle(Fields& fields, bool repeats) {
  const double width = fields.number("width").value_or(1), height = fields.number("height").value_or(1);
  const std::array<bool, 2> periodic = periodic_field(fields).value_or(std::array<bool, 2>{repeats, repeats});
  fields.refuse_unknown();
  if (periodic[0] && periodic[1]) return std::make_shared<Torus>(width, height);
  return std::make_shared<BoxDomain>(width, height, periodic);
}

std::shared_ptr<const Domain> sphere(Fields& fields) {
  const double radius = fields.number("radius").value_or(1);
  fields.refuse_unknown();
  return std::make_shared<Sphere>(radius);
}

/// {"type": "mesh", "id": "..."}
std::shared_ptr<const Domain> uploaded(Fields& fields, const std::string& type, const DomainById& find) {
  const std::string id = *fields.text("id"), where = fields.pointer_to("id");
  fields.refuse_unknown();
  if (!is_content_id(id))
    throw Error(ErrorCode::invalid_parameters,
                "expected 64 hexadecimal digits in lower case, as POST /v1/domains answers with", where);
  if (!find) throw Error(ErrorCode::no_such_domain, "nothing is uploaded here; give the domain whole", where);
  std::shared_ptr<const Domain> domain;
  try {
    domain = find(id);
  } catch (const Error& error) {
    throw Error(error.code(), error.what(), where);
  }
  if (domain->type() != type)
    throw Error(ErrorCode::invalid_parameters,
                "the domain with this id is a " + std::string(domain->type()) + "; say so",
                fields.pointer_to("type"));
  return domain;
}

void require_mesh(const Domain& domain) {
  if (dynamic_cast<const SurfaceMesh*>(&domain) != nullptr) return;
  throw Error(ErrorCode::invalid_parameters, "only points on a mesh are in a face; leave this out",
              "/barycentric");
}

}  // namespace

std::shared_ptr<const Domain> read_domain(const json& value, const std::string& pointer,
                                          const DomainById& find) {
  Fields fields(value, pointer);
  const std::string type = fields.text("type").value_or("torus");
  if ((type == "polygon" || type == "mesh") && fields.find("id") != nullptr)
    return uploaded(fields, type, find);
  if (type == "polygon" || is_geojson_type(type)) return read_polygon(value, pointer);
  if (type == "mesh") return read_surface_mesh(value, pointer);
  try {
    if (type == "torus" || type == "box") return rectangle(fields, type == "torus");
    if (type == "sphere") return sphere(fields);
  } catch (const Error& error) {
    throw error.where().starts_with(pointer) && !pointer.empty() ? error : error.within(pointer);
  }
  throw Error(ErrorCode::invalid_parameters,
              "unknown domain; there are: torus, box, sphere, polygon, mesh, and GeoJSON's types",
              fields.pointer_to("type"));
}

nlohmann::ordered_json domain_to_json(const Domain& domain) {
  if (const auto* known = dynamic_cast<const HasId*>(&domain))
    return {{"type", domain.type()}, {"id", known->id()}};
  if (const auto* ball = dynamic_cast<const Sphere*>(&domain))
    return {{"type", ball->type()}, {"radius", ball->radius()}};
  if (const auto* polygon = dynamic_cast<const Polygon*>(&domain)) return polygon_to_json(*polygon);
  if (const auto* mesh = dynamic_cast<const SurfaceMesh*>(&domain)) return surface_mesh_to_json(*mesh);
  const Box box = domain.box();
  nlohmann::ordered_json result = {{"type", domain.type()}, {"width", box.size.x}, {"height", box.size.y}};
  if (!is_torus(domain)) result["periodic"] = {box.periodic[0], box.periodic[1]};
  return result;
}

Request read_request(const RawRequest& raw, const Limits& limits, const References& references) {
  JsonDocument document = read_document(raw, limits);
  SourceReader reader(document, point_limit(raw.operation, limits), references);
  Fields fields(document.root, "");
  Request request;
  if (raw.operation == "mesh") {
    if (!raw.picture.is_null())
      throw Error(ErrorCode::invalid_parameters, "a mesh is no picture; leave this out", "/picture");
    request.operation = mesh_request(fields, reader);
    require_affordable(request, limits);
    return request;
  }
  const json* picture = fields.find("picture");
  request.picture = merged_picture(picture != nullptr ? *picture : json(), raw.picture);
  read_picture(request.picture, "/picture");
  if (makes_points(raw.operation)) request.barycentric = fields.flag("barycentric").value_or(false);
  if (raw.operation == "generate") {
    request.operation = reader.generate(fields);
    if (request.barycentric) require_mesh(*std::get<GenerateRequest>(request.operation).domain);
  } else if (raw.operation == "optimize") {
    request.operation = reader.optimize(fields);
    if (request.barycentric) require_mesh(domain_of(std::get<OptimizeRequest>(request.operation).points));
  } else {
    request.operation = analyze_request(fields, reader, limits);
  }
  require_affordable(request, limits);
  return request;
}

}  // namespace wellspaced

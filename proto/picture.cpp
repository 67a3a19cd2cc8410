#include "proto/picture.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "proto/arguments.h"
#include "proto/fields.h"
#include "proto/find_row.h"
#include "proto/operations.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double largest_scale = 4;
/// Pictures that don't draw every point may have so many times as many.
constexpr double without_points_factor = 10;

Parameter scale_parameter() {
  Parameter p;
  p.name = "scale";
  p.description = "of a PNG, for displays and prints with finer pixels";
  p.unit = "pixels a pixel";
  p.minimum = 0.25;
  p.maximum = largest_scale;
  p.fallback = "1";
  return p;
}

/// What `json` has: its own parameters and those of every picture.
Method with_scale(const Picture& picture) {
  Method method = picture;
  method.parameters.push_back(scale_parameter());
  return method;
}

void require_few(double points, const Picture& picture, const Limits& limits) {
  const double most =
      static_cast<double>(limits.picture_points) * (picture.draws_each_point ? 1 : without_points_factor);
  if (points <= most) return;
  throw Error(ErrorCode::too_large,
              "this picture of about " + number_text(points) + " points is above the limit of " +
                  number_text(most) + "; ask for the points and draw a part of them",
              "/picture");
}

void require_history(bool there, const Picture& picture) {
  if (!picture.needs_history || there) return;
  throw Error(ErrorCode::invalid_parameters,
              picture.name +
                  " shows how an optimizer got on; ask for it with optimize, or analyze points that are "
                  "{\"optimize\": {...}}",
              "/picture");
}

void require_torus(const Domain& domain, const Picture& picture) {
  if (!picture.needs_torus || domain.type() == "torus") return;
  throw Error(
      ErrorCode::invalid_parameters,
      picture.name + " means nothing on a " + std::string(domain.type()) + "; ask for points or voronoi",
      "/picture");
}

bool is_optimized(const PointSource& source) {
  return std::holds_alternative<std::shared_ptr<const OptimizeRequest>>(source.from);
}

std::vector<SweepRecord> history_from(const ordered_json& summary) {
  std::vector<SweepRecord> history;
  if (!summary.contains("history")) return history;
  const auto number = [](const ordered_json& value) { return value.is_number() ? value.get<double>() : NAN; };
  for (const ordered_json& row : summary["history"])
    history.push_back({row[0].get<int>(), number(row[1]), number(row[2]), number(row[3])});
  return history;
}

/// Of the first set of a group.
std::vector<SweepRecord> history_of(const Result& result, std::size_t group) {
  if (result.operation != "analyze") return history_from(result.summary);
  const ordered_json& summary =
      result.summary.contains("compare") ? result.summary["compare"][group] : result.summary;
  return summary.contains("optimized") ? history_from(summary["optimized"][0]) : std::vector<SweepRecord>{};
}

}  // namespace

PictureCall read_picture(const json& value, const std::string& where) {
  PictureCall call;
  if (value.is_null() || value == "") {
    call.picture = &pictures().front();
    return call;
  }
  if (!value.is_string() && !value.is_object())
    throw Error(ErrorCode::invalid_parameters,
                "expected a string, the picture's name, or an object with name and parameters, found " +
                    describe(value),
                where);
  const json asked = value.is_string() ? json{{"name", value}} : value;
  Fields fields(asked, where);
  const std::string name = fields.text("name").value_or(pictures().front().name);
  call.picture = &find_row(pictures(), name, value.is_string() ? where : where + "/name");
  call.arguments = read_arguments(with_scale(*call.picture), fields);
  call.scale = argument(call.arguments, "scale").value_or(1);
  call.arguments.erase("scale");
  return call;
}

bool is_picture_parameter(std::string_view name) { return name == "picture" || name.starts_with("picture."); }

json picture_of_query(const std::vector<std::pair<std::string, std::string>>& query) {
  json picture;
  for (const auto& [key, text] : query) {
    if (!is_picture_parameter(key)) continue;
    const std::string name = key == "picture" ? "name" : key.substr(sizeof "picture." - 1);
    if (picture.contains(name))
      throw Error(ErrorCode::invalid_parameters, "given twice; give it once", pointer_token(key));
    if (text.empty())
      throw Error(ErrorCode::invalid_parameters, "it is empty; give a value or leave it out",
                  pointer_token(key));
    const json value = json::parse(text, nullptr, false);
    picture[name] = value.is_number() && name != "name" ? value : json(text);
  }
  // A name alone is the short form, and errors then point to it.
  return picture.is_object() && picture.size() == 1 && picture.contains("name") ? picture["name"] : picture;
}

void require_drawable(const Request& request, const PictureCall& call, const Limits& limits) {
  require_few(std::round(expected_points(request)), *call.picture, limits);
  if (const auto* analyze = std::get_if<AnalyzeRequest>(&request.operation)) {
    for (const SourceGroup& group : analyze->groups) {
      require_history(is_optimized(group.sets.front()), *call.picture);
      require_torus(domain_of(group.sets.front()), *call.picture);
    }
    return;
  }
  require_history(std::holds_alternative<OptimizeRequest>(request.operation), *call.picture);
}

Drawing draw_result(const Result& result, const PictureCall& call, const Limits& limits,
                    const Control& control) {
  std::vector<PictureGroup> groups;
  for (const ResultGroup& group : result.groups) {
    groups.push_back({group.label, group.sets, history_of(result, groups.size()), group.sizing.sizing.get()});
    require_few(static_cast<double>(group.sets.front().size()), *call.picture, limits);
    require_history(!groups.back().history.empty(), *call.picture);
    require_torus(*group.sets.front().domain, *call.picture);
  }
  return call.picture->make(groups, call.arguments, control);
}

ordered_json picture_schema() {
  ordered_json names = ordered_json::array(), choices = ordered_json::array();
  for (const Picture& picture : pictures()) names.push_back(picture.name);
  choices.push_back({{"type", "string"}, {"enum", names}});
  for (const Picture& picture : pictures()) {
    ordered_json properties = {{"name", {{"type", "string"}, {"enum", {picture.name}}}}};
    for (const Parameter& p : with_scale(picture).parameters) properties[p.name] = parameter_schema(p);
    choices.push_back({{"type", "object"},
                       {"title", picture.title},
                       {"description", picture.description},
                       {"properties", std::move(properties)},
                       {"required", {"name"}},
                       {"additionalProperties", false}});
  }
  return {{"description", "what an SVG or PNG answer shows: a name, or an object with its parameters"},
          {"oneOf", choices},
          {"default", names.front()}};
}

}  // namespace wellspaced

#include "proto/picture.h"

#include <algorithm>
#include <cmath>
#include <string>

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

/// What a picture is made of: the largest set, all sets together, and the most elongated domain.
struct Subject {
  double n = 0, total = 0, aspect = 1;

  void add(double points, const Domain& domain) {
    const Vec3 sides = domain.box().size;
    n = std::max(n, points);
    total += points;
    aspect = std::max({aspect, sides.x / sides.y, sides.y / sides.x});
  }
};

[[noreturn]] void refuse_size(const std::string& what, double limit, const std::string& way_out,
                              const std::string& where) {
  throw Error(
      ErrorCode::too_large,
      "this picture of about " + what + " is above the limit of " + number_text(limit) + "; " + way_out,
      where);
}

void require_size(const Subject& subject, const PictureCall& call, const Limits& limits) {
  const auto drawn = static_cast<double>(limits.picture_points);
  if (call.picture->draws_each_point && subject.n > drawn)
    refuse_size(number_text(std::round(subject.n)) + " points", drawn,
                "ask for the points and draw a part of them", "/picture");
  if (subject.total > without_points_factor * drawn)
    refuse_size(number_text(std::round(subject.total)) + " points", without_points_factor * drawn,
                "ask for fewer points or sets", "/picture");
  if (call.picture->bytes == nullptr) return;
  const double mebibytes = std::ceil(call.picture->bytes(subject.n, subject.aspect, call.arguments) / 0x1p20),
               limit = std::floor(static_cast<double>(limits.memory_bytes) / 0x1p20);
  if (mebibytes > limit)
    refuse_size(number_text(std::min(mebibytes, 1e15)) + " MiB", limit,
                "ask for a smaller range, or fewer points", "/picture/range");
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
  if (value.is_null() || (value.is_string() && value.get_ref<const std::string&>().empty())) {
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
  Subject subject;
  if (const auto* analyze = std::get_if<AnalyzeRequest>(&request.operation)) {
    for (const SourceGroup& group : analyze->groups) {
      require_history(is_optimized(group.sets.front()), *call.picture);
      require_torus(domain_of(group.sets.front()), *call.picture);
      for (const PointSource& set : group.sets) subject.add(expected_points(set), domain_of(set));
    }
  } else {
    const auto* optimize = std::get_if<OptimizeRequest>(&request.operation);
    require_history(optimize != nullptr, *call.picture);
    const Domain& domain = optimize != nullptr ? domain_of(optimize->points)
                                               : *std::get<GenerateRequest>(request.operation).domain;
    require_torus(domain, *call.picture);
    subject.add(expected_points(request), domain);
  }
  require_size(subject, call, limits);
}

Drawing draw_result(const Result& result, const PictureCall& call, const Limits& limits,
                    const Control& control) {
  std::vector<PictureGroup> groups;
  Subject subject;
  for (const ResultGroup& group : result.groups) {
    groups.push_back({group.label, group.sets, history_of(result, groups.size()), group.sizing.sizing.get()});
    for (const PointSet& set : group.sets) subject.add(static_cast<double>(set.size()), *set.domain);
    require_history(!groups.back().history.empty(), *call.picture);
    require_torus(*group.sets.front().domain, *call.picture);
  }
  require_size(subject, call, limits);
  try {
    return call.picture->make(groups, call.arguments, control);
  } catch (const Error& error) {
    const auto named = [&](const Parameter& p) { return error.where() == "/" + p.name; };
    const auto& parameters = call.picture->parameters;
    if (std::none_of(parameters.begin(), parameters.end(), named)) throw;
    throw error.within("/picture");
  }
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

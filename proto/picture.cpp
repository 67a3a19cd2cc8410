#include "proto/picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/domain/torus.h"
#include "core/error.h"
#include "proto/arguments.h"
#include "proto/fields.h"
#include "proto/find_row.h"
#include "proto/operations.h"
#include "proto/picture_pixels.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Pictures that don't draw every point may have so many times as many.
constexpr double without_points_factor = 10;

Parameter scale_parameter() {
  Parameter p;
  p.name = "scale";
  p.description = "of a PNG, for displays and prints with finer pixels";
  p.unit = "pixels a pixel";
  p.minimum = least_scale;
  p.maximum = most_scale;
  p.fallback = "1";
  return p;
}

/// What `json` has: its own parameters and those of every picture.
Method with_scale(const Picture& picture) {
  Method method = picture;
  method.parameters.push_back(scale_parameter());
  return method;
}

/// What a picture is made of, group by group.
class Subject {
 public:
  void begin_group() {
    groups_.emplace_back();
    groups_.back().sets = 0;
    for (SetsSize& group : groups_) group.alone = groups_.size() == 1;
  }
  void add(double points, const Domain& domain) {
    SetsSize& group = groups_.back();
    group.n = std::max(group.n, points);
    group.sets += 1;
    group.take_shape_of(domain);
  }

  std::span<const SetsSize> groups() const { return groups_; }
  double largest() const {
    double n = 0;
    for (const SetsSize& group : groups_) n = std::max(n, group.n);
    return n;
  }
  /// Points of all sets that the picture looks at.
  double total(const Picture& picture) const {
    if (picture.needs_history) return 0;
    double sum = 0;
    for (const SetsSize& group : groups_) sum += group.n * (picture.averages ? group.sets : 1);
    return sum;
  }
  Cost cost(const PictureCall& call) const {
    Cost sum;
    for (const SetsSize& group : groups_) {
      const Cost one = call.picture->cost(group, call.arguments);
      sum = {sum.seconds + one.seconds, std::max(sum.bytes, one.bytes)};
    }
    return sum;
  }

 private:
  std::vector<SetsSize> groups_;
};

/// The first parameter whose default makes the picture affordable, or the picture itself.
std::string culprit(const Subject& subject, const PictureCall& call, const Limits& limits) {
  for (const Parameter& p : call.picture->parameters) {
    if (argument(call.arguments, p.name).value_or(0) == 0) continue;
    PictureCall smaller = call;
    smaller.arguments.erase(p.name);
    const Cost cost = subject.cost(smaller);
    if (cost.seconds <= limits.picture_seconds && cost.bytes <= static_cast<double>(limits.memory_bytes))
      return "/picture/" + p.name;
  }
  return "/picture";
}

void require_points(double points, double limit, const std::string& way_out) {
  if (points <= limit) return;
  throw Error(ErrorCode::too_large,
              "this picture of about " + number_text(std::round(points)) + " points is above the limit of " +
                  number_text(limit) + "; " + way_out,
              "/picture");
}

void require_size(const Subject& subject, const PictureCall& call, const Limits& limits) {
  const auto drawn = static_cast<double>(limits.picture_points);
  if (call.picture->draws_each_point)
    require_points(subject.largest(), drawn, "ask for the points and draw a part of them");
  require_points(subject.total(*call.picture), without_points_factor * drawn, "ask for fewer points or sets");
  if (call.format == Format::png) require_pixels(call, subject.groups());
  const Cost cost = subject.cost(call);
  const auto memory = static_cast<double>(limits.memory_bytes);
  if (cost.seconds <= limits.picture_seconds && cost.bytes <= memory) return;
  const bool slow = cost.seconds > limits.picture_seconds;
  const auto text = [](double x) {
    return x > 1e6 ? std::string("more than a million") : number_text(std::ceil(x));
  };
  throw Error(ErrorCode::too_large,
              "to draw this picture may take about " +
                  (slow ? text(cost.seconds) + " s" : text(cost.bytes / 0x1p20) + " MiB") +
                  ", and the limit here is " +
                  (slow ? number_text(limits.picture_seconds) + " s" : text(memory / 0x1p20) + " MiB") +
                  "; ask for less of it, or of fewer points or sets",
              culprit(subject, call, limits));
}

/// What is known of a picture of these points before the work.
void require_possible(const PictureCall& call, const Domain& domain, double n) {
  if (call.picture->needs_torus && !is_torus(domain))
    throw Error(ErrorCode::invalid_parameters,
                call.picture->name + " is drawn of points on a torus only, not on a " +
                    std::string(domain.type()) +
                    "; ask for voronoi, delaunay, points, distributions or convergence, or for json",
                "/picture");
  if (call.picture->check == nullptr) return;
  try {
    call.picture->check(domain, n, call.arguments);
  } catch (const Error& error) {
    throw error.within("/picture");
  }
}

void require_history(bool there, const Picture& picture) {
  if (!picture.needs_history || there) return;
  throw Error(ErrorCode::invalid_parameters,
              picture.name +
                  " shows how an optimizer got on; ask for it with optimize, of a kept job by GET "
                  "/v1/jobs/ID/result?picture=convergence, or analyze points that are {\"optimize\": {...}}",
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

/// Of the first optimized set of a group.
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
  fields.require("name", "a picture, one of: " + names_of(pictures()));
  call.picture = &find_row(pictures(), *fields.text("name"), value.is_string() ? where : where + "/name");
  call.arguments = read_arguments(with_scale(*call.picture), fields);
  call.scale = argument(call.arguments, "scale").value_or(1);
  call.arguments.erase("scale");
  return call;
}

json merged_picture(const json& own, const json& query) {
  if (query.is_null()) return own;
  if (query.is_string() || query.contains("name")) return query;
  json merged = own.is_object()
                    ? own
                    : json{{"name", own.is_string() && own != "" ? own : json(pictures().front().name)}};
  merged.update(query);
  return merged;
}

void require_drawable(const Request& request, const PictureCall& call, const Limits& limits) {
  Subject subject;
  if (const auto* analyze = std::get_if<AnalyzeRequest>(&request.operation)) {
    for (const SourceGroup& group : analyze->groups) {
      require_history(is_optimized(group.sets.front()), *call.picture);
      require_possible(call, domain_of(group.sets.front()), expected_points(group.sets.front()));
      subject.begin_group();
      for (const PointSource& set : group.sets) subject.add(expected_points(set), domain_of(set));
    }
  } else {
    const auto* optimize = std::get_if<OptimizeRequest>(&request.operation);
    require_history(optimize != nullptr, *call.picture);
    const Domain& domain = optimize != nullptr ? domain_of(optimize->points)
                                               : *std::get<GenerateRequest>(request.operation).domain;
    require_possible(call, domain, expected_points(request));
    subject.begin_group();
    subject.add(expected_points(request), domain);
  }
  require_size(subject, call, limits);
}

Drawing draw_result(const Result& result, const PictureCall& call, const Limits& limits,
                    const Control& control) {
  std::vector<PictureGroup> groups;
  Subject subject;
  for (const ResultGroup& group : result.groups) {
    groups.push_back(
        {group.label, group.sets, history_of(result, groups.size()), group.sets.front().sizing.get()});
    subject.begin_group();
    for (const PointSet& set : group.sets) subject.add(static_cast<double>(set.size()), *set.domain);
    require_history(!groups.back().history.empty(), *call.picture);
    require_possible(call, *group.sets.front().domain, static_cast<double>(group.sets.front().size()));
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

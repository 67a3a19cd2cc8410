#include <algorithm>
#include <cmath>
#include <optional>

#include "core/domain/surface_mesh.h"
#include "core/domain/torus.h"
#include "core/generate/enrich.h"
#include "core/generate/generate.h"
#include "proto/arguments.h"
#include "proto/fields.h"
#include "proto/request.h"

namespace wellspaced {
namespace {

Cost times(double n, Cost cost) { return {n * cost.seconds, n * cost.bytes}; }
/// One after the other: what the first one needed is free again.
Cost operator+(Cost a, Cost b) { return {a.seconds + b.seconds, std::max(a.bytes, b.bytes)}; }

constexpr Cost writing = {3e-7, 200};    // a point of the result, as text at worst
constexpr Cost enriching = {8e-6, 300};  // a point that there is in the end
constexpr double bytes_kept = 16;        // a point that waits for others

double expected(const GenerateRequest& request) {
  return request.method->expected_count(setting_of(request), request.arguments);
}

double expected(const OptimizeRequest& request) {
  const double n = expected_points(request.points);
  if (!request.enrich) return n;
  const Domain& domain = domain_of(request.points);
  return n + most_inserted(domain, radius_for_count(domain, std::max(1.0, n)));
}

/// On a mesh of many faces each of a few points looks over most of the surface for room beside it.
double seconds_of_faces(const GenerateRequest& request, double n) {
  const auto* const mesh = dynamic_cast<const SurfaceMesh*>(request.domain.get());
  if (mesh == nullptr || !takes_radius(*request.method)) return 0;
  return static_cast<double>(mesh->mesh().faces().size()) * std::min(1e-3, 0.02 / std::max(n, 1.0));
}

Cost cost_of(const GenerateRequest& request) {
  const bool torus = is_torus(*request.domain) && request.sizing == nullptr;
  const double n = expected(request);
  Cost cost = times(n, torus ? request.method->cost_a_point : request.method->cost_elsewhere);
  cost.seconds += seconds_of_faces(request, n);
  return cost;
}

Cost cost_of_optimizing(const OptimizeRequest& request) {
  Cost cost = request.method->cost_a_point(request.arguments);
  if (!is_torus(domain_of(request.points)) || is_sized(request))
    cost.seconds *= request.method->times_elsewhere;
  return cost;
}

Cost cost_of(const PointSource& source);

Cost cost_of(const OptimizeRequest& request) {
  const double n = expected(request);
  return cost_of(request.points) + times(request.enrich ? n : 0, enriching) +
         times(n, cost_of_optimizing(request));
}

Cost cost_of(const PointSource& source) {
  if (const auto* generated = std::get_if<GenerateRequest>(&source.from)) return cost_of(*generated);
  if (const auto* optimized = std::get_if<std::shared_ptr<const OptimizeRequest>>(&source.from))
    return cost_of(**optimized);
  return times(expected_points(source), {0, 32});
}

SetsSize size_of(const SourceGroup& group) {
  SetsSize size;
  for (const PointSource& set : group.sets) size.n = std::max(size.n, expected_points(set));
  size.sets = static_cast<double>(group.sets.size());
  size.take_shape_of(domain_of(group.sets.front()));
  return size;
}

/// While a measure is made, and afterwards.
Cost with_kept(const MeasureCall& call, const SetsSize& size) {
  Cost cost = call.measure->cost(size, call.arguments);
  if (call.measure->kept_bytes != nullptr) cost.bytes += call.measure->kept_bytes(size, call.arguments);
  return cost;
}

/// What points take while something is measured.
double waiting_bytes(const AnalyzeRequest& request) {
  double bytes = 0;
  for (const SourceGroup& group : request.groups)
    for (const PointSource& set : group.sets) bytes += bytes_kept * expected_points(set);
  return bytes;
}

Cost cost_of(const AnalyzeRequest& request) {
  Cost cost;
  double kept = waiting_bytes(request);
  for (const SourceGroup& group : request.groups) {
    for (const PointSource& set : group.sets) cost = cost + cost_of(set);
    for (const MeasureCall& call : request.measures) {
      const SetsSize size = size_of(group);
      const Cost own = call.measure->cost(size, call.arguments);
      cost = cost + own;
      kept += with_kept(call, size).bytes - own.bytes;
    }
  }
  return {cost.seconds, cost.bytes + kept};
}

Cost cost_of(const MeshRequest& request) {
  const double n = expected_points(request.points);
  const bool torus = is_torus(domain_of(request.points));
  return cost_of(request.points) +
         times(n, torus ? request.method->cost_a_point : request.method->cost_elsewhere);
}

std::string mebibytes(double bytes) {
  return bytes < 0x1p70 ? std::to_string(static_cast<std::uint64_t>(bytes / 0x1p20)) + " MiB"
                        : "countless bytes";
}

MeasureCall with_argument(const MeasureCall& call, const Parameter& p, double value) {
  MeasureCall changed = call;
  changed.arguments[p.name] = value;
  return changed;
}

/// Whether the measure takes that value of a parameter, as far as it can be told before the work.
bool takes(const MeasureCall& call, const Parameter& p, double value, const SourceGroup& group) {
  if (call.measure->check == nullptr) return true;
  try {
    call.measure->check(domain_of(group.sets.front()), size_of(group).n,
                        with_argument(call, p, value).arguments);
  } catch (const Error& error) {
    return error.where() != "/" + p.name;
  }
  return true;
}

/// About the largest value of a parameter with which the measure keeps to the memory, and which it takes;
/// nothing if there is none.
std::optional<double> most_affordable(const MeasureCall& call, const Parameter& p, const SourceGroup& group,
                                      double memory_bytes) {
  const SetsSize size = size_of(group);
  const auto fits = [&](double value) {
    return with_kept(with_argument(call, p, value), size).bytes <= memory_bytes;
  };
  if (p.type == Parameter::Type::choice || !fits(p.minimum)) return std::nullopt;
  double low = p.minimum, high = argument(call.arguments, p.name).value_or(p.maximum);
  for (int step = 0; step < 60; ++step) ((fits((low + high) / 2)) ? low : high) = (low + high) / 2;
  if (p.type != Parameter::Type::integer) return std::floor(low * 100) / 100;
  double value = std::floor(low);
  while (value > p.minimum && !takes(call, p, value, group)) --value;
  return takes(call, p, value, group) ? std::optional(value) : std::nullopt;
}

/// A measure that asks for too much by its parameters is to blame before the points are.
void require_affordable_measures(const AnalyzeRequest& request, const Limits& limits) {
  const auto limit = static_cast<double>(limits.memory_bytes);
  const double waiting = waiting_bytes(request);
  for (const SourceGroup& group : request.groups)
    for (const MeasureCall& call : request.measures) {
      const double bytes = with_kept(call, size_of(group)).bytes + waiting;
      if (bytes <= limit) continue;
      for (const Parameter& p : call.measure->parameters) {
        const std::optional<double> most = most_affordable(call, p, group, limit - waiting);
        if (!most) continue;
        throw Error(ErrorCode::too_large,
                    call.measure->name + " of so many points would need about " + mebibytes(bytes) +
                        ", but the limit here is " + mebibytes(limit) + "; ask for a " + p.name +
                        " of at most " + number_text(*most),
                    call.pointer + "/" + p.name);
      }
    }
}

}  // namespace

bool is_sized(const PointSource& source) {
  if (const auto* generated = std::get_if<GenerateRequest>(&source.from)) return generated->sizing != nullptr;
  if (const auto* optimized = std::get_if<std::shared_ptr<const OptimizeRequest>>(&source.from))
    return is_sized(**optimized);
  return std::get<PointSet>(source.from).sizing != nullptr;
}

bool is_sized(const OptimizeRequest& request) {
  return request.sizing != nullptr || is_sized(request.points);
}

std::string size_field(const Request& request) {
  if (const auto* generate = std::get_if<GenerateRequest>(&request.operation))
    return argument(generate->arguments, "count") ? "/count" : "/radius";
  if (const auto* analyze = std::get_if<AnalyzeRequest>(&request.operation)) {
    const auto fewer = [](const SourceGroup& a, const SourceGroup& b) { return size_of(a).n < size_of(b).n; };
    return std::max_element(analyze->groups.begin(), analyze->groups.end(), fewer)->pointer;
  }
  return "/points";
}

double expected_points(const PointSource& source) {
  if (const auto* generated = std::get_if<GenerateRequest>(&source.from)) return expected(*generated);
  if (const auto* optimized = std::get_if<std::shared_ptr<const OptimizeRequest>>(&source.from))
    return expected(**optimized);
  return static_cast<double>(std::get<PointSet>(source.from).size());
}

double expected_points(const Request& request) {
  if (const auto* optimize = std::get_if<OptimizeRequest>(&request.operation)) return expected(*optimize);
  if (const auto* generate = std::get_if<GenerateRequest>(&request.operation)) return expected(*generate);
  if (const auto* mesh = std::get_if<MeshRequest>(&request.operation)) return expected_points(mesh->points);
  double most = 0;
  for (const SourceGroup& group : std::get<AnalyzeRequest>(request.operation).groups)
    most = std::max(most, size_of(group).n);
  return most;
}

const Domain& domain_of(const PointSource& source) {
  if (const auto* generated = std::get_if<GenerateRequest>(&source.from)) return *generated->domain;
  if (const auto* optimized = std::get_if<std::shared_ptr<const OptimizeRequest>>(&source.from))
    return domain_of((*optimized)->points);
  return *std::get<PointSet>(source.from).domain;
}

Cost expected_cost(const Request& request) {
  if (const auto* analyze = std::get_if<AnalyzeRequest>(&request.operation)) return cost_of(*analyze);
  if (const auto* mesh = std::get_if<MeshRequest>(&request.operation)) return cost_of(*mesh);
  const Cost written = times(expected_points(request), writing);
  if (const auto* optimize = std::get_if<OptimizeRequest>(&request.operation))
    return cost_of(*optimize) + written;
  return cost_of(std::get<GenerateRequest>(request.operation)) + written;
}

void require_affordable(const Request& request, const Limits& limits) {
  if (const auto* analyze = std::get_if<AnalyzeRequest>(&request.operation))
    require_affordable_measures(*analyze, limits);
  const double bytes = expected_cost(request).bytes;
  if (bytes <= static_cast<double>(limits.memory_bytes)) return;
  throw Error(ErrorCode::too_large,
              "the job would need about " + mebibytes(bytes) + " of memory, but the limit here is " +
                  mebibytes(static_cast<double>(limits.memory_bytes)) + "; ask for fewer points",
              size_field(request));
}

}  // namespace wellspaced

#include "proto/execute.h"

#include <cmath>
#include <optional>
#include <utility>

#include "core/analyze/certificate.h"
#include "core/analyze/spacing.h"
#include "core/generate/enrich.h"
#include "core/generate/generate.h"
#include "proto/measures.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

/// Passes a part [from, to] of a larger piece of work on to its control.
class Part final : public Control {
 public:
  Part(Control& whole, double from, double to)
      : Control(whole.threads(), &whole), whole_(whole), from_(from), to_(to) {}

 private:
  void on_progress(const Progress& p) override {
    Progress shifted = p;
    shifted.fraction = from_ + p.fraction * (to_ - from_);
    whole_.report(shifted);
  }

  Control& whole_;
  double from_, to_;
};

/// Runs `work`; its errors get `prefix` in front of their pointers.
template <class Work>
auto at(const std::string& prefix, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw error.within(prefix);
  }
}

PointSet generate(const GenerateRequest& request, Control& control, const std::string& where) {
  Rng rng(request.seed);
  return at(where, [&] { return request.method->run(request.domain, request.arguments, rng, control); });
}

/// Where a request says how many points it wants.
std::string density_pointer(const GenerateRequest& request) {
  return request.arguments.count("radius") != 0 ? "/radius" : "/count";
}

/// For work that needs three points at least. How many a radius gives is known only now.
PointSet points_of(const PointSource& source, Control& control) {
  if (const auto* points = std::get_if<PointSet>(&source)) return *points;
  const auto& request = std::get<GenerateRequest>(source);
  PointSet points = generate(request, control, "/points/generate");
  if (points.size() < 3)
    throw Error(ErrorCode::degenerate_input,
                "this gives " + std::to_string(points.size()) +
                    " points, but at least 3 are needed here; ask for more of them, that is a smaller radius",
                "/points/generate" + density_pointer(request));
  return points;
}

ordered_json argument_to_json(const Parameter& p, double value) {
  if (p.type == Parameter::Type::choice) return p.choices.at(static_cast<std::size_t>(value));
  return p.type == Parameter::Type::integer ? ordered_json(static_cast<std::int64_t>(value))
                                            : ordered_json(value);
}

ordered_json parameters_to_json(const Method& method, const Arguments& arguments) {
  ordered_json out = ordered_json::object();
  for (const Parameter& p : method.parameters)
    if (const auto value = argument(arguments, p.name)) out[p.name] = argument_to_json(p, *value);
  return out;
}

void add_origin(ordered_json& summary, const GenerateRequest& request) {
  if (request.method->random) summary["seed"] = request.seed;
}

void add_end(ordered_json& summary, const PointSet& points) {
  summary["version"] = version();
  summary["domain"] = domain_to_json(*points.domain);
}

Result run(const GenerateRequest& request, Control& control) {
  Result result{"generate", {}, generate(request, control, ""), ""};
  result.summary = {{"n", result.points.size()},
                    {"method", request.method->name},
                    {"parameters", parameters_to_json(*request.method, request.arguments)}};
  add_origin(result.summary, request);
  add_end(result.summary, result.points);
  return result;
}

ordered_json history_to_json(const std::vector<SweepRecord>& history) {
  ordered_json rows = ordered_json::array();
  for (const SweepRecord& s : history) rows.push_back({s.sweep, s.beta, s.r_c, s.r_f});
  return rows;
}

/// What a method has against the points as a whole is said at /points.
OptimizeResult optimize(const OptimizeRequest& request, const PointSet& input, Control& control) {
  try {
    return request.method->run(input, request.arguments, control);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::degenerate_input || !error.where().empty()) throw;
    throw error.within("/points");
  }
}

/// A target for beta counts as reached when that is proven.
ordered_json converged(const OptimizeResult& result, const Arguments& arguments,
                       const std::optional<Certificate>& proof) {
  if (!result.converged) return {};
  const auto target = argument(arguments, "beta");
  return *result.converged && (!target || (proof && proof->beta_upper <= *target));
}

/// What the optimizer starts from, and how many points were inserted for that.
std::pair<PointSet, std::size_t> input_of(const OptimizeRequest& request, Control& control) {
  Part first(control, 0, 0.5), second(control, 0.5, 1);
  PointSet points = points_of(request.points, first);
  return at("/points", [&] {
    require_usable(points, control);
    if (!request.enrich) return std::pair(std::move(points), std::size_t{0});
    PointSet enriched = enrich(points, enrichment_coverage(points, control), second);
    const std::size_t inserted = enriched.size() - points.size();
    return std::pair(std::move(enriched), inserted);
  });
}

Result run(const OptimizeRequest& request, Control& control) {
  Part first(control, 0, 0.02), second(control, 0.02, 0.98);
  const auto [input, inserted] = input_of(request, first);
  OptimizeResult optimized = optimize(request, input, second);
  const Spacing s = measure_spacing(optimized.points, control);
  const std::optional<Certificate> proof = certify(optimized.points, control);
  Result result{"optimize", {}, std::move(optimized.points), ""};
  result.summary = {{"n", s.n},
                    {"method", request.method->name},
                    {"parameters", parameters_to_json(*request.method, request.arguments)},
                    {"beta", s.beta},
                    {"r_f", s.r_f},
                    {"r_c", s.r_c},
                    {"rho", s.rho},
                    {"beta_i_max", s.beta_i_max},
                    {"beta_i_mean", s.beta_i_mean},
                    {"sweeps", optimized.sweeps}};
  if (request.enrich) result.summary["enriched"] = inserted;
  result.summary.update(certificate_to_json(proof));
  result.summary["converged"] = converged(optimized, request.arguments, proof);
  result.summary["history"] = history_to_json(optimized.history);
  if (const auto* generated = std::get_if<GenerateRequest>(&request.points))
    add_origin(result.summary, *generated);
  add_end(result.summary, result.points);
  return result;
}

Result run(const AnalyzeRequest& request, Control& control) {
  Part first(control, 0, 0.5), second(control, 0.5, 1);
  Result result{"analyze", {}, points_of(request.points, first), ""};
  result.summary = {{"n", result.points.size()}};
  for (const Measure* measure : request.measures)
    result.summary[measure->name] = at("/points", [&] { return measure->run(result.points, second); });
  if (const auto* generated = std::get_if<GenerateRequest>(&request.points))
    add_origin(result.summary, *generated);
  add_end(result.summary, result.points);
  return result;
}

}  // namespace

Result execute(const Request& request, Control& control) {
  Result result =
      std::visit([&](const auto& operation) { return run(operation, control); }, request.operation);
  result.picture = request.picture;
  control.report({1});
  return result;
}

}  // namespace wellspaced

#include "proto/execute.h"

#include <cmath>
#include <optional>
#include <utility>

#include "core/analyze/certificate.h"
#include "core/analyze/domain_certificate.h"
#include "core/analyze/spacing.h"
#include "core/generate/enrich.h"
#include "core/generate/generate.h"
#include "proto/measures/measures.h"
#include "proto/mesh_result.h"

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

/// What a source gave, and, if it came out of an optimizer, what that had to say.
struct Made {
  PointSet points;
  ordered_json optimized;
};

Made make(const PointSource& source, Control& control);

PointSet generate(const GenerateRequest& request, Control& control) {
  Rng rng(request.seed);
  return at(request.pointer,
            [&] { return request.method->run(setting_of(request), request.arguments, rng, control); });
}

/// For work that needs three points at least. How many a radius gives is known only now.
PointSet generate_three(const GenerateRequest& request, Control& control) {
  PointSet points = generate(request, control);
  if (points.size() < 3)
    throw Error(ErrorCode::degenerate_input,
                "this gives " + std::to_string(points.size()) +
                    " points, but at least 3 are needed here; ask for more of them, that is a smaller radius",
                density_pointer(request));
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

void add_sizing(ordered_json& summary, const PointSet& points) {
  if (points.sizing != nullptr) summary["sizing"] = sizing_in_result(*points.sizing);
}

void add_end(ordered_json& summary, const PointSet& points) {
  summary["version"] = version();
  summary["domain"] = domain_to_json(*points.domain);
}

/// The seed that a set came from, if there was one.
std::optional<std::uint64_t> seed_of(const PointSource& source) {
  if (const auto* generated = std::get_if<GenerateRequest>(&source.from))
    return generated->method->random ? std::optional(generated->seed) : std::nullopt;
  if (const auto* optimized = std::get_if<std::shared_ptr<const OptimizeRequest>>(&source.from))
    return seed_of((*optimized)->points);
  return std::nullopt;
}

void add_seed(ordered_json& summary, const PointSource& source) {
  if (const auto seed = seed_of(source)) summary["seed"] = *seed;
}

Result run(const GenerateRequest& request, Control& control) {
  PointSet points = generate(request, control);
  ordered_json summary = {{"n", points.size()},
                          {"method", request.method->name},
                          {"parameters", parameters_to_json(*request.method, request.arguments)}};
  if (request.method->random) summary["seed"] = request.seed;
  add_sizing(summary, points);
  add_end(summary, points);
  return {"generate", std::move(summary), one_group(std::move(points)), {}};
}

ordered_json history_to_json(const std::vector<SweepRecord>& history) {
  ordered_json rows = ordered_json::array();
  for (const SweepRecord& s : history) rows.push_back({s.sweep, s.beta, s.r_c, s.r_f});
  return rows;
}

/// What a method has against the points as a whole is said at the points.
OptimizeResult optimize(const OptimizeRequest& request, const PointSet& input, Control& control) {
  try {
    return request.method->run(input, request.arguments, control);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::degenerate_input && error.where().empty())
      throw error.within(request.points.pointer);
    throw error.within(request.pointer);
  }
}

/// A target for beta counts as reached when that is proven.
ordered_json converged(const OptimizeResult& result, const Arguments& arguments,
                       const std::optional<Certificate>& proof) {
  if (!result.converged) return {};
  if (!can_be_certified(result.points)) return *result.converged;
  const auto target = argument(arguments, "beta");
  return *result.converged && (!target || (proof && proof->beta_upper <= *target));
}

/// What the optimizer starts from, and how many points were inserted for that.
std::pair<PointSet, std::size_t> input_of(const OptimizeRequest& request, Control& control) {
  Part first(control, 0, 0.5), second(control, 0.5, 1);
  PointSet points = make(request.points, first).points;
  if (request.sizing != nullptr) points.sizing = request.sizing;
  return at(request.points.pointer, [&] {
    require_usable(points, control);
    if (!request.enrich) return std::pair(std::move(points), std::size_t{0});
    PointSet enriched = enrich(points, enrichment_coverage(points, control), second);
    const std::size_t inserted = enriched.size() - points.size();
    return std::pair(std::move(enriched), inserted);
  });
}

/// The optimized points, and all there is to say of them but version and domain.
Made optimize(const OptimizeRequest& request, Control& control) {
  Part first(control, 0, 0.02), second(control, 0.02, 0.98);
  const auto [input, inserted] = input_of(request, first);
  OptimizeResult optimized = optimize(request, input, second);
  const Spacing s = measure_spacing(optimized.points, control);
  const std::optional<Certificate> proof = certify(optimized.points, control);
  ordered_json summary = {{"n", s.n},
                          {"method", request.method->name},
                          {"parameters", parameters_to_json(*request.method, request.arguments)},
                          {"beta", s.beta},
                          {"r_f", s.r_f},
                          {"r_f_free", s.r_f_free},
                          {"r_c", s.r_c},
                          {"rho", s.rho},
                          {"beta_i_max", s.beta_i_max},
                          {"beta_i_mean", s.beta_i_mean},
                          {"sweeps", optimized.sweeps}};
  if (request.enrich) summary["enriched"] = inserted;
  summary.update(certificate_to_json(proof));
  summary["converged"] = converged(optimized, request.arguments, proof);
  summary["history"] = history_to_json(optimized.history);
  add_sizing(summary, optimized.points);
  add_seed(summary, request.points);
  return {std::move(optimized.points), std::move(summary)};
}

Result run(const OptimizeRequest& request, Control& control) {
  Made made = optimize(request, control);
  add_end(made.optimized, made.points);
  return {"optimize", std::move(made.optimized), one_group(std::move(made.points)), {}};
}

Made make(const PointSource& source, Control& control) {
  if (const auto* generated = std::get_if<GenerateRequest>(&source.from))
    return {generate_three(*generated, control), {}};
  if (const auto* optimized = std::get_if<std::shared_ptr<const OptimizeRequest>>(&source.from))
    return optimize(**optimized, control);
  return {std::get<PointSet>(source.from), {}};
}

/// Bad parameters are said where they were given, what the points are to blame for at the points.
ordered_json measure(const MeasureCall& call, const SourceGroup& group, std::span<const PointSet> sets,
                     const Control& control) {
  try {
    return call.measure->run({sets, sets.front().sizing.get()}, call.arguments, control);
  } catch (const Error& error) {
    throw error.within(error.where().empty() ? group.pointer : call.pointer);
  }
}

/// The sets of a group, and what each came out of.
std::pair<ResultGroup, ordered_json> make_group(const SourceGroup& group, Control& control) {
  ResultGroup made{group.label, {}};
  ordered_json optimized = ordered_json::array();
  const auto count = static_cast<double>(group.sets.size());
  for (const PointSource& source : group.sets) {
    const auto done = static_cast<double>(made.sets.size());
    Part part(control, done / count, (done + 1) / count);
    Made set = make(source, part);
    at(source.pointer, [&] { require_usable(set.points, control); });
    if (!made.sets.empty())
      require_same_size(static_cast<double>(made.sets.front().size()), static_cast<double>(set.points.size()),
                        source.pointer);
    if (group.sizing != nullptr) set.points.sizing = group.sizing;
    if (!set.optimized.is_null()) optimized.push_back(std::move(set.optimized));
    made.sets.push_back(std::move(set.points));
  }
  return {std::move(made), std::move(optimized)};
}

/// Makes and measures one group, and adds what there is to say of it.
ResultGroup analyze(const AnalyzeRequest& request, const SourceGroup& group, Control& control,
                    ordered_json& summary) {
  Part first(control, 0, 0.5), second(control, 0.5, 1);
  auto [made, optimized] = make_group(group, first);
  summary["n"] = made.sets.front().size();
  if (made.sets.size() > 1) summary["sets"] = made.sets.size();
  add_sizing(summary, made.sets.front());
  for (const MeasureCall& call : request.measures)
    summary[call.measure->name] = measure(call, group, made.sets, second);
  if (!optimized.empty()) summary["optimized"] = std::move(optimized);
  add_seed(summary, group.sets.front());
  return std::move(made);
}

Result run(const AnalyzeRequest& request, Control& control) {
  Result result{"analyze", ordered_json::object(), {}, {}};
  const auto count = static_cast<double>(request.groups.size());
  for (const SourceGroup& group : request.groups) {
    const auto done = static_cast<double>(result.groups.size());
    Part part(control, done / count, (done + 1) / count);
    ordered_json summary = ordered_json::object();
    if (request.compares) summary["label"] = group.label;
    result.groups.push_back(analyze(request, group, part, summary));
    if (!request.compares) {
      result.summary = std::move(summary);
      add_end(result.summary, result.points());
      continue;
    }
    summary["domain"] = domain_to_json(*result.groups.back().sets.front().domain);
    result.summary["compare"].push_back(std::move(summary));
  }
  if (request.compares) result.summary["version"] = version();
  return result;
}

Result run(const MeshRequest& request, Control& control) {
  Part first(control, 0, 0.5);
  Made made = make(request.points, first);
  const auto mesh = at(request.points.pointer, [&] {
    return std::make_shared<const Mesh>(request.method->run(made.points, control));
  });
  ordered_json summary = {{"n", made.points.size()},
                          {"method", request.method->name},
                          {"quality", quality_to_json(measure_quality(*mesh), made.points.domain->area())}};
  if (!made.optimized.is_null()) summary["optimized"] = std::move(made.optimized);
  add_sizing(summary, made.points);
  add_seed(summary, request.points);
  add_end(summary, made.points);
  return {"mesh", std::move(summary), one_group(std::move(made.points)), {}, mesh};
}

}  // namespace

Result execute(const Request& request, Control& control) {
  Result result =
      std::visit([&](const auto& operation) { return run(operation, control); }, request.operation);
  result.picture = request.picture;
  result.barycentric = request.barycentric;
  control.report({1});
  return result;
}

}  // namespace wellspaced

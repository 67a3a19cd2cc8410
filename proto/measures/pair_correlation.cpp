#include "core/analyze/pair_correlation.h"

#include <vector>

#include "core/registry_measures.h"
#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

ordered_json run(const MeasureInput& input, const Arguments& arguments, const Control& control) {
  const auto all = of_each(input.sets.size(), [&](std::size_t s) {
    return pair_correlation(input.sets[s], pair_correlation_options(arguments), control);
  });
  const PairCorrelation mean = average(all);
  const PairCorrelationPeak peak = highest_peak(mean);
  std::vector<double> r;
  for (std::size_t k = 0; k < mean.g.size(); ++k) r.push_back(mean.middle(k));
  return {{"d_hex", mean.d_hex},
          {"bin", mean.bin},
          {"peak", {{"r", peak.r}, {"g", peak.height}}},
          {"r", r},
          {"g", mean.g}};
}

ordered_json schema() {
  const ordered_json number = {{"type", "number"}};
  ordered_json out = {{"type", "object"}};
  add_property(out, "d_hex", {{"type", "number"}, {"description", "sqrt(2 A / (sqrt(3) n))"}});
  add_property(out, "bin", {{"type", "number"}, {"description", "width of the rings, in d_hex"}});
  add_property(out, "peak",
               {{"type", "object"},
                {"description", "the highest ring"},
                {"properties", {{"r", number}, {"g", number}}},
                {"required", {"r", "g"}}});
  add_property(out, "r", numbers_property("middle of each ring, in d_hex"));
  add_property(out, "g",
               numbers_property("pairs at that distance relative to white noise, averaged over the sets"));
  return out;
}

}  // namespace

Measure pair_correlation_measure() {
  Measure row;
  row.name = "pair-correlation";
  row.title = "Pair correlation";
  row.description = "g(r): how many pairs of points stand at each distance, relative to white noise.";
  row.reference = "Torquato 2002, section 2.1";
  row.parameters = pair_correlation_parameters();
  row.run = run;
  row.schema = schema;
  row.cost = [](const SetsSize& size, const Arguments& arguments) {
    return pair_correlation_cost(size, pair_correlation_options(arguments));
  };
  row.needs_torus = true;
  return row;
}

}  // namespace wellspaced

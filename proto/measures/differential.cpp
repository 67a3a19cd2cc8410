#include "core/analyze/differential.h"

#include <vector>

#include "core/domain/sizing.h"
#include "core/registry_measures.h"
#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

ordered_json run(const MeasureInput& input, const Arguments& arguments, const Control& control) {
  const DifferentialOptions options = differential_options(arguments);
  const auto all = of_each(input.sets.size(), [&](std::size_t s) {
    return differential_domain(input.sets[s], radii_of(input.sets[s], input.sizing), options, control);
  });
  const DifferentialDomain mean = average(all);
  return {{"reach", mean.reach},
          {"sigma", mean.sigma},
          {"r", numbers_to_json(mean.r)},
          {"density", numbers_to_json(mean.mean)},
          {"anisotropy_db", numbers_to_json(mean.anisotropy_db)}};
}

ordered_json schema() {
  ordered_json out = {{"type", "object"}};
  add_property(out, "reach", {{"type", "number"}, {"description", "in d_hex of the equivalent uniform set"}});
  add_property(out, "sigma", {{"type", "number"}, {"description", "of the Gaussian kernel, in d_hex"}});
  add_property(out, "r", numbers_property("of the rings, in d_hex"));
  add_property(out, "density", numbers_property("of differences, mean over each ring; 1 for white noise"));
  add_property(out, "anisotropy_db", numbers_property("10 log10(variance / mean^2) over half of each ring"));
  return out;
}

}  // namespace

Measure differential_measure() {
  Measure row;
  row.name = "differential";
  row.title = "Differential domain analysis";
  row.description =
      "The pair correlation of sets that are denser in some places: differences of points divided by the "
      "mean of "
      "their radii, which are those of \"sizing\" (all the same without it). The picture of the same name "
      "shows them "
      "in two dimensions.";
  row.reference = "Wei and Wang 2011";
  row.parameters = differential_parameters();
  row.run = run;
  row.schema = schema;
  row.cost = [](const SetsSize& size, const Arguments& arguments) {
    const Cost one = differential_cost(size.n, differential_options(arguments));
    return Cost{size.sets * one.seconds, (1 + size.sets / 16) * one.bytes};
  };
  row.check = [](const Domain&, double, const Arguments& arguments) {
    require_options(differential_options(arguments));
  };
  row.needs_torus = true;
  return row;
}

}  // namespace wellspaced

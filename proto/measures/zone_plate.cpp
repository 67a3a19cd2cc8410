#include "core/analyze/zone_plate.h"

#include "core/registry_measures.h"
#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

ordered_json run(const MeasureInput& input, const Arguments& arguments, const Control& control) {
  const ZonePlateOptions options = zone_plate_options(arguments);
  double rmse = 0;
  ZonePlate plate;
  for (const PointSet& set : input.sets) {
    plate = zone_plate(set, options, control);
    rmse += plate.rmse / static_cast<double>(input.sets.size());
  }
  const PointSet& first = input.sets.front();
  return {{"function",
           "(1 + cos(pi k rho^2)) / 2, rho the distance from the corner (0, 0) in widths of the domain"},
          {"k", zone_plate_field(*first.domain, first.size(), options.frequency).k},
          {"frequency", options.frequency},
          {"sigma", options.sigma},
          {"columns", plate.columns},
          {"rows", plate.rows},
          {"rmse", rmse}};
}

ordered_json schema() {
  const auto typed = [](const char* type, const char* description) {
    return ordered_json{{"type", type}, {"description", description}};
  };
  ordered_json out = {{"type", "object"}};
  add_property(out, "function", typed("string", "that was sampled"));
  add_property(out, "k", typed("number", "cycles a width at a width's distance from the corner"));
  add_property(out, "frequency", typed("number", "the same in cycles a mean sample spacing, sqrt(A / n)"));
  add_property(out, "sigma",
               typed("number", "standard deviation of the Gaussian filter, in mean sample spacings"));
  add_property(out, "columns", typed("integer", "pixels"));
  add_property(out, "rows", typed("integer", "pixels"));
  add_property(
      out, "rmse",
      typed(
          "number",
          "root mean square difference of the pixels (values in [0, 1]) from the function filtered exactly: "
          "aliasing and noise; of several sets, the mean"));
  return out;
}

}  // namespace

Measure zone_plate_measure() {
  Measure row;
  row.name = "zone-plate";
  row.title = "Zone plate";
  row.description =
      "The aliasing test: rings that get finer outwards, sampled at the points and reconstructed by a "
      "Gaussian filter. "
      "The picture of the same name shows the image.";
  row.reference = "Mitchell and Netravali 1988; Lagae and Dutre 2008";
  row.parameters = zone_plate_parameters();
  row.run = run;
  row.schema = schema;
  row.cost = [](const SetsSize& size, const Arguments& arguments) {
    const Cost one = zone_plate_cost(size.n, size.height_over_width, zone_plate_options(arguments));
    return Cost{size.sets * one.seconds, one.bytes};
  };
  row.check = [](const Domain& domain, double n, const Arguments& arguments) {
    require_options(zone_plate_options(arguments), domain, static_cast<std::size_t>(n));
  };
  row.needs_torus = true;
  return row;
}

}  // namespace wellspaced

#include "core/analyze/distributions.h"

#include "core/analyze/spacing.h"
#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

struct Field {
  const char* name;
  Histogram Distributions::*histogram;
  const char* description;
};

constexpr Field fields[] = {
    {"beta_i", &Distributions::beta_i, "local ratios r_c^i / r_f^i of the points"},
    {"valence", &Distributions::valence,
     "Delaunay neighbors of the points; bins are centered at whole numbers"},
    {"angle_deg", &Distributions::angle_deg, "angles of the Delaunay triangles, degrees"},
    {"edge", &Distributions::edge, "lengths of the Delaunay edges / d_hex"},
    {"nearest", &Distributions::nearest, "distances to the nearest other point / d_hex"},
    {"cell_area", &Distributions::cell_area, "areas of the Voronoi cells / their mean"},
};

ordered_json to_json(const Histogram& h) {
  return {{"low", h.low},   {"width", h.width}, {"counts", h.counts}, {"above", h.above},
          {"mean", h.mean}, {"sd", h.sd},       {"min", h.min},       {"max", h.max}};
}

ordered_json histogram_schema(const char* description) {
  const auto number = [](const char* what) {
    return ordered_json{{"type", "number"}, {"description", what}};
  };
  ordered_json schema = {{"type", "object"}, {"description", description}};
  add_property(schema, "low", number("where the first bin begins"));
  add_property(schema, "width", number("of a bin"));
  add_property(schema, "counts",
               {{"type", "array"},
                {"description", "values in [low + k width, low + (k + 1) width), of all sets together"},
                {"items", {{"type", "integer"}}}});
  add_property(schema, "above", {{"type", "integer"}, {"description", "values beyond the last bin"}});
  for (const char* name : {"mean", "sd", "min", "max"})
    add_property(schema, name, number("of the values themselves"));
  return schema;
}

}  // namespace

Measure distributions_measure() {
  Measure row;
  row.name = "distributions";
  row.title = "Distributions";
  row.description =
      "Histograms of what spacing sums up: local ratios, valences, angles, edges, nearest distances and cell "
      "areas. "
      "Values of several sets are pooled.";
  row.reference = "Ebeida et al. 2013, section 6";
  row.run = [](const MeasureInput& input, const Arguments&, const Control& control) {
    const auto all = of_each(input.sets.size(), [&](std::size_t s) {
      measure_spacing(input.sets[s], control);  // refuses what has no triangulation to speak of
      return distributions(input.sets[s], control);
    });
    const Distributions pooled = pool(std::span<const Distributions>(all));
    ordered_json out;
    for (const Field& field : fields) out[field.name] = to_json(pooled.*field.histogram);
    return out;
  };
  row.schema = [] {
    ordered_json schema = {{"type", "object"}};
    for (const Field& field : fields) add_property(schema, field.name, histogram_schema(field.description));
    return schema;
  };
  row.cost = [](const SetsSize& size, const Arguments&) {
    return Cost{1e-5 * size.n * size.sets, 500 * size.n};
  };
  return row;
}

}  // namespace wellspaced

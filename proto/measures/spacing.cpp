#include "core/analyze/spacing.h"

#include <map>
#include <vector>

#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

constexpr NumberField<Spacing> fields[] = {
    {"beta", &Spacing::beta, "global ratio r_c / r_f_free"},
    {"r_f", &Spacing::r_f,
     "conflict radius: smallest distance between two points; a point's own images around the torus don't "
     "count"},
    {"r_f_free", &Spacing::r_f_free,
     "the same without pairs of two corners of the domain, which can't move; on a torus it is r_f"},
    {"r_c", &Spacing::r_c, "coverage radius: largest distance of a domain point to its nearest sample"},
    {"beta_i_max", &Spacing::beta_i_max, "largest local ratio r_c^i / r_f^i; at most beta"},
    {"beta_i_mean", &Spacing::beta_i_mean, "mean local ratio"},
    {"rho", &Spacing::rho,
     "r_f_free / d_hex; d_hex = sqrt(2 A / (sqrt(3) n)) where nothing bounds the domain"},
    {"coverage", &Spacing::coverage, "r_c / d_hex"},
    {"packing_density", &Spacing::packing_density, "n pi r_f^2 / (4 A)"},
    {"nearest_mean", &Spacing::nearest_mean, "mean distance to the nearest sample / d_hex"},
    {"cell_area_sd", &Spacing::cell_area_sd, "standard deviation of Voronoi cell areas / their mean"},
    {"angle_min_deg", &Spacing::angle_min_deg, "smallest angle of the Delaunay triangles, degrees"},
    {"angle_max_deg", &Spacing::angle_max_deg, "largest angle of the Delaunay triangles, degrees"},
    {"edge_min", &Spacing::edge_min, "shortest Delaunay edge / r_f"},
    {"edge_max", &Spacing::edge_max, "longest Delaunay edge / r_f"},
};

ordered_json object_of(std::span<const Spacing> sets) {
  ordered_json out = means_to_json<Spacing>(fields, sets);
  std::map<int, std::size_t> pooled;
  for (const Spacing& set : sets)
    for (const auto& [neighbors, samples] : set.valence) pooled[neighbors] += samples;
  ordered_json valence = ordered_json::object();
  for (const auto& [neighbors, samples] : pooled) valence[std::to_string(neighbors)] = samples;
  out["valence"] = std::move(valence);
  return out;
}

ordered_json run(const MeasureInput& input, const Arguments&, const Control& control) {
  const std::span<const PointSet> sets = input.sets;
  const auto all = of_each(sets.size(), [&](std::size_t s) { return measure_spacing(sets[s], control); });
  ordered_json out = object_of(all);
  if (sets.size() == 1) return out;
  out["by_set"] = ordered_json::array();
  for (const Spacing& set : all) out["by_set"].push_back(spacing_to_json(set));
  return out;
}

}  // namespace

ordered_json spacing_to_json(const Spacing& spacing) { return object_of({&spacing, 1}); }

ordered_json spacing_schema() {
  ordered_json schema = numbers_schema<Spacing>(fields);
  add_property(schema, "valence",
               {{"type", "object"},
                {"description", "how many samples have that many Delaunay neighbors"},
                {"additionalProperties", {{"type", "integer"}}}});
  schema["properties"]["by_set"] = {
      {"type", "array"},
      {"description", "the same for each of several sets, of which the numbers above are the means"},
      {"items", {{"type", "object"}}}};
  return schema;
}

Measure spacing_measure() {
  Measure row;
  row.name = "spacing";
  row.title = "Spacing";
  row.description =
      "How evenly the points cover their domain: conflict and coverage radius, beta, and what follows.";
  row.reference = "Ebeida et al. 2013, sections 2 and 6";
  row.run = run;
  row.schema = spacing_schema;
  row.cost = [](const SetsSize& size, const Arguments&) {
    return Cost{8e-6 * size.n * size.sets, 400 * size.n};
  };
  return row;
}

}  // namespace wellspaced

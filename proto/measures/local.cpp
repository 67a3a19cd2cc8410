#include "core/analyze/local_measures.h"
#include "core/analyze/spacing.h"
#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

constexpr const char* descriptions[] = {"local ratio r_c^i / r_f^i",
                                        "distance to the nearest other point / d_hex",
                                        "area of the Voronoi cell / mean",
                                        "number of Delaunay neighbors",
                                        "smallest angle of the Delaunay triangles around the point, degrees",
                                        "|mean over Delaunay neighbors of exp(6 i theta)|"};

ordered_json of_set(const PointSet& points, const Control& control) {
  measure_spacing(points, control);  // refuses what has no triangulation to speak of
  ordered_json out;
  for (std::size_t k = 0; k < local_measure_names.size(); ++k)
    out[std::string(local_measure_names[k])] = measure_locally(points, static_cast<LocalMeasure>(k), control);
  return out;
}

ordered_json set_schema() {
  ordered_json schema = {{"type", "object"}};
  for (std::size_t k = 0; k < local_measure_names.size(); ++k)
    add_property(schema, local_measure_names[k].data(), numbers_property(descriptions[k]));
  return schema;
}

}  // namespace

Measure local_measure() {
  Measure row;
  row.name = "local";
  row.title = "Local measures";
  row.description = "What can be said of each point, in the points' order: what pictures are colored by.";
  row.reference = "Ebeida et al. 2013, section 2";
  row.run = [](const MeasureInput& input, const Arguments&, const Control& control) {
    ordered_json sets = ordered_json::array();
    for (const PointSet& set : input.sets) sets.push_back(of_set(set, control));
    return ordered_json{{"by_set", std::move(sets)}};
  };
  row.schema = [] {
    ordered_json schema = {{"type", "object"}};
    add_property(schema, "by_set", {{"type", "array"}, {"items", set_schema()}});
    return schema;
  };
  row.cost = [](const SetsSize& size, const Arguments&) {
    return Cost{3e-5 * size.n * size.sets, 400 * size.n};
  };
  row.kept_bytes = [](const SetsSize& size, const Arguments&) { return 330 * size.n * size.sets; };
  return row;
}

}  // namespace wellspaced

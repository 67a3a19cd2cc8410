#include "core/analyze/bond_order.h"

#include "core/analyze/spacing.h"
#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

constexpr NumberField<BondOrder> fields[] = {
    {"psi6_global", &BondOrder::psi6_global,
     "|mean over all points of psi6_i|, psi6_i = mean over Delaunay neighbors of exp(6 i theta): whether "
     "there is "
     "one orientation"},
    {"psi6_local", &BondOrder::psi6_local,
     "mean over all points of |psi6_i|: whether neighbors form hexagons, however turned"},
    {"psi6_edges", &BondOrder::psi6_edges,
     "the variant of the tool PSA: theta is the direction of the edge from one neighbor to the next"},
};

}  // namespace

Measure bond_order_measure() {
  Measure row;
  row.name = "bond-order";
  row.title = "Bond-orientational order";
  row.description =
      "Three measures of one name that differ; each is 1 for the triangular lattice. Of several sets, the "
      "means.";
  row.reference = "Halperin and Nelson 1978 (psi6); Schloemer and Heck 2012 (psi6_edges)";
  row.run = [](const MeasureInput& input, const Arguments&, const Control& control) {
    const auto all = of_each(input.sets.size(), [&](std::size_t s) {
      measure_spacing(input.sets[s], control);  // refuses what has no triangulation to speak of
      return bond_order(input.sets[s], control);
    });
    return means_to_json<BondOrder>(fields, all);
  };
  row.schema = [] { return numbers_schema<BondOrder>(fields); };
  row.cost = [](const SetsSize& size, const Arguments&) {
    return Cost{8e-6 * size.n * size.sets, 400 * size.n + 8 * size.n * size.sets};
  };
  return row;
}

}  // namespace wellspaced

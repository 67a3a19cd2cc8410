#include "core/analyze/discrepancy.h"

#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

constexpr NumberField<Discrepancy> fields[] = {
    {"star", &Discrepancy::star,
     "star discrepancy: the largest |share of the points in a box - its share of the area| of all boxes from "
     "the "
     "origin"},
    {"l2_star", &Discrepancy::l2_star, "the root of the mean square of the same"},
    {"l2_periodic", &Discrepancy::l2_periodic,
     "wrap-around L2 discrepancy, over boxes anywhere on the torus: unlike the others it doesn't depend on "
     "where the "
     "origin is"},
};

}  // namespace

Measure discrepancy_measure() {
  Measure row;
  row.name = "discrepancy";
  row.title = "Discrepancy";
  row.description =
      "How far the share of points in boxes is from the boxes' share of the area; of several sets, the "
      "means.";
  row.reference = "Niederreiter 1972 (star); Warnock 1972 (l2_star); Hickernell 1998 (l2_periodic)";
  row.run = [](const MeasureInput& input, const Arguments&, const Control& control) {
    const auto all =
        of_each(input.sets.size(), [&](std::size_t s) { return discrepancy(input.sets[s], control); });
    return means_to_json<Discrepancy>(fields, all);
  };
  row.schema = [] { return numbers_schema<Discrepancy>(fields); };
  row.cost = [](const SetsSize& size, const Arguments&) {
    return Cost{6e-6 * size.n * size.sets, 440 * size.n};
  };
  row.needs_torus = true;
  return row;
}

}  // namespace wellspaced

#include "proto/measures/measures.h"

#include <vector>

#include "core/domain/torus.h"
#include "core/error.h"
#include "proto/measures/rows.h"
#include "proto/request.h"

namespace wellspaced {
namespace {

const std::vector<Measure> measure_rows = {
    spacing_measure(),    certificate_measure(), distributions_measure(),    local_measure(),
    spectrum_measure(),   periodogram_measure(), pair_correlation_measure(), discrepancy_measure(),
    bond_order_measure(), zone_plate_measure(),  differential_measure(),
};

}  // namespace

std::span<const Measure> measures() { return measure_rows; }

const Measure* find_measure(std::string_view name) {
  for (const Measure& measure : measure_rows)
    if (measure.name == name) return &measure;
  return nullptr;
}

void require_meaning(const Measure& measure, const Domain& domain, const std::string& where) {
  if (!measure.needs_torus || is_torus(domain)) return;
  throw Error(
      ErrorCode::invalid_parameters,
      measure.name + " is measured on a torus only, not on a " + std::string(domain.type()) +
          "; ask for spacing, certificate, distributions, local or bond-order, or for this on a torus",
      where);
}

void require_same_domain(const Domain& first, const Domain& other, const std::string& where) {
  if (&first == &other || domain_to_json(first) == domain_to_json(other)) return;
  throw Error(
      ErrorCode::invalid_parameters,
      "this set is on another domain than the first one; averages are over sets on one domain, compare "
      "others with \"compare\": [...]",
      where);
}

void require_same_size(double first, double other, const std::string& where) {
  if (first == other) return;
  const auto text = [](double n) { return std::to_string(static_cast<std::uint64_t>(n)); };
  throw Error(ErrorCode::invalid_parameters,
              "this set has " + text(other) + " points, the first one " + text(first) +
                  "; averages are over sets of one size: generate by count, or compare them with "
                  "\"compare\": [...]",
              where);
}

}  // namespace wellspaced

#include "core/analyze/certificate.h"

#include <algorithm>

#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

constexpr NumberField<Certificate> fields[] = {
    {"beta_upper", &Certificate::beta_upper, "proven: beta is not above this"},
    {"r_f_lower", &Certificate::r_f_lower, "proven: r_f is not below this"},
    {"r_c_upper", &Certificate::r_c_upper, "proven: r_c is not above this"},
};

/// What holds for both.
std::optional<Certificate> weaker(const std::optional<Certificate>& a, const std::optional<Certificate>& b) {
  if (!a || !b) return std::nullopt;
  return Certificate{std::min(a->r_f_lower, b->r_f_lower), std::max(a->r_c_upper, b->r_c_upper),
                     std::max(a->beta_upper, b->beta_upper)};
}

ordered_json run(const MeasureInput& input, const Arguments&, const Control& control) {
  std::optional<Certificate> proof = certify(input.sets.front(), control);
  for (const PointSet& set : input.sets.subspan(1)) proof = weaker(proof, certify(set, control));
  return certificate_to_json(proof);
}

}  // namespace

ordered_json certificate_to_json(const std::optional<Certificate>& certificate) {
  ordered_json out;
  for (const auto& field : fields)
    out[field.name] = certificate ? ordered_json((*certificate).*field.value) : ordered_json();
  return out;
}

ordered_json certificate_schema() { return numbers_schema<Certificate>(fields, {"number", "null"}); }

Measure certificate_measure() {
  Measure row;
  row.name = "certificate";
  row.title = "Certificate";
  row.description =
      "Proven bounds on both radii and on beta, found with directed roundings apart from the analysis of "
      "spacing; of several sets, bounds that hold for each of them. Null if the points are so nearly in "
      "lines "
      "that nothing can be proven.";
  row.run = run;
  row.schema = certificate_schema;
  row.cost = [](const SetsSize& size, const Arguments&) {
    return Cost{8e-6 * size.n * size.sets, 400 * size.n};
  };
  return row;
}

}  // namespace wellspaced

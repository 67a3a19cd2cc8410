#include "core/analyze/spectrum.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/analyze/periodogram.h"
#include "core/math.h"
#include "core/registry_measures.h"
#include "proto/measures/number_fields.h"
#include "proto/measures/rows.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

constexpr double spectrum_range = 6.5, periodogram_range = 2.5;

Parameter measured_range(double fallback) {
  return range_parameter("largest frequency, in units of sqrt(n / A)", 0.1, 1000, fallback);
}

ordered_json optional_number(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json run_spectrum(const MeasureInput& input, const Arguments& arguments, const Control& control) {
  const Periodogram mean = mean_periodogram(input.sets, range_of(arguments, spectrum_range), control);
  const Spectrum s = spectrum(mean, static_cast<int>(input.sets.size()));
  std::vector<double> frequency(s.power.size());
  for (std::size_t r = 0; r < frequency.size(); ++r) frequency[r] = static_cast<double>(r) / std::sqrt(s.n);
  return {{"effective_nyquist", optional_number(effective_nyquist(s))},
          {"oscillations", optional_number(oscillations(s))},
          {"anisotropy_mean_db", optional_number(mean_anisotropy_db(s))},
          {"anisotropy_expected_db", 0.0 - 10 * portable_log10(static_cast<double>(input.sets.size()))},
          {"frequency", numbers_to_json(frequency)},
          {"power", numbers_to_json(s.power)},
          {"anisotropy_db", numbers_to_json(s.anisotropy_db)}};
}

ordered_json spectrum_schema() {
  ordered_json schema = {{"type", "object"}};
  add_property(schema, "effective_nyquist",
               number_or_null("in units of sqrt(n / A): up to it there is nearly no power; null if the range "
                              "ends before"));
  add_property(schema, "oscillations",
               number_or_null("10 times the root mean square of power - 1 above the first frequency where it "
                              "comes to .98, over 5 sqrt(n / A); null if the range ends before"));
  add_property(
      schema, "anisotropy_mean_db",
      number_or_null("mean over the rings from .5 to 2.5 sqrt(n / A); null if the range ends before"));
  add_property(schema, "anisotropy_expected_db",
               {{"type", "number"},
                {"description", "of sets without a preferred direction: -10 log10(number of sets)"}});
  add_property(schema, "frequency", numbers_property("of each ring, in units of sqrt(n / A)"));
  add_property(schema, "power", numbers_property("mean over each ring; 1 for white noise, 0 at frequency 0"));
  add_property(schema, "anisotropy_db", numbers_property("10 log10(variance / mean^2) over each ring"));
  return schema;
}

ordered_json run_periodogram(const MeasureInput& input, const Arguments& arguments, const Control& control) {
  const Periodogram mean = mean_periodogram(input.sets, range_of(arguments, periodogram_range), control);
  ordered_json rows = ordered_json::array();
  const auto row = static_cast<std::size_t>(2 * mean.k_max + 1);
  for (std::size_t kx = 0; kx <= static_cast<std::size_t>(mean.k_max); ++kx) {
    if (kx % 64 == 0) control.check();
    const auto begin = mean.power.begin() + static_cast<std::ptrdiff_t>(kx * row);
    rows.push_back(std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(row)));
  }
  return {{"k_max", mean.k_max}, {"power", std::move(rows)}};
}

ordered_json periodogram_schema() {
  ordered_json schema = {{"type", "object"}};
  add_property(schema, "k_max", {{"type", "integer"}, {"description", "largest frequency along both axes"}});
  add_property(
      schema, "power",
      {{"type", "array"},
       {"description",
        "rows for kx = 0 .. k_max of the power at ky = -k_max .. k_max; that at (-kx, -ky) is the same; "
        "0 at (0, 0)"},
       {"items", {{"type", "array"}, {"items", {{"type", "number"}}}}}});
  return schema;
}

Cost spectrum_cost(const SetsSize& size, const Arguments& arguments) {
  return periodogram_cost(size, range_of(arguments, spectrum_range));
}

/// Of the answer.
double periodogram_numbers(const SetsSize& size, const Arguments& arguments) {
  const double k_max = k_max_of(size.n, size.aspect, range_of(arguments, periodogram_range));
  return 2 * k_max * k_max;
}

/// A number takes longer to be kept, read and written than to be found. Measured, as are its bytes: in trees
/// that grow and as text, of which there are several copies.
Cost periodogram_measure_cost(const SetsSize& size, const Arguments& arguments) {
  constexpr double seconds_a_number = 1.1e-6;
  Cost cost = periodogram_cost(size, range_of(arguments, periodogram_range));
  cost.seconds += seconds_a_number * periodogram_numbers(size, arguments);
  return cost;
}

double periodogram_kept_bytes(const SetsSize& size, const Arguments& arguments) {
  return 170 * periodogram_numbers(size, arguments);
}

}  // namespace

Measure spectrum_measure() {
  Measure row;
  row.name = "spectrum";
  row.title = "Spectrum";
  row.description =
      "What the periodogram, averaged over the sets, tells by rings of equal frequency: radial mean, "
      "anisotropy, "
      "effective Nyquist frequency and oscillations.";
  row.reference = "Ulichney 1988; Lagae and Dutre 2008; Heck, Schloemer and Deussen 2013";
  row.parameters = {measured_range(spectrum_range)};
  row.run = run_spectrum;
  row.schema = spectrum_schema;
  row.cost = spectrum_cost;
  row.needs_torus = true;
  return row;
}

Measure periodogram_measure() {
  Measure row;
  row.name = "periodogram";
  row.title = "Periodogram";
  row.description =
      "How much the sets hold of each frequency, on average: |sum_j exp(-2 pi i k.x_j)|^2 / n at whole k = "
      "(kx / width, ky / height).";
  row.reference = "Ulichney 1988";
  row.parameters = {measured_range(periodogram_range)};
  row.run = run_periodogram;
  row.schema = periodogram_schema;
  row.cost = periodogram_measure_cost;
  row.kept_bytes = periodogram_kept_bytes;
  row.needs_torus = true;
  return row;
}

}  // namespace wellspaced

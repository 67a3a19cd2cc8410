#include "core/registry_measures.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>

#include "core/analyze/spectrum.h"

namespace wellspaced {
namespace {

struct Range {
  double minimum, maximum;
};

std::string shortest(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

Parameter number(const char* name, const char* description, Range range, double fallback) {
  Parameter p;
  p.name = name;
  p.description = description;
  p.minimum = range.minimum;
  p.maximum = range.maximum;
  p.fallback = shortest(fallback);
  return p;
}

Parameter whole(const char* name, const char* description, Range range, const std::string& fallback) {
  Parameter p = number(name, description, range, 0);
  p.type = Parameter::Type::integer;
  p.fallback = fallback;
  return p;
}

}  // namespace

Parameter range_parameter(const char* description, double least, double most, double fallback) {
  return number("range", description, {least, most}, fallback);
}

double range_of(const Arguments& arguments, double fallback) {
  return argument(arguments, "range").value_or(fallback);
}

void SetsSize::take_shape_of(const Domain& domain) {
  const Vec3 sides = domain.box().size;
  height_over_width = sides.z > 0 ? 1 : sides.y / sides.x;
  aspect = std::max(height_over_width, 1 / height_over_width);
}

Cost periodogram_cost(const SetsSize& size, double range) {
  const double k_max = k_max_of(size.n, size.aspect, range);
  if (!(k_max <= largest_k_max)) return {1e9, 1e30};
  const auto bytes = periodogram_bytes(static_cast<std::size_t>(size.n), static_cast<int>(k_max), 8);
  const double second = size.sets > 1 ? 16 * k_max * k_max : 0;  // beside the mean
  return {size.sets * (1e-6 * size.n + 4e-7 * k_max * k_max), static_cast<double>(bytes) + second};
}

std::vector<Parameter> pair_correlation_parameters() {
  const PairCorrelationOptions defaults;
  return {number("reach", "up to which distance, in d_hex", {0.1, PairCorrelationOptions::largest_reach},
                 defaults.reach),
          whole("bins", "rings of equal width", {1, PairCorrelationOptions::most_bins},
                std::to_string(defaults.bins))};
}

PairCorrelationOptions pair_correlation_options(const Arguments& arguments) {
  PairCorrelationOptions options;
  options.reach = argument(arguments, "reach").value_or(options.reach);
  options.bins = static_cast<int>(argument(arguments, "bins").value_or(options.bins));
  return options;
}

Cost pair_correlation_cost(const SetsSize& size, const PairCorrelationOptions& options) {
  const double pairs = 1.9 * options.reach * options.reach * size.n;
  return {size.sets * (1e-8 * pairs + 1e-7 * size.n), 40 * size.n + 60.0 * options.bins * size.sets};
}

std::vector<Parameter> zone_plate_parameters() {
  const ZonePlateOptions defaults;
  return {
      number(
          "frequency",
          "of the rings at a width's distance from the corner, in cycles a mean sample spacing sqrt(A / n)",
          {0, 16}, defaults.frequency),
      number("sigma", "standard deviation of the Gaussian filter, in mean sample spacings", {0.01, 8},
             defaults.sigma),
      whole("columns", "pixels across", {1, ZonePlateOptions::most_columns}, "one a sample")};
}

ZonePlateOptions zone_plate_options(const Arguments& arguments) {
  ZonePlateOptions options;
  if (const auto columns = argument(arguments, "columns")) options.columns = static_cast<int>(*columns);
  options.frequency = argument(arguments, "frequency").value_or(options.frequency);
  options.sigma = argument(arguments, "sigma").value_or(options.sigma);
  return options;
}

std::vector<Parameter> differential_parameters() {
  const DifferentialOptions defaults;
  Parameter sigma =
      number("sigma", "standard deviation of the Gaussian kernel, in d_hex; reach / 256 to reach / 4",
             {0.004, 4}, defaults.sigma);
  sigma.fallback += ", at least reach / 256";
  return {number("reach", "how far the differences go, in d_hex of the equivalent uniform set", {1, 16},
                 defaults.reach),
          std::move(sigma),
          whole("pixels", "of the image across, an odd number", {3, 1025}, std::to_string(defaults.pixels))};
}

DifferentialOptions differential_options(const Arguments& arguments) {
  DifferentialOptions options;
  options.reach = argument(arguments, "reach").value_or(options.reach);
  options.sigma = argument(arguments, "sigma").value_or(std::max(options.sigma, options.reach / 256));
  options.pixels = static_cast<int>(argument(arguments, "pixels").value_or(options.pixels));
  return options;
}

Cost zone_plate_cost(double n, double height_over_width, const ZonePlateOptions& options) {
  const double columns = options.columns ? *options.columns : 0;
  const double pixels = std::max(n, columns * columns * height_over_width),
               samples = 28 * options.sigma * options.sigma;
  return {5e-7 * n + pixels * (6e-7 + 3e-8 * std::min(samples, n)), 60 * n + 40 * pixels};
}

Cost differential_cost(double n, const DifferentialOptions& options) {
  const double pairs = 4.7 * options.reach * options.reach * n,
               pixels = 16.0 * options.pixels * options.pixels;
  return {1e-7 * pairs + 3e-8 * pixels, 60 * n + 16 * pixels};
}

}  // namespace wellspaced

#pragma once

#include <vector>

#include "core/analyze/differential.h"
#include "core/analyze/pair_correlation.h"
#include "core/analyze/zone_plate.h"
#include "core/domain/domain.h"
#include "core/registry.h"

namespace wellspaced {

/// What the cost of a measure or picture depends on: the sets that it averages over or shows.
struct SetsSize {
  double n = 0;  ///< points a set
  double sets = 1;
  double aspect = 1;             ///< longer over shorter side of the domain
  double height_over_width = 1;  ///< of the domain
  bool alone = true;             ///< nothing is compared with them

  /// Curved domains are drawn in a square.
  void take_shape_of(const Domain& domain);
};

// Options of measures as parameters, for the measure and for the picture of it.

/// "range": how far frequencies go, in units of sqrt(n / A); what stands for it is said by each measure or
/// picture.
Parameter range_parameter(const char* description, double least, double most, double fallback);
double range_of(const Arguments& arguments, double fallback);
/// Of the mean periodogram of all sets up to that range; endless beyond the largest frequency there is.
Cost periodogram_cost(const SetsSize& size, double range);

std::vector<Parameter> pair_correlation_parameters();
PairCorrelationOptions pair_correlation_options(const Arguments& arguments);
/// Of all sets, not clustered, about.
Cost pair_correlation_cost(const SetsSize& size, const PairCorrelationOptions& options);

std::vector<Parameter> zone_plate_parameters();
ZonePlateOptions zone_plate_options(const Arguments& arguments);
/// Of one set of n points, about.
Cost zone_plate_cost(double n, double height_over_width, const ZonePlateOptions& options);

std::vector<Parameter> differential_parameters();
DifferentialOptions differential_options(const Arguments& arguments);
/// Of one set of n points that are not clustered, about.
Cost differential_cost(double n, const DifferentialOptions& options);

}  // namespace wellspaced

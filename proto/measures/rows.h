#pragma once

#include "proto/measures/measures.h"

namespace wellspaced {

// One row of the registry each, in the file of its name.

Measure spacing_measure();
Measure certificate_measure();
Measure spectrum_measure();
Measure periodogram_measure();
Measure pair_correlation_measure();
Measure discrepancy_measure();
Measure bond_order_measure();
Measure distributions_measure();
Measure local_measure();
Measure zone_plate_measure();
Measure differential_measure();

}  // namespace wellspaced

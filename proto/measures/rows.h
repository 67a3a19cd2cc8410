#pragma once

#include "proto/measures/measures.h"

namespace wellspaced {

// One row of the registry each, in the file of its name.

Measure spacing_measure();
Measure certificate_measure();
Measure spectrum_measure();
Measure periodogram_measure();

}  // namespace wellspaced

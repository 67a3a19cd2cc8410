#include "core/optimize/require.h"

#include <cmath>

#include "core/error.h"

namespace wellspaced {

void require_sweeps(int max_sweeps) {
  if (max_sweeps < 1)
    throw Error(ErrorCode::invalid_parameters, "at least one sweep is needed", "/max_sweeps");
}

void require_tolerance(double tolerance) {
  if (!(tolerance >= 0 && std::isfinite(tolerance)))
    throw Error(ErrorCode::invalid_parameters, "the tolerance must be a number of at least 0", "/tolerance");
}

}  // namespace wellspaced

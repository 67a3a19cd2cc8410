#pragma once

namespace wellspaced {

/// Errors: invalid_parameters at /max_sweeps for less than 1.
void require_sweeps(int max_sweeps);

/// Errors: invalid_parameters at /tolerance for what is not a finite number of at least 0.
void require_tolerance(double tolerance);

}  // namespace wellspaced

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/point_set.h"

namespace wellspaced {

/// State after a sweep; sweep 0 is the input.
struct SweepRecord {
  int sweep = 0;
  double beta = 0, r_c = 0, r_f = 0;
};

/// What every optimizer returns.
///
/// Guarantees: `points` has as many points as the input, output i is input i moved; it is the best state
/// reached by global beta, never worse than the input. `converged` says whether that beta is at most the
/// target; methods without a target leave it empty.
struct OptimizeResult {
  PointSet points;
  std::optional<bool> converged;
  int sweeps = 0;                    ///< done in all; the best state may be an earlier one
  std::vector<SweepRecord> history;  ///< in the order of sweeps, from 0 on
  double visits = 0;  ///< how often a point was evaluated, on the mean: once a sweep where sweeps visit all
};

}  // namespace wellspaced

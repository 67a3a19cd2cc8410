#pragma once

#include <optional>

#include "core/control.h"
#include "core/optimize/optimize.h"

namespace wellspaced {

struct OptBetaLocalOptions {
  double beta = 0.85;    ///< target for the global ratio, in [1/sqrt(3), 1)
  int max_sweeps = 100;  ///< at least 1
  std::optional<double>
      damping;  ///< part of each found move that is made, in (0, 1]; default .7 for beta > .9, else 1
};

/// Opt-beta^i, the paper's method: each point in turn goes where its own ratio beta_i = r_c^i / r_f^i is
/// least.
///
/// One sweep visits all points in scan-line order and moves each at once; ten Nelder-Mead steps from x, x +
/// r/10 e1 and x + r/10 e2 minimize beta_i of the candidate with the candidate's own Delaunay neighbors.
/// After each sweep the global beta is measured; the method stops when it is at most the target, or after
/// max_sweeps.
///
/// Guarantees: those of OptimizeResult.
/// Errors: those of require_usable; infeasible or invalid_parameters at /beta, /max_sweeps, /damping;
/// degenerate_input if the points are so clustered that their neighborhoods can't be searched locally;
/// cancelled, deadline_exceeded. Cost: about 2.7 us a point and sweep. .85 takes 14 to 23 sweeps from MPS at
/// 10,000 points; below .80 it stalls. Determinism: sequential; the same bytes on any number of threads (only
/// measuring is parallel). Reference: Ebeida et al. 2013, section 4, algorithm 1 (Opt-beta^i).
OptimizeResult opt_beta_local(const PointSet& input, const OptBetaLocalOptions& options, Control& control);

}  // namespace wellspaced

#pragma once

#include "core/optimize/opt_beta.h"
#include "core/optimize/push_pull_sweep.h"

namespace wellspaced {

/// Target radii and weights for a global ratio, as they were found to work best from maximal Poisson-disk
/// samplings. R_c = beta R_f; both radii a little stricter than asked for, since they are tested in float.
///
/// The radii decide how random the result is, the weights how long it takes. The smaller R_f, the less the
/// spectrum oscillates, until there is so little distance to cover everything from that points freeze: gentle
/// goes near that, fast keeps away. Gentle's R_f is never below a maximal Poisson-disk sampling's.
PushPull opt_beta_targets(double beta, OptBetaOptions::Randomness randomness);

/// Fast's radii with other weights.
PushPull opt_beta_targets(double beta, double push, double pull);

}  // namespace wellspaced

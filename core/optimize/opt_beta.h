#pragma once

#include <optional>

#include "core/control.h"
#include "core/optimize/optimize.h"

namespace wellspaced {

struct OptBetaOptions {
  enum class Randomness { gentle, fast };

  double beta = 0.75;                          ///< target for the global ratio, in [1/sqrt(3), 1)
  Randomness randomness = Randomness::gentle;  ///< fast: about half the time, and less random
  std::optional<int> max_visits;  ///< visits a point after which the best state is returned; default: 250 for
                                  ///< a beta of .70 or more (at least 100,000 in all), else 20,000
};

/// What max_visits is when it is not given.
int allowed_visits(const OptBetaOptions& options);
/// How many are to be expected of 10,000 points from maximal Poisson-disk sampling, rather too many.
int expected_visits(const OptBetaOptions& options);

/// opt-beta, this project's own: the global ratio by absolute radii. Target radii R_f and R_c = beta R_f
/// follow from beta; points that violate one are pushed and pulled until none does, on a Delaunay
/// triangulation that is kept while they move.
///
/// Gentle aims at smaller radii than fast for the same beta, as small as it still gets to in good time. Of
/// maximal Poisson-disk samplings it leaves spectra that oscillate less (see oscillations in
/// core/analyze/spectrum.h; 10,000 points):
///
///     beta     .878  .85   .82   .788  .77   .747  .73   .716  .70   (input: 1.0)
///     gentle   1.45  1.47  1.63  1.87  2.05  2.28  2.54  2.78  3.19  (1.61)
///     fast                       2.36        2.69        2.91  3.39
///
/// Below .70 beta is lowered step by step, each from the state that the last one reached; a step that fails
/// is undone and tried again with other weights. If that fails too, as it does near .67, the set ripens
/// (core/optimize/ripening.h) until the step succeeds: it loses points with other than six neighbors, and
/// with them randomness. At 10,000 points .667 takes 3 s and leaves 16 to 19 % of them (.67: 20 %, .69: 31 %)
/// and oscillations of 4.8; at .66 there are 2 to 7 % and the set is nearly a crystal.
///
/// On other domains, where the target isn't reached and max_visits was not given, the least beta that is
/// reached is looked for between the two, to .002: a boundary may rule out the target, for points stay on
/// their curves.
///
/// What freezes on the way to .70, such as a lattice, is shaken by .03 d_hex and moved on by other targets.
///
/// Sets that a StarMesh can't hold are optimized by opt_beta_local instead: for good if they have fewer than
/// 20 points or their torus is thinner than 4 d_hex, else until they are even enough; a sweep of it counts as
/// a visit a point.
///
/// Guarantees: those of OptimizeResult; points that violate nothing on the way are returned bit for bit.
/// `history` holds the sweeps 0, 1, 8, 64, 128, 256 ... of each stage (of sets up to 5000 points also 2, 3,
/// 4, 6, 8, 12 ... and every 64th), a sweep visiting only points that are marked. Errors: those of
/// opt_beta_local; infeasible or invalid_parameters at /beta, /max_visits; cancelled, deadline_exceeded.
/// Cost: about 0.1 us a visit; from MPS about 10 visits a point to .788, 20 to .75, 40 to .70 where fast, 15,
/// 40 and 45 where gentle; 110 bytes a point. Determinism: the same bits on any number of threads; visits,
/// not time, end it.
OptimizeResult opt_beta(const PointSet& input, const OptBetaOptions& options, Control& control);

}  // namespace wellspaced

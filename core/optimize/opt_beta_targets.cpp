#include "core/optimize/opt_beta_targets.h"

#include <array>
#include <cstddef>

namespace wellspaced {
namespace {

constexpr double floor_beta = 0.57735026918962573;  // the triangular lattice's

struct Row {
  double beta, r_f;  // r_f in units of d_hex
  double push = 0, pull = 2;
};

constexpr std::array<Row, 10> fast = {{{1.0, .777},
                                       {.878, .82},
                                       {.788, .85},
                                       {.747, .87},
                                       {.716, .88},
                                       {.70, .895},
                                       {.6889, .90},
                                       {.6707, .92},
                                       {.64, .9447},
                                       {floor_beta, .9997}}};

constexpr double push_of_fast(double beta) { return beta > .73 ? .9 : beta > .709 ? 1.1 : 1.3; }

constexpr std::array<Row, 11> gentle = {{{1.0, .777, .9, 1.6},
                                         {.85, .777, .9, 1.6},
                                         {.82, .795, .9, 1.6},
                                         {.788, .815, .9, 1.6},
                                         {.76, .8375, 1.0, 1.6},
                                         {.747, .845, 1.1, 1.6},
                                         {.73, .859, 1.15, 2},
                                         {.716, .87, 1.25, 2},
                                         {.70, .887, 1.3, 2},
                                         {.69, .895, 1.3, 2},
                                         {floor_beta, .9997, 1.3, 2}}};

/// Linear between rows.
template <std::size_t n>
Row interpolated(const std::array<Row, n>& table, double beta) {
  std::size_t k = 0;
  while (k + 2 < n && beta < table[k + 1].beta) ++k;
  const Row &a = table[k], &b = table[k + 1];
  const double range = b.beta - a.beta, way = beta - a.beta;
  const auto between = [&](double from, double to) { return from + (to - from) * way / range; };
  return {beta, between(a.r_f, b.r_f), between(a.push, b.push), between(a.pull, b.pull)};
}

PushPull targets_of(const Row& row) {
  constexpr double tight = 1e-5;
  PushPull targets;
  targets.r_f = row.r_f * (1 + tight);
  targets.r_c = row.beta * row.r_f * (1 - tight);
  targets.push = row.push;
  targets.pull = row.pull;
  return targets;
}

}  // namespace

PushPull opt_beta_targets(double beta, OptBetaOptions::Randomness randomness) {
  if (randomness == OptBetaOptions::Randomness::gentle) return targets_of(interpolated(gentle, beta));
  return opt_beta_targets(beta, push_of_fast(beta), 2);
}

PushPull opt_beta_targets(double beta, double push, double pull) {
  Row row = interpolated(fast, beta);
  row.push = push;
  row.pull = pull;
  return targets_of(row);
}

}  // namespace wellspaced

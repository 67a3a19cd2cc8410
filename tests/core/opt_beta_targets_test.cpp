#include "core/optimize/opt_beta_targets.h"

#include <cmath>

#include <gtest/gtest.h>

namespace wellspaced {
namespace {

using Randomness = OptBetaOptions::Randomness;

const double floor_beta = 1 / std::sqrt(3.0);

template <class Check>
void for_many_betas(const Check& check) {
  for (const Randomness randomness : {Randomness::gentle, Randomness::fast})
    for (int k = 0; k <= 400; ++k) {
      const double beta = floor_beta + (1 - floor_beta) * k / 400;
      SCOPED_TRACE(::testing::Message() << (randomness == Randomness::fast ? "fast " : "gentle ") << beta);
      check(beta, randomness);
    }
}

TEST(OptBetaTargets, ProveTheRatioWithSomeRoomForRounding) {
  for_many_betas([](double beta, Randomness randomness) {
    const PushPull t = opt_beta_targets(beta, randomness);
    EXPECT_NEAR(t.r_c / t.r_f, beta * (1 - 2e-5), 1e-9);
  });
}

TEST(OptBetaTargets, LieBetweenPoissonDisksAndTheTriangularLattice) {
  for_many_betas([](double beta, Randomness randomness) {
    const PushPull t = opt_beta_targets(beta, randomness);
    EXPECT_GE(t.r_f, .777);
    EXPECT_LT(t.r_f, 1);
    EXPECT_GT(t.r_c, floor_beta * (1 - 1e-3));
  });
}

TEST(OptBetaTargets, MoveMoreForALowerRatio) {
  for_many_betas([](double beta, Randomness randomness) {
    if (beta > 0.99) return;
    const PushPull lower = opt_beta_targets(beta, randomness),
                   higher = opt_beta_targets(beta + 0.01, randomness);
    EXPECT_GE(lower.r_f, higher.r_f);
    EXPECT_LT(lower.r_c, higher.r_c);
    EXPECT_GE(lower.push, higher.push);
    EXPECT_GE(lower.pull, higher.pull);
  });
}

TEST(OptBetaTargets, AreNearerWhenGentle) {
  for_many_betas([](double beta, Randomness) {
    const double gentle = opt_beta_targets(beta, Randomness::gentle).r_f;
    EXPECT_LE(gentle, opt_beta_targets(beta, Randomness::fast).r_f + 1e-4);
  });
}

TEST(OptBetaTargets, TakeOtherWeights) {
  const PushPull t = opt_beta_targets(0.68, 1.25, 1.75), fast = opt_beta_targets(0.68, Randomness::fast);
  EXPECT_EQ(t.push, 1.25);
  EXPECT_EQ(t.pull, 1.75);
  EXPECT_EQ(t.r_f, fast.r_f);
  EXPECT_EQ(t.r_c, fast.r_c);
}

}  // namespace
}  // namespace wellspaced

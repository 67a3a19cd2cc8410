#include "core/optimize/tournament.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace wellspaced {
namespace {

TEST(Tournament, KnowsTheFirstOfTheLargestKeys) {
  for (const std::size_t n : {1, 2, 3, 7, 8, 100}) {
    Tournament tournament(n);
    std::vector<double> keys(n);
    EXPECT_EQ(tournament.winner(), 0u);
    Rng rng(1);
    for (int change = 0; change < 500; ++change) {
      const std::size_t i = rng.below(n);
      keys[i] = static_cast<double>(rng.below(20));
      tournament.set(i, keys[i]);
      const auto largest = std::max_element(keys.begin(), keys.end());
      ASSERT_EQ(tournament.winner(), static_cast<std::size_t>(largest - keys.begin()));
      ASSERT_EQ(tournament.key(tournament.winner()), *largest);
    }
  }
}

}  // namespace
}  // namespace wellspaced

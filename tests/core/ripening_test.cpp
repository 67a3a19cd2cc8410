#include "core/optimize/ripening.h"

#include <gtest/gtest.h>

namespace wellspaced {
namespace {

TEST(Ripening, GoesOnLongerAndStrongerUntilTargetsAreSatisfied) {
  Ripening ripening;
  const Ripening::Portion first = ripening.next();
  Ripening::Portion last = first;
  for (int k = 0; k < 50; ++k) {
    const Ripening::Portion next = ripening.next();
    EXPECT_GE(next.visits, last.visits) << k;
    EXPECT_GE(next.targets.r_f, last.targets.r_f) << k;
    EXPECT_LE(next.visits, 1200) << k;
    last = next;
  }
  EXPECT_GT(last.visits, first.visits);
  EXPECT_GT(last.targets.r_f, first.targets.r_f);
  ripening.restart();
  EXPECT_EQ(ripening.next().visits, first.visits);
}

TEST(Ripening, IsSoonDoneWaitingOnceItBegan) {
  Ripening ripening;
  const double before = ripening.patience();
  ripening.next();
  EXPECT_LT(ripening.patience(), before);
  ripening.restart();
  EXPECT_LT(ripening.patience(), before);
}

}  // namespace
}  // namespace wellspaced

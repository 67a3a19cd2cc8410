#include "core/parallel.h"

#include <atomic>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

TEST(ParallelBlocks, VisitEveryIndexOnce) {
  for (unsigned threads : {1u, 2u, 3u, 8u})
    for (std::size_t n : {0u, 1u, 7u, 64u, 1000u}) {
      std::vector<std::atomic<int>> visits(n);
      parallel_blocks(n, 16, Control(threads), [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin % 16, 0u);
        EXPECT_LE(end - begin, 16u);
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& count : visits) EXPECT_EQ(count, 1);
    }
}

TEST(ParallelBlocks, PassErrorsOnFromAnyThread) {
  for (unsigned threads : {1u, 4u})
    testing::expect_error(
        [&] {
          parallel_blocks(1000, 10, Control(threads), [](std::size_t begin, std::size_t) {
            if (begin == 500) throw Error(ErrorCode::infeasible, "five hundred", "/x");
          });
        },
        ErrorCode::infeasible, "/x");
}

TEST(ParallelBlocks, StopWhenCancelled) {
  Control control(2);
  std::atomic<int> blocks = 0;
  testing::expect_error(
      [&] {
        parallel_blocks(100000, 1, control, [&](std::size_t, std::size_t) {
          ++blocks;
          control.cancel();
        });
      },
      ErrorCode::cancelled, "");
  EXPECT_LE(blocks, 2);
}

TEST(Control, IsOverWhenItsParentIs) {
  Control parent;
  const Control child(1, &parent);
  EXPECT_NO_THROW(child.check());
  parent.cancel();
  testing::expect_error([&] { child.check(); }, ErrorCode::cancelled, "");
}

TEST(Control, KeepsItsDeadline) {
  Control control;
  control.set_deadline(Control::Clock::now() - std::chrono::seconds(1));
  testing::expect_error([&] { control.check(); }, ErrorCode::deadline_exceeded, "");
}

}  // namespace
}  // namespace wellspaced

#include "server/memory.h"

#include <fstream>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace wellspaced {
namespace {

std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(ReturnFreeMemory, GivesBackWhatLiesBelowSomethingInUse) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "another allocator";
#endif
  constexpr std::size_t block = 32 << 10, blocks = 4096;
  std::vector<std::unique_ptr<char[]>> all;
  for (std::size_t k = 0; k < blocks; ++k) all.push_back(std::make_unique<char[]>(block));
  const std::unique_ptr<char[]> above = std::make_unique<char[]>(block);
  all.clear();
  const std::size_t before = resident_bytes();
  EXPECT_FALSE(return_free_memory(std::size_t{1} << 40));
  EXPECT_TRUE(return_free_memory(block * blocks / 2));
  EXPECT_LT(resident_bytes() + block * blocks / 2, before);
}

}  // namespace
}  // namespace wellspaced

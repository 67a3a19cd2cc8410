#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

namespace wellspaced {

void parallel_blocks(std::size_t n, std::size_t block, const Control& control,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t blocks = (n + block - 1) / block;
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  std::size_t failed_block = std::numeric_limits<std::size_t>::max();

  const auto work = [&] {
    for (std::size_t b = next++; b < blocks; b = next++) {
      try {
        control.check();
        body(b * block, std::min(n, (b + 1) * block));
      } catch (...) {  // carried to the caller's thread below
        next = blocks;
        const std::lock_guard lock(mutex);
        if (b < failed_block) {
          failed_block = b;
          failure = std::current_exception();
        }
        return;
      }
    }
  };

  const std::size_t helpers = std::min<std::size_t>(control.threads(), blocks) > 1
                                  ? std::min<std::size_t>(control.threads(), blocks) - 1
                                  : 0;
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < helpers; ++t) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace wellspaced

#include "core/large_vector.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace wellspaced {

void* allocate_large(std::size_t bytes, std::size_t alignment) {
  constexpr std::size_t huge_page = std::size_t{1} << 21, worth_it = 2 * huge_page;
  const bool large = bytes >= worth_it;
  const std::size_t align = std::max({alignment, sizeof(void*), large ? huge_page : 0});
  void* memory = std::aligned_alloc(align, (bytes + align - 1) / align * align);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (large)
    madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE);  // a wish: refused, all is as ever
#endif
  return memory;
}

void free_large(void* memory) { std::free(memory); }

}  // namespace wellspaced

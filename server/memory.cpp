#include "server/memory.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace wellspaced {

bool return_free_memory(std::size_t at_least_bytes) {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  if (mallinfo2().fordblks < at_least_bytes) return false;
  malloc_trim(0);
  return true;
#else
  (void)at_least_bytes;
  return false;
#endif
}

}  // namespace wellspaced

#pragma once

#include <cstddef>

namespace wellspaced {

/// Gives free memory back to the system if the allocator holds at least that much of it: glibc keeps what
/// large answers and jobs needed, in gigabytes, for as long as something small lies above it. Returns whether
/// there was so much. Cost: some 0.1 s a GiB, meanwhile allocations may wait. Thread safety: any thread.
bool return_free_memory(std::size_t at_least_bytes);

}  // namespace wellspaced

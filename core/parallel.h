#pragma once

#include <cstddef>
#include <functional>

#include "core/control.h"

namespace wellspaced {

/// Calls body(begin, end) for [0, n) cut into blocks of `block` indices, on control.threads() threads.
///
/// Guarantees: the blocks depend on n and `block` only, never on the number of threads, so a body that writes
/// per index or per block gives the same bytes on any number of threads. Checks `control` before each block.
/// Errors: the exception of the lowest block that threw.
void parallel_blocks(std::size_t n, std::size_t block, const Control& control,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace wellspaced

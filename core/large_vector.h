#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace wellspaced {

/// Memory for arrays of millions of numbers: in huge pages where the system has them, which spares a fault a
/// page and most misses of the address cache. Errors: std::bad_alloc.
void* allocate_large(std::size_t bytes, std::size_t alignment);
void free_large(void* memory);

template <class T>
struct LargeAllocator {
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t n) { return static_cast<T*>(allocate_large(n * sizeof(T), alignof(T))); }
  void deallocate(T* memory, std::size_t) { free_large(memory); }
  /// Nothing is cleared that is going to be written anyway.
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
  template <class U>
  bool operator==(const LargeAllocator<U>&) const {
    return true;
  }
};

/// A std::vector whose new elements are uninitialized unless a value is given.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace wellspaced

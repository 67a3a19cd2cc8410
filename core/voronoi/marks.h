#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wellspaced {

/// One bit a point, for whoever sweeps over points that are still to be looked at.
class Marks {
 public:
  explicit Marks(std::size_t n = 0) : n_(n), words_((n + 63) / 64, 0) {}

  void set(std::size_t i) { words_[i / 64] |= std::uint64_t{1} << (i % 64); }
  void set_all() {
    std::fill(words_.begin(), words_.end(), ~std::uint64_t{0});
    if (n_ % 64 != 0) words_.back() = (std::uint64_t{1} << (n_ % 64)) - 1;
  }
  void clear() { std::fill(words_.begin(), words_.end(), 0); }

  std::size_t count() const {
    std::size_t count = 0;
    for (const std::uint64_t word : words_) count += static_cast<std::size_t>(std::popcount(word));
    return count;
  }

  /// The first one in [from, end), taken away; `end` if there is none.
  std::size_t take(std::size_t from, std::size_t end) {
    if (from >= end) return end;
    std::size_t word = from / 64;
    std::uint64_t bits = words_[word] >> (from % 64) << (from % 64);
    while (bits == 0) {
      if (++word * 64 >= end) return end;
      bits = words_[word];
    }
    const auto found = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
    if (found >= end) return end;
    words_[word] &= ~(std::uint64_t{1} << (found % 64));
    return found;
  }

 private:
  std::size_t n_;
  std::vector<std::uint64_t> words_;
};

}  // namespace wellspaced

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wellspaced {

/// The largest of n keys while keys change: a binary tree whose nodes hold the winner below them.
///
/// Guarantees: of equal keys the first one wins. Cost: O(log n) a change, O(1) a question; 12 to 20 bytes a
/// key.
class Tournament {
 public:
  /// All keys are 0. Requires: n > 0.
  explicit Tournament(std::size_t n)
      : leaves_(std::bit_ceil(n)), key_(leaves_, 0.0), winner_(2 * leaves_, 0) {
    for (std::size_t i = 0; i < leaves_; ++i) winner_[leaves_ + i] = static_cast<std::uint32_t>(i);
    for (std::size_t node = leaves_; node-- > 1;) winner_[node] = winner_[2 * node];
  }

  double key(std::size_t i) const { return key_[i]; }
  std::size_t winner() const { return winner_[1]; }

  void set(std::size_t i, double key) {
    key_[i] = key;
    for (std::size_t node = (leaves_ + i) / 2; node >= 1; node /= 2) {
      const std::uint32_t left = winner_[2 * node], right = winner_[2 * node + 1];
      winner_[node] = key_[left] >= key_[right] ? left : right;
    }
  }

 private:
  std::size_t leaves_;
  std::vector<double> key_;
  std::vector<std::uint32_t> winner_;  // node k has the children 2k and 2k + 1
};

}  // namespace wellspaced

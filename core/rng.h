#pragma once

#include <array>
#include <cstdint>
#include <utility>

namespace wellspaced {

/// xoshiro256** seeded by splitmix64: own bits to double, so that every platform draws the same numbers.
///
/// Determinism: the sequence depends on (seed, stream) only. Parallel work takes one stream per block or
/// index. Reference: Blackman and Vigna, "Scrambled linear pseudorandom number generators", 2021.
class Rng {
 public:
  explicit Rng(std::uint64_t seed, std::uint64_t stream = 0) {
    std::uint64_t state = seed ^ (stream * 0xd1342543de82ef95ull);
    for (auto& word : state_) word = split_mix(state);
  }

  std::uint64_t next() {
    const std::uint64_t result = rotate_left(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotate_left(state_[3], 45);
    return result;
  }

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  /// Two numbers uniform in [0, 1), 32 bits each.
  std::pair<double, double> uniform_pair() {
    const std::uint64_t bits = next();
    return {static_cast<double>(bits >> 32) * 0x1p-32, static_cast<double>(bits & 0xffffffffu) * 0x1p-32};
  }

  /// Uniform in [0, n), n > 0, by multiply-shift (bias below n / 2^64).
  std::uint64_t below(std::uint64_t n) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>((static_cast<Wide>(next()) * n) >> 64);
  }
  /// The same in [0, n) and [0, m) at once (bias below n m / 2^64).
  std::pair<std::uint64_t, std::uint64_t> below(std::uint64_t n, std::uint64_t m) {
    __extension__ using Wide = unsigned __int128;
    const Wide first = static_cast<Wide>(next()) * n;
    const Wide second = static_cast<Wide>(static_cast<std::uint64_t>(first)) * m;
    return {static_cast<std::uint64_t>(first >> 64), static_cast<std::uint64_t>(second >> 64)};
  }

 private:
  static std::uint64_t rotate_left(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }
  static std::uint64_t split_mix(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace wellspaced

#pragma once

#include <cstdint>

namespace wellspaced {

/// The Delaunay neighbors of one point, counter-clockwise, in one cache line; unused places repeat the first.
struct alignas(64) Star {
  static constexpr int most = 15;
  std::uint32_t neighbor[most];
  std::int32_t degree;

  int find(std::uint32_t v) const;  ///< its place, or `degree`
  int after(int k) const { return k + 1 == degree ? 0 : k + 1; }
  int before(int k) const { return k == 0 ? degree - 1 : k - 1; }
  void erase(int k);
  void insert_after(int k, std::uint32_t v);
};

}  // namespace wellspaced

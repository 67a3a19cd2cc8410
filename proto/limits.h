#pragma once

#include <cstdint>

namespace wellspaced {

/// Every limit that a request meets, in one place; the server has a flag for each, /v1/operations shows them.
struct Limits {
  std::uint64_t body_bytes = 256ull << 20;
  std::uint64_t generate_points = 10'000'000;
  std::uint64_t optimize_points = 10'000'000;
  std::uint64_t analyze_points = 10'000'000;
  std::uint64_t mesh_points = 10'000'000;
  std::uint64_t picture_points = 100'000;
  double picture_seconds = 10;              ///< estimated, to draw one
  double sync_seconds = 30;                 ///< estimated work above this needs `Prefer: respond-async`
  std::uint64_t memory_bytes = 4ull << 30;  ///< estimated, a job
};

}  // namespace wellspaced

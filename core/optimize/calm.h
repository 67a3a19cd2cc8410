#pragma once

#include <cstddef>
#include <limits>

namespace wellspaced {

/// Notices that a relaxation is frozen: 150 sweeps in which the number of moves made no new 5% low while more
/// than .5% of the points still move.
class Calm {
 public:
  /// Whether it is, after one more sweep with so many moves of n points; starts over if so.
  bool lasts(std::size_t moves, std::size_t n) {
    const auto m = static_cast<double>(moves);
    if (m < .95 * fewest_) return start_over(m);
    if (++sweeps_ < 150 || m <= .005 * static_cast<double>(n)) return false;
    start_over(m);
    return true;
  }

 private:
  bool start_over(double fewest) {
    fewest_ = fewest;
    sweeps_ = 0;
    return false;
  }

  double fewest_ = std::numeric_limits<double>::infinity();
  int sweeps_ = 0;
};

}  // namespace wellspaced

#include "core/analyze/star_discrepancy.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "core/large_vector.h"

namespace wellspaced {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::size_t between_checks = 1 << 12;

/// For each level y a line: the excess of the box up to (x, y) as x grows, while samples enter it. Keeps
/// which one is the highest. A tree over the levels: each node knows the best line below it, and up to which
/// x that is sure to stay the best.
class Tournament {
 public:
  /// At x = 0, no sample entered.
  Tournament(const RankedPoints& points, BoxSides sides, const Control& control)
      : open_(sides == BoxSides::open),
        n_(static_cast<double>(points.size())),
        levels_(points.levels.size() + 1),
        leaves_(std::bit_ceil(levels_)),
        nodes_(filled(2 * leaves_, Node{}, control)) {
    // The box may reach to the far side. Leaves beyond repeat that level, and never win against it.
    for (std::size_t k = 0; k < leaves_; ++k)
      nodes_[leaves_ + k] = {k < points.levels.size() ? points.levels[k] : 1.0, 0, 0, never};
    for (std::size_t k = leaves_ - 1; k > 0; --k) {
      if (k % between_checks == 0) control.check();
      decide(k, 0);
    }
  }

  /// Moves on to x, which never falls.
  void advance(double x) { advance(1, x); }

  /// One more sample in the boxes of level `from` and above. Requires: advanced to x.
  void enter(std::size_t from, double x) {
    if (from >= levels_) return;
    std::size_t k = leaves_ + from;
    ++nodes_[k].count;
    for (; k > 1; k /= 2) {
      if (k % 2 == 0) {
        ++nodes_[k + 1].count;
        ++nodes_[k + 1].entered;
      }
      decide(k / 2, x);
    }
  }

  /// Requires: advanced to x.
  double highest(double x) const {
    const double area = x * nodes_[1].y, share = nodes_[1].count / n_;
    return open_ ? area - share : share - area;
  }

 private:
  struct Node {
    double y, count;  ///< of the best line: its level; samples in its box, those left out that all of a node
                      ///< above have
    double entered;   ///< samples that all lines below have
    double until;     ///< the best line stays the best before this x
  };

  void decide(std::size_t k, double x) {
    const Node &lower = nodes_[2 * k], &upper = nodes_[2 * k + 1];
    const double dy = upper.y - lower.y;
    // From here on the larger box gains more area than it has more samples.
    const double crossing = dy > 0 ? (upper.count - lower.count) / (n_ * dy) : never;
    const bool crossed = x >= crossing;
    const Node& best = crossed == open_ ? upper : lower;
    Node& node = nodes_[k];
    node.y = best.y;
    node.count = best.count + node.entered;
    node.until = std::min({lower.until, upper.until, crossed ? never : crossing});
  }

  void advance(std::size_t k, double x) {
    if (nodes_[k].until > x) return;
    advance(2 * k, x);
    advance(2 * k + 1, x);
    decide(k, x);
  }

  const bool open_;
  const double n_;
  const std::size_t levels_, leaves_;
  LargeVector<Node> nodes_;  ///< node k has the children 2 k and 2 k + 1
};

}  // namespace

double star_discrepancy(const RankedPoints& points, BoxSides sides, const Control& control) {
  const bool open = sides == BoxSides::open;
  Tournament tournament(points, sides, control);
  double highest = 0;
  for (std::size_t i = 0; i < points.size();) {
    const double x = points.x[i];
    tournament.advance(x);
    if (open) highest = std::max(highest, tournament.highest(x));
    for (; i < points.size() && points.x[i] == x; ++i) {
      if (i % between_checks == 0) control.check();
      tournament.enter(points.level[i] + (open ? 1 : 0), x);
    }
    if (!open) highest = std::max(highest, tournament.highest(x));
  }
  tournament.advance(1);
  return std::max(highest, tournament.highest(1));
}

}  // namespace wellspaced

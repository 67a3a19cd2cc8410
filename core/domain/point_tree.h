#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/control.h"
#include "core/point_set.h"
#include "core/vec.h"

namespace wellspaced {

/// The points of a planar domain in a balanced k-d tree, however unevenly they lie: who is in a window, who
/// is nearest. It knows of no periodic images; who wants them asks once an image.
///
/// The tree has its own order, in which near points are near in memory: "place k" is a point in it. The order
/// depends on the points only. Requires of the points: finite. Cost: built in O(n log n), about .2 us a
/// point; 32 to 40 bytes a point. Thread safety: immutable after construction.
class PointTree {
 public:
  /// A closed rectangle.
  struct Window {
    Vec2 low, high;
  };

  /// Errors: cancelled, deadline_exceeded.
  PointTree(const PointSet& points, const Control& control);

  std::size_t size() const { return places_.size(); }
  Vec2 at(std::size_t place) const { return places_[place].at; }
  std::uint32_t original(std::size_t place) const { return places_[place].original; }  ///< index in the set

  /// Calls use(place) for every point in the window, in the tree's order. Cost: O(sqrt(n) + points found) at
  /// worst, O(log n + points found) for windows that are about square.
  template <class Use>
  void visit(const Window& window, const Use& use) const {
    visit({1, 0, places_.size()}, window, use);
  }

  /// The place of the point nearest to p; of several, the one that comes first in the set. Requires: a point.
  std::size_t nearest(Vec2 p) const;

 private:
  static constexpr std::size_t leaf_size = 8;

  struct Place {
    Vec2 at;
    std::uint32_t original;
  };
  /// Of a heap: children of `id` are 2 id and 2 id + 1; it holds the places [begin, end).
  struct Node {
    std::size_t id, begin, end;
    std::size_t middle() const { return begin + (end - begin) / 2; }
    Node first() const { return {2 * id, begin, middle()}; }
    Node second() const { return {2 * id + 1, middle(), end}; }
  };
  struct Nearest;

  bool is_leaf(Node node) const { return node.id >= first_leaf_; }
  void build(Node node, const Control& control);
  void improve(Node node, Nearest& nearest) const;

  template <class Use>
  void visit(Node node, const Window& window, const Use& use) const {
    const Window& box = boxes_[node.id];
    if (box.low.x > window.high.x || box.high.x < window.low.x || box.low.y > window.high.y ||
        box.high.y < window.low.y)
      return;
    if (!is_leaf(node)) {
      visit(node.first(), window, use);
      visit(node.second(), window, use);
      return;
    }
    for (std::size_t k = node.begin; k < node.end; ++k) {
      const Vec2 p = places_[k].at;
      if (p.x >= window.low.x && p.x <= window.high.x && p.y >= window.low.y && p.y <= window.high.y) use(k);
    }
  }

  std::size_t first_leaf_ = 1;  ///< leaves are all on one level
  std::vector<Place> places_;
  std::vector<Window> boxes_;  ///< of each node, around its points
};

}  // namespace wellspaced

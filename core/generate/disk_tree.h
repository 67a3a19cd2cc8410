#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/point_set.h"

namespace wellspaced {

/// A tree of disks around points that are added one by one, for radii that differ by orders of magnitude:
/// where a grid of any one size has crowded cells here and countless empty ones there.
///
/// Guarantees: `any` sees every point in reach whose nearest image is within a period, whatever the radii.
/// Cost: add and any in about O(log n + what is in reach). Thread safety: const calls from many threads.
class DiskTree {
 public:
  /// Requires: both outlive the tree; none of the points is in it yet.
  DiskTree(const PointSet& points, const std::vector<double>& radii);

  /// Sample i, in its place, with its radius.
  void add(std::uint32_t i);

  /// Whether `accept(neighbor)` holds for one of the images that are no farther from base than
  /// `reach(radius)` says of their disk's radius. Requires: reach never falls as the radius grows.
  template <class Reach, class Accept>
  bool any(Vec3 base, const Reach& reach, const Accept& accept) const {
    if (nodes_.empty()) return false;
    for (const Vec3 shift : shifts_)
      if (any_of_images(base, shift, reach, accept)) return true;
    return false;
  }

 private:
  static constexpr std::uint32_t none = ~0u;
  static constexpr std::size_t full = 8;  ///< points in a leaf

  /// Its disks: those of its two children, which follow each other, or of a list of points.
  struct Node {
    Vec3 low, high;      ///< of the points
    double largest = 0;  ///< radius
    std::uint32_t children = none;
    std::uint32_t first = none;  ///< point
    std::uint8_t count = 0, axis = 0;
    double middle = 0;  ///< along the axis; the points below it are in the first child
  };

  void put(std::uint32_t node, std::uint32_t i);
  void split(std::uint32_t node);
  std::uint32_t child_for(const Node& node, Vec3 p) const;

  template <class Reach, class Accept>
  bool any_of_images(Vec3 base, Vec3 shift, const Reach& reach, const Accept& accept) const;

  const PointSet* points_;
  const std::vector<double>* radii_;
  bool has_hints_;
  std::vector<Vec3> shifts_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> next_, hints_;  ///< of each point: the next one of its leaf
};

template <class Reach, class Accept>
bool DiskTree::any_of_images(Vec3 base, Vec3 shift, const Reach& reach, const Accept& accept) const {
  // The same arithmetic as for points, which rounds no box away from what it holds.
  const auto gap = [](double low, double high, double at, double by) {
    return std::max({0.0, (low - at) + by, -((high - at) + by)});
  };
  const auto is_far = [&](const Node& n) {
    const double farthest = reach(n.largest);
    return norm2(Vec3{gap(n.low.x, n.high.x, base.x, shift.x), gap(n.low.y, n.high.y, base.y, shift.y),
                      gap(n.low.z, n.high.z, base.z, shift.z)}) > farthest * farthest;
  };
  std::vector<std::uint32_t> open = {0};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (is_far(node)) continue;
    if (node.children != none) {
      open.push_back(node.children + 1);
      open.push_back(node.children);
      continue;
    }
    for (std::uint32_t i = node.first; i != none; i = next_[i]) {
      const Vec3 offset = ((*points_)[i] - base) + shift;
      const double farthest = reach((*radii_)[i]);
      if (norm2(offset) > farthest * farthest) continue;
      if (accept(Neighbor{offset, i, has_hints_ ? hints_[i] : Neighbor::no_hint})) return true;
    }
  }
  return false;
}

}  // namespace wellspaced

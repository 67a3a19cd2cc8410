#include "core/generate/disk_tree.h"

namespace wellspaced {
namespace {

double along(Vec3 p, std::uint8_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

std::uint8_t longest_axis(Vec3 size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

/// To the images that may be the nearest ones; the points themselves first.
std::vector<Vec3> shifts_of(const Box& box) {
  std::vector<Vec3> shifts;
  for (const double y : {0.0, -1.0, 1.0})
    for (const double x : {0.0, -1.0, 1.0})
      if ((x == 0 || box.periodic[0]) && (y == 0 || box.periodic[1]))
        shifts.push_back({x * box.size.x, y * box.size.y, 0});
  return shifts;
}

}  // namespace

DiskTree::DiskTree(const PointSet& points, const std::vector<double>& radii)
    : points_(&points),
      radii_(&radii),
      has_hints_(points.domain->has_hints()),
      shifts_(shifts_of(points.domain->box())) {}

void DiskTree::add(std::uint32_t i) {
  const Vec3 p = (*points_)[i];
  next_.resize(i + std::size_t{1}, none);
  if (has_hints_) {
    hints_.resize(next_.size(), Neighbor::no_hint);
    hints_[i] = points_->domain->hint(p);
  }
  if (nodes_.empty()) nodes_.push_back({p, p});
  put(0, i);
}

std::uint32_t DiskTree::child_for(const Node& node, Vec3 p) const {
  return node.children + (along(p, node.axis) < node.middle ? 0 : 1);
}

/// A child that is new may be empty: its box is that of its first point.
void DiskTree::put(std::uint32_t at, std::uint32_t i) {
  const Vec3 p = (*points_)[i];
  for (;; at = child_for(nodes_[at], p)) {
    Node& node = nodes_[at];
    const bool is_empty = node.children == none && node.count == 0;
    node.low =
        is_empty ? p : Vec3{std::min(node.low.x, p.x), std::min(node.low.y, p.y), std::min(node.low.z, p.z)};
    node.high =
        is_empty ? p
                 : Vec3{std::max(node.high.x, p.x), std::max(node.high.y, p.y), std::max(node.high.z, p.z)};
    node.largest = std::max(node.largest, (*radii_)[i]);
    if (node.children == none) break;
  }
  next_[i] = nodes_[at].first;
  nodes_[at].first = i;
  if (++nodes_[at].count > full) split(at);
}

void DiskTree::split(std::uint32_t at) {
  Node& whole = nodes_[at];
  const Vec3 size = whole.high - whole.low;
  whole.axis = longest_axis(size);
  whole.middle = along(whole.low, whole.axis) + along(size, whole.axis) / 2;
  if (!(whole.middle > along(whole.low, whole.axis))) {  // there is nothing between them
    whole.count = full;
    return;
  }
  std::uint32_t i = whole.first;
  whole.children = static_cast<std::uint32_t>(nodes_.size());
  whole.first = none;
  whole.count = 0;
  nodes_.resize(nodes_.size() + 2);
  while (i != none) {
    const std::uint32_t following = next_[i];
    put(child_for(nodes_[at], (*points_)[i]), i);
    i = following;
  }
}

}  // namespace wellspaced

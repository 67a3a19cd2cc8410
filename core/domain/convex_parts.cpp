#include "core/domain/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace wellspaced {
namespace {

/// The part of the segment from a to b with low <= coordinate <= high.
bool clip_axis(double Vec2::*axis, double low, double high, std::array<Vec2, 2>& segment) {
  auto& [a, b] = segment;
  const Vec2 from = a, d = b - a;
  if (std::max(a.*axis, b.*axis) < low || std::min(a.*axis, b.*axis) > high) return false;
  for (Vec2* end : {&a, &b}) {
    const double limit = std::clamp((*end).*axis, low, high);
    if (limit == (*end).*axis) continue;
    *end = from + ((limit - from.*axis) / (d.*axis)) * d;
    (*end).*axis = limit;
  }
  return true;
}

}  // namespace

double ConvexParts::Part::at(double x) const {
  if (x <= left.x) return left.y;
  if (x >= right.x) return right.y;
  const double y = left.y + (x - left.x) * ((right.y - left.y) / (right.x - left.x));
  const auto [low, high] = std::minmax(left.y, right.y);
  return std::clamp(y, low, high);
}

void ConvexParts::clip(std::span<const Line> lines) {
  parts_.clear();
  for (const Line& line : lines) {
    std::array<Vec2, 2> s{line.from, line.to};
    const bool rightward = s[0].x <= s[1].x;
    if (!rightward) std::swap(s[0], s[1]);
    if (!clip_axis(&Vec2::x, rectangle_.low.x, rectangle_.high.x, s)) continue;
    if (!clip_axis(&Vec2::y, rectangle_.low.y, rectangle_.high.y, s)) continue;
    for (Vec2& p : s) p.x = std::clamp(p.x, rectangle_.low.x, rectangle_.high.x);
    parts_.push_back({s[0], s[1], rightward});
  }
}

void ConvexParts::collect_stops() {
  stops_ = {rectangle_.low.x, rectangle_.high.x};
  for (const Part& part : parts_) {
    stops_.push_back(part.left.x);
    stops_.push_back(part.right.x);
  }
  std::sort(stops_.begin(), stops_.end());
  stops_.erase(std::unique(stops_.begin(), stops_.end()), stops_.end());
}

/// Asked in the middle of the highest gap, where rounding can't hide a line; beside lines that are too steep
/// for that, the nearest line's direction tells.
bool ConvexParts::lowest_is_inside(double left, double right) const {
  std::size_t best = 1;
  const auto height = [&](std::size_t k) {
    return crossings_[k].left + crossings_[k].right - crossings_[k - 1].left - crossings_[k - 1].right;
  };
  for (std::size_t k = 2; k < crossings_.size(); ++k)
    if (height(k) > height(best)) best = k;
  bool inside = false;
  if (right - left > narrow_ || crossings_.size() == 2) {
    inside = is_inside_({(left + right) / 2, (crossings_[best].left + crossings_[best].right +
                                              crossings_[best - 1].left + crossings_[best - 1].right) /
                                                 4});
  } else {
    inside = best > 1 ? parts_[static_cast<std::size_t>(crossings_[best - 1].part)].rightward
                      : !parts_[static_cast<std::size_t>(crossings_[best].part)].rightward;
  }
  return inside == (best % 2 == 1);
}

void ConvexParts::cut_slab(double left, double right) {
  crossings_ = {{bottom, rectangle_.low.y, rectangle_.low.y}};
  for (std::size_t k = 0; k < parts_.size(); ++k)
    if (parts_[k].left.x <= left && parts_[k].right.x >= right)
      crossings_.push_back({static_cast<int>(k), parts_[k].at(left), parts_[k].at(right)});
  std::sort(crossings_.begin() + 1, crossings_.end(), [](const Crossing& a, const Crossing& b) {
    const double sum_a = a.left + a.right, sum_b = b.left + b.right;
    return sum_a != sum_b ? sum_a < sum_b : a.part < b.part;
  });
  crossings_.push_back({top, rectangle_.high.y, rectangle_.high.y});
  next_.clear();
  for (std::size_t k = lowest_is_inside(left, right) ? 1 : 2; k < crossings_.size(); k += 2)
    add(crossings_[k - 1], crossings_[k], left, right);
  done_.insert(done_.end(), open_.begin(), open_.end());
  open_.swap(next_);
}

/// One between the same lines goes on.
void ConvexParts::add(const Crossing& below, const Crossing& above, double left, double right) {
  if (above.left <= below.left && above.right <= below.right) return;
  Trapezoid t{below.part,  above.part,
              left,        right,
              below.left,  std::max(below.left, above.left),
              below.right, std::max(below.right, above.right)};
  const auto same = [&](const Trapezoid& o) { return o.below == t.below && o.above == t.above; };
  const auto found = std::find_if(open_.begin(), open_.end(), same);
  if (found != open_.end() && found->right == left) {
    t.left = found->left;
    t.low_left = found->low_left;
    t.high_left = found->high_left;
    open_.erase(found);
  }
  next_.push_back(t);
}

void ConvexParts::emit(const Trapezoid& t, ChartPieces& out) {
  out.corners.push_back({t.left, t.low_left});
  out.corners.push_back({t.right, t.low_right});
  if (t.high_right > t.low_right) out.corners.push_back({t.right, t.high_right});
  if (t.high_left > t.low_left) out.corners.push_back({t.left, t.high_left});
  out.close();
}

void ConvexParts::cut(const Rectangle& rectangle, std::span<const Line> lines, ChartPieces& out) {
  rectangle_ = rectangle;
  done_.clear();
  open_.clear();
  clip(lines);
  collect_stops();
  for (std::size_t k = 1; k < stops_.size(); ++k) cut_slab(stops_[k - 1], stops_[k]);
  done_.insert(done_.end(), open_.begin(), open_.end());
  const auto full = [&](const Trapezoid& t) {
    return t.below == bottom && t.above == top && t.left == rectangle.low.x && t.right == rectangle.high.x;
  };
  whole_ = done_.size() == 1 && full(done_.front());
  for (const Trapezoid& t : done_) emit(t, out);
}

}  // namespace wellspaced

#include "core/domain/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

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
  Vec2 extent{};
  for (const Line& line : lines)
    extent = extent + Vec2{std::abs(line.to.x - line.from.x), std::abs(line.to.y - line.from.y)};
  transposed_ = extent.x > extent.y;
  rectangle_ = {given(rectangle_.low), given(rectangle_.high)};
  parts_.clear();
  for (const Line& line : lines) {
    std::array<Vec2, 2> s{given(line.from), given(line.to)};
    const bool rightward = s[0].x <= s[1].x;
    if (!rightward) std::swap(s[0], s[1]);
    if (!clip_axis(&Vec2::x, rectangle_.low.x, rectangle_.high.x, s)) continue;
    if (!clip_axis(&Vec2::y, rectangle_.low.y, rectangle_.high.y, s)) continue;
    for (Vec2& p : s) p.x = std::clamp(p.x, rectangle_.low.x, rectangle_.high.x);
    parts_.push_back({s[0], s[1], rightward != transposed_});
  }
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
    return std::tie(a.left.x, a.left.y, a.right.x, a.right.y) <
           std::tie(b.left.x, b.left.y, b.right.x, b.right.y);
  });
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
    inside = is_inside_(given({(left + right) / 2, (crossings_[best].left + crossings_[best].right +
                                                    crossings_[best - 1].left + crossings_[best - 1].right) /
                                                       4}));
  } else {
    inside = best > 1 ? parts_[static_cast<std::size_t>(crossings_[best - 1].part)].inside_above
                      : !parts_[static_cast<std::size_t>(crossings_[best].part)].inside_above;
  }
  return inside == (best % 2 == 1);
}

/// Parts are in the order of their left ends, and slabs go to the right.
void ConvexParts::collect_crossings(double left, double right) {
  for (; next_part_ < parts_.size() && parts_[next_part_].left.x <= left; ++next_part_)
    active_.push_back(static_cast<int>(next_part_));
  const auto at = [&](int k) -> const Part& { return parts_[static_cast<std::size_t>(k)]; };
  std::erase_if(active_, [&](int k) { return at(k).right.x < right; });
  crossings_ = {{bottom, rectangle_.low.y, rectangle_.low.y}};
  for (const int k : active_) crossings_.push_back({k, at(k).at(left), at(k).at(right)});
  std::sort(crossings_.begin() + 1, crossings_.end(), [](const Crossing& a, const Crossing& b) {
    const double sum_a = a.left + a.right, sum_b = b.left + b.right;
    return sum_a != sum_b ? sum_a < sum_b : a.part < b.part;
  });
  crossings_.push_back({top, rectangle_.high.y, rectangle_.high.y});
  work_ += static_cast<double>(crossings_.size());
}

void ConvexParts::cut_slab(double left, double right) {
  collect_crossings(left, right);
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
  const std::size_t first = out.corners.size();
  out.corners.push_back(given({t.left, t.low_left}));
  out.corners.push_back(given({t.right, t.low_right}));
  if (t.high_right > t.low_right) out.corners.push_back(given({t.right, t.high_right}));
  if (t.high_left > t.low_left) out.corners.push_back(given({t.left, t.high_left}));
  if (transposed_) std::reverse(out.corners.begin() + static_cast<std::ptrdiff_t>(first), out.corners.end());
  out.close();
}

void ConvexParts::cut(const Rectangle& rectangle, std::span<const Line> lines, ChartPieces& out) {
  rectangle_ = rectangle;
  done_.clear();
  open_.clear();
  active_.clear();
  next_part_ = 0;
  clip(lines);
  collect_stops();
  for (std::size_t k = 1; k < stops_.size(); ++k) cut_slab(stops_[k - 1], stops_[k]);
  done_.insert(done_.end(), open_.begin(), open_.end());
  const auto full = [&](const Trapezoid& t) {
    return t.below == bottom && t.above == top && t.left == rectangle_.low.x && t.right == rectangle_.high.x;
  };
  whole_ = done_.size() == 1 && full(done_.front());
  for (const Trapezoid& t : done_) emit(t, out);
}

}  // namespace wellspaced

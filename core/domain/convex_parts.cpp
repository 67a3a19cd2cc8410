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
  const auto [low, high] = std::minmax(left.y, right.y);
  return std::clamp(left.y + (x - left.x) * slope, low, high);
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
    const double slope = s[1].x > s[0].x ? (s[1].y - s[0].y) / (s[1].x - s[0].x) : 0;
    parts_.push_back({s[0], s[1], slope, rightward != transposed_});
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

double ConvexParts::twice_height(std::size_t gap) const {
  const Crossing &below = crossings_[gap - 1], &above = crossings_[gap];
  return above.left + above.right - below.left - below.right;
}

/// Told by the direction of a line beside the highest gap, if no other line is so close to it that rounding
/// may have changed their order. If there is none, that is asked in the middle of the gap, where rounding
/// can't hide a line; but in slabs too narrow for that the order doesn't matter.
bool ConvexParts::lowest_is_inside(double left, double right) const {
  std::size_t best = 1;
  const std::size_t last = crossings_.size() - 1;
  for (std::size_t k = 2; k <= last; ++k)
    if (twice_height(k) > twice_height(best)) best = k;
  const auto part = [&](std::size_t k) -> const Part& {
    return parts_[static_cast<std::size_t>(crossings_[k].part)];
  };
  const double width = right - left, side = rectangle_.high.y - rectangle_.low.y;
  const double apart = side * (1e-9 + narrow_ / width);
  const bool is_narrow = width <= narrow_;
  bool inside = false;
  if (best > 1 && (is_narrow || best == 2 || twice_height(best - 1) > apart))
    inside = part(best - 1).inside_above;
  else if (best < last && (is_narrow || best + 1 == last || twice_height(best + 1) > apart))
    inside = !part(best).inside_above;
  else
    inside = is_inside_(given({(left + right) / 2, (crossings_[best].left + crossings_[best].right +
                                                    crossings_[best - 1].left + crossings_[best - 1].right) /
                                                       4}));
  return inside == (best % 2 == 1);
}

/// Parts are in the order of their left ends, and slabs go to the right. Lines that were in order in the last
/// slab are so in this one, so that little is left to sort.
void ConvexParts::collect_crossings(double left, double right) {
  for (; next_part_ < parts_.size() && parts_[next_part_].left.x <= left; ++next_part_)
    active_.push_back(static_cast<int>(next_part_));
  crossings_ = {{bottom, rectangle_.low.y, rectangle_.low.y}};
  for (const int k : active_) {
    const Part& part = parts_[static_cast<std::size_t>(k)];
    if (part.right.x < right) continue;
    crossings_.push_back({k, part.at(left), part.at(right)});
    for (std::size_t i = crossings_.size() - 1; i > 1 && crossings_[i].is_below(crossings_[i - 1]); --i)
      std::swap(crossings_[i], crossings_[i - 1]);
  }
  active_.clear();
  for (std::size_t i = 1; i < crossings_.size(); ++i) active_.push_back(crossings_[i].part);
  crossings_.push_back({top, rectangle_.high.y, rectangle_.high.y});
  work_ += static_cast<double>(crossings_.size());
}

void ConvexParts::cut_slab(double left, double right) {
  collect_crossings(left, right);
  next_.clear();
  next_open_ = 0;
  for (std::size_t k = lowest_is_inside(left, right) ? 1 : 2; k < crossings_.size(); k += 2)
    add(crossings_[k - 1], crossings_[k], left, right);
  for (const Trapezoid& t : open_)
    if (t.above != continued) done_.push_back(t);
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
  const auto found = std::find_if(open_.begin() + static_cast<std::ptrdiff_t>(next_open_), open_.end(), same);
  if (found != open_.end() && found->right == left) {
    t.left = found->left;
    t.low_left = found->low_left;
    t.high_left = found->high_left;
    found->above = continued;
    next_open_ = static_cast<std::size_t>(found - open_.begin()) + 1;  // both are in order, upward
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

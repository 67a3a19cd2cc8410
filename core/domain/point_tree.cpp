#include "core/domain/point_tree.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace wellspaced {

struct PointTree::Nearest {
  Vec2 p;
  std::size_t place = 0;
  double distance2 = std::numeric_limits<double>::infinity();
};

PointTree::PointTree(const PointSet& points, const Control& control) {
  while (first_leaf_ * leaf_size < points.size()) first_leaf_ *= 2;
  boxes_.resize(2 * first_leaf_);
  places_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    places_[i] = {{points[i].x, points[i].y}, static_cast<std::uint32_t>(i)};
  build({1, 0, places_.size()}, control);
}

void PointTree::build(Node node, const Control& control) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Window& box = boxes_[node.id] = {{far, far}, {-far, -far}};
  const auto begin = places_.begin() + static_cast<std::ptrdiff_t>(node.begin),
             middle = places_.begin() + static_cast<std::ptrdiff_t>(node.middle()),
             end = places_.begin() + static_cast<std::ptrdiff_t>(node.end);
  for (auto place = begin; place != end; ++place) {
    box.low = {std::min(box.low.x, place->at.x), std::min(box.low.y, place->at.y)};
    box.high = {std::max(box.high.x, place->at.x), std::max(box.high.y, place->at.y)};
  }
  if (is_leaf(node)) {  // in an order that is no business of std::nth_element
    std::sort(begin, end, [](const Place& a, const Place& b) { return a.original < b.original; });
    return;
  }
  const bool wide = box.high.x - box.low.x > box.high.y - box.low.y;
  std::uint32_t comparisons = 0;
  std::nth_element(begin, middle, end, [&](const Place& a, const Place& b) {
    if (++comparisons % 65536 == 0) control.check();
    return wide ? std::tie(a.at.x, a.original) < std::tie(b.at.x, b.original)
                : std::tie(a.at.y, a.original) < std::tie(b.at.y, b.original);
  });
  build(node.first(), control);
  build(node.second(), control);
}

std::size_t PointTree::nearest(Vec2 p) const {
  Nearest nearest{p};
  improve({1, 0, places_.size()}, nearest);
  return nearest.place;
}

void PointTree::improve(Node node, Nearest& nearest) const {
  const Vec2 p = nearest.p;
  if (is_leaf(node)) {
    for (std::size_t k = node.begin; k < node.end; ++k) {
      const double d2 = norm2(places_[k].at - p);
      if (std::tie(d2, places_[k].original) < std::tie(nearest.distance2, places_[nearest.place].original)) {
        nearest.place = k;
        nearest.distance2 = d2;
      }
    }
    return;
  }
  const auto away2 = [&](Node part) {
    const Window& box = boxes_[part.id];
    return norm2(Vec2{std::max({box.low.x - p.x, p.x - box.high.x, 0.0}),
                      std::max({box.low.y - p.y, p.y - box.high.y, 0.0})});
  };
  const double first = away2(node.first()), second = away2(node.second());
  const bool turned = second < first;
  if (std::min(first, second) <= nearest.distance2) improve(turned ? node.second() : node.first(), nearest);
  if (std::max(first, second) <= nearest.distance2) improve(turned ? node.first() : node.second(), nearest);
}

}  // namespace wellspaced

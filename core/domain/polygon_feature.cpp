#include "core/domain/polygon_feature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <sstream>
#include <vector>

namespace wellspaced {
namespace {

struct Bounds {
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void add(const Bounds& o) {
    add(o.low);
    add(o.high);
  }
  double longer_side() const { return std::max(high.x - low.x, high.y - low.y); }
};

double distance(const Bounds& a, const Bounds& b) {
  const double x = std::max({0.0, a.low.x - b.high.x, b.low.x - a.high.x});
  const double y = std::max({0.0, a.low.y - b.high.y, b.low.y - a.high.y});
  return norm(Vec2{x, y});
}

/// A run of edges of a ring, or all edges of several rings.
struct Node {
  static constexpr std::size_t several = std::numeric_limits<std::size_t>::max();
  static constexpr std::int32_t none = -1;
  Bounds bounds;
  std::size_t ring = several;
  std::uint32_t first = 0, last = 0;  ///< edges
  std::int32_t left = none, right = none;
  bool is_edge() const { return left == none; }
};

class Search {
 public:
  Search(const PolygonRings& rings, const PolygonLocator& locator) : rings_(rings), locator_(locator) {
    for (const PolygonEdge& e : rings.edges()) length_to_.push_back(length_to_.back() + norm(e.to - e.from));
  }

  PolygonFeature run() {
    for (std::size_t k = 0; k < rings_.rings(); ++k)
      chains_.push_back(add_chain(k, rings_.first(k), rings_.first(k + 1)));
    for (std::size_t k = 0; k < chains_.size(); ++k) {
      const double across = nodes_[static_cast<std::size_t>(chains_[k])].bounds.longer_side();
      if (across < best_) best_ = across, smallest_ring_ = k;
    }
    within(add_rings(chains_));
    return {best_, description()};
  }

 private:
  const Node& node(std::int32_t k) const { return nodes_[static_cast<std::size_t>(k)]; }

  std::int32_t add(const Node& node) {
    nodes_.push_back(node);
    return static_cast<std::int32_t>(nodes_.size()) - 1;
  }
  std::int32_t add_chain(std::size_t ring, std::uint32_t first, std::uint32_t last) {
    Node chain;
    chain.ring = ring;
    chain.first = first;
    chain.last = last;
    if (last - first == 1) {
      chain.bounds.add(rings_.edges()[first].from);
      chain.bounds.add(rings_.edges()[first].to);
      return add(chain);
    }
    const std::uint32_t middle = first + (last - first) / 2;
    chain.left = add_chain(ring, first, middle);
    chain.right = add_chain(ring, middle, last);
    chain.bounds = node(chain.left).bounds;
    chain.bounds.add(node(chain.right).bounds);
    return add(chain);
  }
  std::int32_t add_rings(std::span<std::int32_t> chains) {
    if (chains.size() == 1) return chains[0];
    Node group;
    for (const std::int32_t k : chains) group.bounds.add(node(k).bounds);
    const Vec2 size = group.bounds.high - group.bounds.low;
    double Vec2::*const axis = size.x > size.y ? &Vec2::x : &Vec2::y;
    const std::size_t half = chains.size() / 2;
    std::nth_element(chains.begin(), chains.begin() + static_cast<std::ptrdiff_t>(half), chains.end(),
                     [&](std::int32_t a, std::int32_t b) {
                       const double p = node(a).bounds.low.*axis, q = node(b).bounds.low.*axis;
                       return p != q ? p < q : a < b;
                     });
    group.left = add_rings(chains.first(half));
    group.right = add_rings(chains.subspan(half));
    return add(group);
  }

  void within(std::int32_t k) {
    if (node(k).is_edge()) return;
    within(node(k).left);
    within(node(k).right);
    between(node(k).left, node(k).right);
  }

  void between(std::int32_t a, std::int32_t b) {
    const Node &p = node(a), &q = node(b);
    const double apart = distance(p.bounds, q.bounds);
    if (apart >= best_ || !is_much_farther(p, q, apart)) return;
    if (p.is_edge() && q.is_edge()) {
      compare(p.first, q.first);
      compare(q.first, p.first);
      return;
    }
    const bool split_a = q.is_edge() || (!p.is_edge() && p.bounds.longer_side() > q.bounds.longer_side());
    const std::int32_t whole = split_a ? b : a, left = split_a ? p.left : q.left,
                       right = split_a ? p.right : q.right;
    const bool left_first =
        distance(node(left).bounds, node(whole).bounds) < distance(node(right).bounds, node(whole).bounds);
    between(left_first ? left : right, whole);
    between(left_first ? right : left, whole);
  }

  /// Some places of them may be: more than 3 times as far apart along the boundary.
  bool is_much_farther(const Node& p, const Node& q, double apart) const {
    if (p.ring == Node::several || q.ring == Node::several || p.ring != q.ring) return true;
    const Node& early = p.first < q.first ? p : q;
    const Node& late = p.first < q.first ? q : p;
    const double onward = length_to_[late.last] - length_to_[early.first];
    const double back = ring_length(p.ring) - (length_to_[late.first] - length_to_[early.last]);
    return std::min(onward, back) > much * apart;
  }
  double ring_length(std::size_t k) const {
    return length_to_[rings_.first(k + 1)] - length_to_[rings_.first(k)];
  }

  /// The corner that edge e begins in, and edge f.
  void compare(std::uint32_t e, std::uint32_t f) {
    const Vec2 corner = rings_.edges()[e].from, from = rings_.edges()[f].from, to = rings_.edges()[f].to;
    if (corner == from || corner == to) return;
    const Vec2 d = to - from;
    const double part = std::clamp(dot(corner - from, d) / norm2(d), 0.0, 1.0);
    const Vec2 foot = from + part * d;
    const double apart = norm(foot - corner);
    if (apart >= best_) return;
    const std::size_t ring = rings_.ring_of(e);
    if (ring == rings_.ring_of(f)) {
      const double way = std::abs(length_to_[f] + part * norm(d) - length_to_[e]);
      if (std::min(way, ring_length(ring) - way) <= much * apart) return;
    }
    best_ = apart;
    corner_ = e;
    edge_ = f;
    middle_ = 0.5 * (corner + foot);
    is_passage_ = true;
  }

  std::string description() const {
    std::ostringstream text;
    text.precision(3);
    const auto ring = [&](std::size_t k) { return k == 0 ? "the outer ring" : "hole " + std::to_string(k); };
    if (!is_passage_) {
      text << ring(smallest_ring_) << " is " << best_ << " across";
      return text.str();
    }
    const std::size_t k = rings_.ring_of(corner_), j = rings_.ring_of(edge_);
    text << (locator_.is_just_inside(middle_) ? "the passage" : "the wall") << " between vertex "
         << rings_.given_corner(corner_);
    if (j != k) text << " of " << ring(k);
    text << " and edge " << rings_.given_edge(edge_) << " of " << ring(j) << " is " << best_ << " wide";
    return text.str();
  }

  static constexpr double much = 3;
  const PolygonRings& rings_;
  const PolygonLocator& locator_;
  std::vector<double> length_to_{0.0};  ///< each edge, through all rings
  std::vector<Node> nodes_;
  std::vector<std::int32_t> chains_;
  double best_ = HUGE_VAL;
  bool is_passage_ = false;
  std::size_t smallest_ring_ = 0;
  std::uint32_t corner_ = 0, edge_ = 0;
  Vec2 middle_;
};

}  // namespace

PolygonFeature find_smallest_feature(const PolygonRings& rings, const PolygonLocator& locator) {
  return Search(rings, locator).run();
}

}  // namespace wellspaced

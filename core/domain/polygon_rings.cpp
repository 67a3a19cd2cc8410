#include "core/domain/polygon_rings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>

#include "core/domain/exact.h"
#include "core/domain/torus.h"
#include "core/error.h"

namespace wellspaced {
namespace {

std::string at(const std::string& ring, std::size_t vertex) { return ring + "/" + std::to_string(vertex); }

void require_finite(const std::vector<Vec2>& ring, const std::string& where) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!std::isfinite(ring[i].x) || !std::isfinite(ring[i].y))
      throw Error(ErrorCode::invalid_parameters, "a coordinate of this vertex is not a finite number",
                  at(where, i));
}

std::size_t distinct(std::vector<Vec2> ring) {
  std::sort(ring.begin(), ring.end(), lexicographically_less);
  return static_cast<std::size_t>(std::unique(ring.begin(), ring.end()) - ring.begin());
}

void require_edges(const std::vector<Vec2>& ring, const std::string& where) {
  if (distinct(ring) < 3)
    throw Error(ErrorCode::degenerate_input,
                "a ring has at least 3 different vertices; this one has " + std::to_string(distinct(ring)),
                where);
  for (std::size_t i = 1; i < ring.size(); ++i)
    if (ring[i] == ring[i - 1])
      throw Error(ErrorCode::degenerate_input, "the vertex repeats the one before it; leave it out",
                  at(where, i));
  if (ring.front() == ring.back())
    throw Error(ErrorCode::degenerate_input,
                "the vertex repeats the first one, and so does the one that closes the ring; leave it out",
                at(where, ring.size() - 1));
}

void require_area(const std::vector<Vec2>& ring, const std::string& where) {
  const auto on_line = [&](Vec2 p) { return orientation(ring[0], ring[1], p) == 0; };
  if (std::all_of(ring.begin(), ring.end(), on_line))
    throw Error(ErrorCode::degenerate_input, "all vertices of the ring are on one line: it has no area",
                where);
}

/// Of a ring that doesn't cross itself: by the turn at its first vertex in lexicographic order, which is
/// convex.
bool is_clockwise(const std::vector<Vec2>& ring) {
  const auto first = static_cast<std::size_t>(
      std::min_element(ring.begin(), ring.end(), lexicographically_less) - ring.begin());
  const std::size_t n = ring.size();
  return orientation(ring[(first + n - 1) % n], ring[first], ring[(first + 1) % n]) < 0;
}

}  // namespace

PolygonRings::PolygonRings(const std::vector<std::vector<Vec2>>& rings) {
  if (rings.empty())
    throw Error(ErrorCode::invalid_parameters, "a polygon has at least one ring, the outer one", "/rings");
  std::size_t total = 0;
  for (const auto& ring : rings) total += ring.size();
  if (total > std::numeric_limits<std::uint32_t>::max() / 4)
    throw Error(ErrorCode::invalid_parameters, "a polygon has at most 10^9 vertices", "/rings");
  for (const auto& ring : rings) add(ring);
  measure();
}

void PolygonRings::add(std::vector<Vec2> ring) {
  const std::size_t k = rings();
  require_finite(ring, where(k));
  if (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  require_edges(ring, where(k));
  require_area(ring, where(k));
  reversed_.push_back(is_clockwise(ring) == (k == 0));
  if (reversed_.back()) std::reverse(ring.begin() + 1, ring.end());
  for (std::size_t i = 0; i < ring.size(); ++i) edges_.push_back({ring[i], ring[(i + 1) % ring.size()]});
  first_.push_back(static_cast<std::uint32_t>(edges_.size()));
}

void PolygonRings::measure() {
  Vec2 high = low_ = edges_[0].from;
  for (std::uint32_t e = 0; e < first(1); ++e) {
    const Vec2 p = edges_[e].from;
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  size_ = high - low_;
  high_ = high;
  const double largest = std::max({std::abs(low_.x), std::abs(low_.y), std::abs(high.x), std::abs(high.y)});
  ulp_ = std::nextafter(largest, HUGE_VAL) - largest;
  const auto [shorter, longer] = std::minmax(size_.x, size_.y);
  if (!(shorter >= Torus::min_side && longer <= Torus::max_side)) {
    std::ostringstream text;
    text << "the ring is " << size_.x << " wide and " << size_.y
         << " high; both must be from 1e-6 to 1e6: choose another unit of length";
    throw Error(ErrorCode::invalid_parameters, text.str(), where(0));
  }
  if (longer > Torus::max_aspect * shorter)
    throw Error(ErrorCode::invalid_parameters,
                "the longer side of the ring's box is more than 1000 times the shorter one; cut the polygon "
                "into less elongated ones",
                where(0));
  for (std::size_t k = 1; k < rings(); ++k) require_in_box(k);
}

/// What is left for the grid to find is inside its squares then.
void PolygonRings::require_in_box(std::size_t k) const {
  const auto is_in = [&](Vec2 p) {
    return p.x >= low_.x && p.y >= low_.y && p.x <= high_.x && p.y <= high_.y;
  };
  const auto corners = std::span(edges_).subspan(first(k), first(k + 1) - first(k));
  if (std::none_of(corners.begin(), corners.end(), [&](const PolygonEdge& e) { return is_in(e.from); }))
    throw Error(ErrorCode::degenerate_input,
                "the hole is outside the outer ring, which is the first one; leave it out, or make it a "
                "polygon of its own",
                where(k));
  std::uint32_t out = first(k + 1);  // the first one as they came
  for (std::uint32_t e = first(k); e < first(k + 1); ++e)
    if (!is_in(edges_[e].from) && (out == first(k + 1) || given_corner(e) < given_corner(out))) out = e;
  if (out < first(k + 1))
    throw Error(ErrorCode::degenerate_input,
                "this vertex of the hole is outside the outer ring, which is the first one; move it inside, "
                "or leave the hole out",
                where_corner(out));
}

std::size_t PolygonRings::ring_of(std::uint32_t edge) const {
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), edge) - first_.begin()) - 1;
}

std::uint32_t PolygonRings::next(std::uint32_t edge) const {
  const std::size_t k = ring_of(edge);
  return edge + 1 == first(k + 1) ? first(k) : edge + 1;
}

std::uint32_t PolygonRings::previous(std::uint32_t edge) const {
  const std::size_t k = ring_of(edge);
  return (edge == first(k) ? first(k + 1) : edge) - 1;
}

std::uint32_t PolygonRings::given_edge(std::uint32_t edge) const {
  const std::size_t k = ring_of(edge);
  const std::uint32_t i = edge - first(k), n = first(k + 1) - first(k);
  return reversed_[k] ? n - 1 - i : i;
}

std::uint32_t PolygonRings::given_corner(std::uint32_t corner) const {
  const std::size_t k = ring_of(corner);
  const std::uint32_t i = corner - first(k), n = first(k + 1) - first(k);
  return reversed_[k] && i > 0 ? n - i : i;
}

std::string PolygonRings::where_corner(std::uint32_t corner) const {
  return at(where(ring_of(corner)), given_corner(corner));
}

}  // namespace wellspaced

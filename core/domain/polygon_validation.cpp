#include "core/domain/polygon_validation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "core/domain/exact.h"
#include "core/error.h"

namespace wellspaced {
namespace {

/// The rectangle of two points holds c.
bool in_box(Vec2 a, Vec2 b, Vec2 c) {
  return std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= c.y &&
         c.y <= std::max(a.y, b.y);
}

bool boxes_apart(const PolygonEdge& e, const PolygonEdge& f) {
  return std::max(e.from.x, e.to.x) < std::min(f.from.x, f.to.x) ||
         std::max(f.from.x, f.to.x) < std::min(e.from.x, e.to.x) ||
         std::max(e.from.y, e.to.y) < std::min(f.from.y, f.to.y) ||
         std::max(f.from.y, f.to.y) < std::min(e.from.y, e.to.y);
}

/// Of two edges: on which side of one the ends of the other are.
struct Sides {
  Sides(const PolygonEdge& e, const PolygonEdge& f)
      : from_of_f(orientation(e.from, e.to, f.from)),
        to_of_f(orientation(e.from, e.to, f.to)),
        from_of_e(orientation(f.from, f.to, e.from)),
        to_of_e(orientation(f.from, f.to, e.to)) {}
  bool cross() const { return from_of_f * to_of_f < 0 && from_of_e * to_of_e < 0; }
  bool on_one_line() const { return from_of_f == 0 && to_of_f == 0; }
  int from_of_f, to_of_f, from_of_e, to_of_e;
};

bool meet(const PolygonEdge& e, const PolygonEdge& f) {
  if (boxes_apart(e, f)) return false;
  const Sides s(e, f);
  return s.cross() || (s.from_of_f == 0 && in_box(e.from, e.to, f.from)) ||
         (s.to_of_f == 0 && in_box(e.from, e.to, f.to)) ||
         (s.from_of_e == 0 && in_box(f.from, f.to, e.from)) || (s.to_of_e == 0 && in_box(f.from, f.to, e.to));
}

/// f comes after e and goes back on it.
bool is_spike(const PolygonEdge& e, const PolygonEdge& f) {
  return orientation(e.from, e.to, f.to) == 0 &&
         lexicographically_less(e.from, e.to) == lexicographically_less(f.to, e.to);
}

class Contacts {
 public:
  Contacts(const PolygonRings& rings, const EdgeGrid& grid) : rings_(rings), grid_(grid) {
    next_.resize(rings.edges().size());
    for (std::size_t k = 0; k < rings.rings(); ++k)
      for (std::uint32_t e = rings.first(k); e < rings.first(k + 1); ++e)
        next_[e] = e + 1 == rings.first(k + 1) ? rings.first(k) : e + 1;
  }

  /// The first pair of edges that must not meet and do.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> first() const {
    std::optional<std::pair<std::uint32_t, std::uint32_t>> found;
    for (std::size_t square = 0; square < grid_.squares(); ++square) {
      const auto edges = grid_.edges_in(square);
      for (std::size_t j = 1; j < edges.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
          const std::pair pair(edges[i], edges[j]);
          if ((!found || pair < *found) && is_contact(pair.first, pair.second)) found = pair;
        }
    }
    return found;
  }

 private:
  bool is_contact(std::uint32_t e, std::uint32_t f) const {
    const auto& edges = rings_.edges();
    if (next_[e] == f) return is_spike(edges[e], edges[f]);
    if (next_[f] == e) return is_spike(edges[f], edges[e]);
    return meet(edges[e], edges[f]);
  }

  const PolygonRings& rings_;
  const EdgeGrid& grid_;
  std::vector<std::uint32_t> next_;
};

std::string place(Vec2 p) {
  std::ostringstream text;
  text.precision(10);
  text << "(" << p.x << ", " << p.y << ")";
  return text.str();
}

Vec2 crossing(const PolygonEdge& e, const PolygonEdge& f) {
  const Vec2 d = e.to - e.from, g = f.to - f.from;
  return e.from + (cross(f.from - e.from, g) / cross(d, g)) * d;
}

/// Says of two edges that meet what they do, and in which corner or at which edge.
class Refusal {
 public:
  Refusal(const PolygonRings& rings, std::uint32_t e, std::uint32_t f)
      : rings_(rings), e_(e), f_(f), ring_e_(rings.ring_of(e)), ring_f_(rings.ring_of(f)) {}

  [[noreturn]] void report() const {
    const PolygonEdge e = rings_.edges()[e_], f = rings_.edges()[f_];
    if (rings_.next(e_) == f_) spike(f_);
    if (rings_.next(f_) == e_) spike(e_);
    const Sides sides(e, f);
    if (sides.cross())
      refuse(start_of(f_), name(f_) + " crosses " + other(e_) + " at " + place(crossing(e, f)) +
                               (ring_e_ == ring_f_ ? "; reorder or move their vertices"
                                                   : "; rings must be apart: move it, or merge the rings"));
    if (sides.on_one_line()) along();
    for (const std::uint32_t c : {f_, rings_.next(f_)})
      for (const std::uint32_t d : {e_, rings_.next(e_)})
        if (corner(c) == corner(d)) touch(c, vertex(d));
    for (const std::uint32_t c : {f_, rings_.next(f_)})
      if (orientation(e.from, e.to, corner(c)) == 0 && in_box(e.from, e.to, corner(c))) touch(c, other(e_));
    for (const std::uint32_t c : {e_, rings_.next(e_)})
      if (orientation(f.from, f.to, corner(c)) == 0 && in_box(f.from, f.to, corner(c))) touch(c, other(f_));
    refuse(f_, name(f_) + " meets " + other(e_));
  }

 private:
  Vec2 corner(std::uint32_t c) const { return rings_.edges()[c].from; }
  /// The corner that an edge began in as it came.
  std::uint32_t start_of(std::uint32_t edge) const {
    const std::uint32_t next = rings_.next(edge);
    return rings_.given_corner(edge) == rings_.given_edge(edge) ? edge : next;
  }
  std::string ring(std::size_t k) const {
    return k == 0 ? "the outer ring" : "ring " + std::to_string(k) + ", a hole";
  }
  std::string name(std::uint32_t edge) const { return "edge " + std::to_string(rings_.given_edge(edge)); }
  std::string other(std::uint32_t edge) const {
    const bool same = ring_e_ == ring_f_;
    return name(edge) + (same ? "" : " of " + ring(rings_.ring_of(edge)));
  }
  std::string vertex(std::uint32_t c) const {
    return "vertex " + std::to_string(rings_.given_corner(c)) +
           (ring_e_ == ring_f_ ? "" : " of " + ring(rings_.ring_of(c)));
  }

  [[noreturn]] void refuse(std::uint32_t c, const std::string& message) const {
    throw Error(ErrorCode::degenerate_input, message, rings_.where_corner(c));
  }
  [[noreturn]] void spike(std::uint32_t c) const {
    refuse(c, "the ring goes back on itself in this vertex, at " + place(corner(c)) +
                  ": a spike without width; leave the vertex out");
  }
  [[noreturn]] void along() const {
    refuse(start_of(f_), name(f_) + " runs along a part of " + other(e_) +
                             (ring_e_ == ring_f_ ? "; a ring must not touch itself"
                                                 : "; rings must be apart: merge them, or move one"));
  }
  [[noreturn]] void touch(std::uint32_t c, const std::string& what) const {
    refuse(c,
           "the vertex touches " + what + ", at " + place(corner(c)) +
               (ring_e_ == ring_f_ ? ": the ring touches itself there" : ": two rings touch there") +
               ", so that the polygon is no surface with a boundary in this point; move the vertex, or cut "
               "the polygon there");
  }

  const PolygonRings& rings_;
  std::uint32_t e_, f_;
  std::size_t ring_e_, ring_f_;
};

/// By a ray; p is on no edge of the ring.
bool is_in_ring(const PolygonRings& rings, std::size_t k, Vec2 p) {
  bool inside = false;
  for (std::uint32_t e = rings.first(k); e < rings.first(k + 1); ++e) {
    const auto [a, b] = rings.edges()[e];
    if ((a.y > p.y) != (b.y > p.y) && (orientation(a, b, p) > 0) == (a.y > b.y)) inside = !inside;
  }
  return inside;
}

}  // namespace

void require_no_contact(const PolygonRings& rings, const EdgeGrid& grid) {
  constexpr double most_pairs = 0x1p29;
  if (grid.pairs() > most_pairs)
    throw Error(ErrorCode::degenerate_input,
                "too many edges are close to each other: more than 10^8 pairs of them would be looked at; "
                "simplify the rings",
                "/rings");
  if (const auto contact = Contacts(rings, grid).first())
    Refusal(rings, contact->first, contact->second).report();
}

std::uint32_t leftmost_corner(const PolygonRings& rings, std::size_t k) {
  std::uint32_t best = rings.first(k);
  for (std::uint32_t e = best; e < rings.first(k + 1); ++e)
    if (lexicographically_less(rings.edges()[e].from, rings.edges()[best].from)) best = e;
  return best;
}

void refuse_hole(const PolygonRings& rings, std::size_t k) {
  const Vec2 p = rings.edges()[leftmost_corner(rings, k)].from;
  const std::string where = PolygonRings::where(k);
  if (!is_in_ring(rings, 0, p))
    throw Error(ErrorCode::degenerate_input,
                "the hole is outside the outer ring, which is the first one; leave it out, or make it a "
                "polygon of its own",
                where);
  for (std::size_t j = 1; j < rings.rings(); ++j)
    if (j != k && is_in_ring(rings, j, p))
      throw Error(ErrorCode::degenerate_input,
                  "the hole is inside another hole, ring " + std::to_string(j) +
                      "; leave it out, or make the island in that hole a polygon of its own",
                  where);
  throw Error(ErrorCode::internal, "a hole that winds unlike its neighbors", where);
}

}  // namespace wellspaced

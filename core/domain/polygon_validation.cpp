#include "core/domain/polygon_validation.h"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

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

/// What two edges do that must not meet; the first of these is the most telling one.
enum class Contact : std::uint8_t { spike, cross, overlap, touch, none };

/// Of two edges: on which side of one the ends of the other are.
struct Sides {
  Sides(const PolygonEdge& e, const PolygonEdge& f)
      : from_of_f(orientation(e.from, e.to, f.from)),
        to_of_f(orientation(e.from, e.to, f.to)),
        from_of_e(orientation(f.from, f.to, e.from)),
        to_of_e(orientation(f.from, f.to, e.to)) {}
  int from_of_f, to_of_f, from_of_e, to_of_e;
};

/// Requires: the edges are on one line.
bool overlap(const PolygonEdge& e, const PolygonEdge& f) {
  const auto [e_low, e_high] = std::minmax(e.from, e.to, lexicographically_less);
  const auto [f_low, f_high] = std::minmax(f.from, f.to, lexicographically_less);
  return lexicographically_less(e_low, f_high) && lexicographically_less(f_low, e_high);
}

Contact contact(const PolygonEdge& e, const PolygonEdge& f) {
  if (boxes_apart(e, f)) return Contact::none;
  const Sides s(e, f);
  if (s.from_of_f * s.to_of_f < 0 && s.from_of_e * s.to_of_e < 0) return Contact::cross;
  if (s.from_of_f == 0 && s.to_of_f == 0 && overlap(e, f)) return Contact::overlap;
  const bool touch =
      (s.from_of_f == 0 && in_box(e.from, e.to, f.from)) || (s.to_of_f == 0 && in_box(e.from, e.to, f.to)) ||
      (s.from_of_e == 0 && in_box(f.from, f.to, e.from)) || (s.to_of_e == 0 && in_box(f.from, f.to, e.to));
  return touch ? Contact::touch : Contact::none;
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

  struct Found {
    Contact contact = Contact::none;
    std::uint32_t e = 0, f = 0;
    friend bool operator<(const Found& a, const Found& b) {
      return std::tie(a.contact, a.e, a.f) < std::tie(b.contact, b.e, b.f);
    }
  };

  /// The most telling one of the first edges.
  Found first() const {
    Found best;
    for (std::size_t square = 0; square < grid_.squares(); ++square) {
      const auto edges = grid_.edges_in(square);
      for (std::size_t j = 1; j < edges.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
          const Found found{between(edges[i], edges[j]), edges[i], edges[j]};
          if (found.contact != Contact::none) best = std::min(best, found);
        }
    }
    return best;
  }

 private:
  Contact between(std::uint32_t e, std::uint32_t f) const {
    const auto& edges = rings_.edges();
    if (next_[e] == f) return is_spike(edges[e], edges[f]) ? Contact::spike : Contact::none;
    if (next_[f] == e) return is_spike(edges[f], edges[e]) ? Contact::spike : Contact::none;
    return contact(edges[e], edges[f]);
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
  Refusal(const PolygonRings& rings, const Contacts::Found& found)
      : rings_(rings),
        contact_(found.contact),
        e_(found.e),
        f_(found.f),
        ring_e_(rings.ring_of(e_)),
        ring_f_(rings.ring_of(f_)) {}

  [[noreturn]] void report() const {
    switch (contact_) {
      case Contact::spike:
        spike(rings_.next(e_) == f_ ? f_ : e_);
      case Contact::cross:
        refuse(start_of(f_), name(f_) + " crosses " + other(e_) + " at " +
                                 place(crossing(rings_.edges()[e_], rings_.edges()[f_])) +
                                 (ring_e_ == ring_f_ ? "; reorder or move their vertices"
                                                     : "; rings must be apart: move it, or merge the rings"));
      case Contact::overlap:
        refuse(start_of(f_), name(f_) + " runs along a part of " + other(e_) +
                                 (ring_e_ == ring_f_ ? "; a ring must not touch itself"
                                                     : "; rings must be apart: merge them, or move one"));
      default:
        report_touch();
    }
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
  [[noreturn]] void report_touch() const {
    const std::uint32_t corners_e[] = {e_, rings_.next(e_)}, corners_f[] = {f_, rings_.next(f_)};
    for (const std::uint32_t c : corners_f)
      for (const std::uint32_t d : corners_e)
        if (corner(c) == corner(d)) touch(c, vertex(d));
    for (const std::uint32_t c : corners_f)
      if (is_on(c, e_)) touch(c, other(e_));
    for (const std::uint32_t c : corners_e)
      if (is_on(c, f_)) touch(c, other(f_));
    refuse(f_, name(f_) + " touches " + other(e_));
  }
  bool is_on(std::uint32_t c, std::uint32_t edge) const {
    const auto [from, to] = rings_.edges()[edge];
    return orientation(from, to, corner(c)) == 0 && in_box(from, to, corner(c));
  }
  [[noreturn]] void touch(std::uint32_t c, const std::string& what) const {
    refuse(c,
           "the vertex touches " + what + ", at " + place(corner(c)) +
               (ring_e_ == ring_f_ ? ": the ring touches itself there" : ": two rings touch there") +
               ", so that the polygon is no surface with a boundary in this point; move the vertex, or cut "
               "the polygon there");
  }

  const PolygonRings& rings_;
  Contact contact_;
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
  const Contacts::Found found = Contacts(rings, grid).first();
  if (found.contact != Contact::none) Refusal(rings, found).report();
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

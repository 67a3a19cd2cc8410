#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.h"

namespace wellspaced {

/// An edge of a ring; the polygon is on its left.
struct PolygonEdge {
  Vec2 from, to;
};

/// The rings of a polygon with their edges: the outer one first and counter-clockwise, then the holes,
/// clockwise. Edges are numbered through all rings; edge e begins in corner e.
///
/// Guarantees: coordinates are finite; no edge has length zero; each ring has three corners that are not on
/// one line; the outer ring's box has sides in [Torus::min_side, Torus::max_side], with a ratio of at most
/// Torus::max_aspect. That rings don't cross is for `require_simple` to say.
/// Errors of the constructor: invalid_parameters or degenerate_input at /rings, /rings/k or /rings/k/i.
class PolygonRings {
 public:
  /// Takes rings of either orientation, whose last vertex may repeat the first one.
  explicit PolygonRings(const std::vector<std::vector<Vec2>>& rings);

  const std::vector<PolygonEdge>& edges() const { return edges_; }
  std::size_t rings() const { return first_.size() - 1; }
  /// The edges of ring k: from first(k) to first(k + 1).
  std::uint32_t first(std::size_t k) const { return first_[k]; }
  std::size_t ring_of(std::uint32_t edge) const;
  std::uint32_t next(std::uint32_t edge) const;
  std::uint32_t previous(std::uint32_t edge) const;

  /// The number that an edge or a corner had in its ring as it came.
  std::uint32_t given_edge(std::uint32_t edge) const;
  std::uint32_t given_corner(std::uint32_t corner) const;
  /// "/rings/1", "/rings/1/4"
  static std::string where(std::size_t ring) { return "/rings/" + std::to_string(ring); }
  std::string where_corner(std::uint32_t corner) const;

  Vec2 low() const { return low_; }  ///< corner of the outer ring's box
  Vec2 size() const { return size_; }
  /// Coordinates relative to `low`: what everything that needn't be exact is computed in.
  Vec2 local(Vec2 p) const { return p - low_; }
  /// Distance of doubles at the largest coordinate.
  double ulp() const { return ulp_; }

 private:
  void add(std::vector<Vec2> ring);
  void measure();
  void require_in_box(std::size_t k) const;

  std::vector<PolygonEdge> edges_;
  std::vector<std::uint32_t> first_{0};
  std::vector<bool> reversed_;
  Vec2 low_, high_, size_;
  double ulp_ = 0;
};

}  // namespace wellspaced

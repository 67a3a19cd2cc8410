#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/control.h"
#include "core/large_vector.h"
#include "core/point_set.h"
#include "core/voronoi/grid_order.h"
#include "core/voronoi/marks.h"
#include "core/voronoi/mesh_radii.h"
#include "core/voronoi/star.h"

namespace wellspaced {

/// A place on a torus as fractions of its sides in units of 2^-32, so that subtraction wraps by itself.
struct FixedPoint {
  std::uint32_t x = 0, y = 0;
  bool operator==(const FixedPoint&) const = default;
};

/// Consecutive places of a mesh, which may go on at the first one after the last one.
struct Territory {
  std::uint32_t low = 0, size = 0, n = 0;  ///< n: places in all

  bool holds(std::uint32_t v) const { return (v >= low ? v - low : v + n - low) < size; }
};

/// Edges that may have ceased to be Delaunay, looked at by `legalize` one after the other.
struct Suspects {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  Territory territory;  ///< what flips may touch
  std::vector<Edge> edges = {};
  std::vector<Edge> put_off = {};  ///< those whose flip would reach beyond the territory
  std::size_t flips = 0;

  void add(std::uint32_t a, std::uint32_t b) { edges.push_back({a, b}); }
};

/// Places that can be worked on at the same time as those of any other strip of the same color, as long as
/// nothing is touched beyond `territory`.
struct Strip {
  std::uint32_t begin = 0, end = 0;
  Territory territory;
};

/// The Delaunay triangulation of a torus's points, kept while the points move: one star a point, flips after
/// Lawson. What optimizers that move many points often work on.
///
/// Points are numbered in grid order, so that neighbors are near in memory; `original` leads back.
/// Lengths inside are in units of d_hex, the spacing of the triangular lattice with as many points.
///
/// Guarantees: stars are mutual and triangles counter-clockwise at all times, whatever sequence of moves
/// (that keep the mover's triangles positive) and flips; after `legalize_all` every edge is locally Delaunay
/// to within 1e-9, hence the triangulation is Delaunay to that, unless it would take a 16th neighbor of a
/// point or an edge that reaches around the torus. Coordinates are rounded to 2^-33 of the sides. `strips`
/// are a function of the points alone. Errors of the constructor: those of require_usable; degenerate_input
/// for fewer than 20 points, a torus whose shorter side is below 4 d_hex, more than 15 neighbors of one
/// point, or empty regions so large that edges reach around the torus; cancelled, deadline_exceeded. Cost:
/// O(n) for even sets; 72 bytes a point. Determinism: a function of the points alone. Thread safety: none,
/// but that strips of one color may be worked on at the same time.
class StarMesh {
 public:
  StarMesh(const PointSet& points, const Control& control);

  /// Why a torus with so many points has no room for this; nothing if it has.
  static std::optional<std::string> why_too_small(const Domain& domain, std::size_t n);

  std::size_t size() const { return at_.size(); }
  double spacing() const { return spacing_; }  ///< d_hex in domain lengths
  std::uint32_t original(std::size_t i) const { return original_[i]; }
  const Star& star(std::size_t i) const { return stars_[i]; }
  const FixedPoint& at(std::size_t i) const { return at_[i]; }
  const LargeVector<FixedPoint>& places() const { return at_; }

  /// Units of d_hex a fixed-point step, along each axis.
  Vec2 scale() const { return scale_; }
  /// From point i to point j, the short way, in units of d_hex.
  Vec2 offset(std::size_t i, std::size_t j) const { return way(at_[i], at_[j]); }
  /// The same between places.
  Vec2 way(FixedPoint from, FixedPoint to) const {
    return {static_cast<double>(static_cast<std::int32_t>(to.x - from.x)) * scale_.x,
            static_cast<double>(static_cast<std::int32_t>(to.y - from.y)) * scale_.y};
  }

  void move_to(std::size_t i, FixedPoint to) {
    // In one store: who loads both at once, soon after, would have to wait for two.
    const auto both = std::bit_cast<std::uint64_t>(to);
    std::memcpy(&at_[i].x, &both, sizeof both);
  }
  /// Where point i comes to stand if it moves by `by` (in units of d_hex).
  FixedPoint moved(std::size_t i, Vec2 by) const {
    const auto whole = [](double steps) {
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(steps));
    };
    return {at_[i].x + whole(by.x * steps_.x), at_[i].y + whole(by.y * steps_.y)};
  }

  /// Whether all triangles are counter-clockwise, as they may not be after many points moved at once.
  bool is_positive() const;
  /// Triangulates the present places anew. Errors: degenerate_input, cancelled, deadline_exceeded; places and
  /// stars are then what they were.
  void rebuild(const PointSet& input, const Control& control);

  /// Flips until no suspected edge, nor any edge around a flip, is illegal, but for those put off. Marks the
  /// corners of what was flipped. Number of flips.
  std::size_t legalize(Suspects& suspects);
  std::size_t legalize_all(const Control& control);
  Territory everywhere() const;

  /// All places, cut into strips across the torus; the even ones are of one color and the odd ones of the
  /// other. Strips reach at least 3 d_hex across and their territories as far beyond; one strip where there
  /// is no room for more.
  const std::vector<Strip>& strips() const { return strips_; }

  /// Takes point i out of the triangulation, whose star is empty from then on; nothing but `insert` may be
  /// done with it. False, and nothing has changed, where the hole can't be filled: a point would have more
  /// than 15 neighbors or fewer than 3, or an edge would reach around the torus. Cost: O(degree^3).
  bool remove(std::size_t i);
  /// Puts point i, which was taken out, back at a place; `near` is a point in the triangulation from where
  /// the way to it is searched. False, and nothing has changed, if a corner of the triangle there has 15
  /// neighbors.
  bool insert(std::size_t i, FixedPoint place, std::size_t near);
  /// Whether the triangles of point i are Delaunay, as after `insert` they may not be where edges would have
  /// to reach around the torus.
  bool is_delaunay_at(std::size_t i) const;

  /// Marks are one bit a point, for whoever sweeps over them.
  void mark(std::size_t i) { marks_.set(i); }
  void mark_all() { marks_.set_all(); }
  bool any_marked() const { return marked() != 0; }
  std::size_t marked() const { return marks_.count(); }
  /// The first marked point in [from, end), its mark taken away; `end` if there is none.
  std::size_t take_marked(std::size_t from, std::size_t end) { return marks_.take(from, end); }

  /// Smallest edge and largest circumradius, in units of d_hex.
  /// Errors: cancelled, deadline_exceeded.
  MeshRadii measure(const Control& control) const;

  /// The points in their original order and numbers; those that stand where they stood get their input
  /// coordinates back, bit for bit.
  /// Errors: cancelled, deadline_exceeded.
  PointSet points(const PointSet& input, const Control& control) const;

  /// Moves all points at once; stars stay what they are.
  using Places = LargeVector<FixedPoint>;
  void put(const Places& places) { at_ = places; }

  /// Places and stars, to come back to.
  struct Snapshot {
    LargeVector<FixedPoint> at;
    LargeVector<Star> stars;
  };
  Snapshot snapshot() const { return {at_, stars_}; }
  void restore(const Snapshot& snapshot);

 private:
  void build_stars(const PointSet& input, const Control& control);
  bool place_in_grid_order(const LargeVector<FixedPoint>& points, const std::shared_ptr<const Domain>& domain,
                           const Control& control);
  LargeVector<FixedPoint> shaken(LargeVector<FixedPoint> points, double amount) const;
  void collect_stars(const PointSet& points, const Control& control);
  bool is_mutual() const;
  void triangulate_places(const std::shared_ptr<const Domain>& domain, const Control& control);
  PointSet to_points(const LargeVector<FixedPoint>& places, const std::shared_ptr<const Domain>& domain,
                     const Control& control) const;
  void cut_strips(const GridOrder& order);
  void legalize_strip(const Strip& strip, Suspects& suspects, const Control& control);
  bool try_flip(std::uint32_t a, std::uint32_t b, Suspects& suspects);
  void flip(std::uint32_t a, int k, Suspects& suspects);
  bool is_short_way(Vec2 edge) const;
  std::size_t nearest(FixedPoint place, std::size_t from) const;
  std::optional<std::array<std::uint32_t, 3>> triangle_at(FixedPoint place, std::size_t near) const;

  double spacing_ = 0, width_ = 0, height_ = 0;
  Vec2 scale_, steps_;
  LargeVector<FixedPoint> at_;
  LargeVector<std::uint32_t> original_;
  LargeVector<Star> stars_;
  Marks marks_;
  std::vector<Strip> strips_;
};

}  // namespace wellspaced

#pragma once

#include <array>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/domain/domain.h"

namespace wellspaced {

/// Cuts the part of a polygon that is in a rectangle into trapezoids with two sides along one axis, or
/// triangles.
///
/// Shapes and units: local coordinates, in which edges and results are rounded; the trapezoids overlap, and
/// leave out, no more than rounding does. Cost: O(k log k) for k edges of about one direction; O(k^2) at
/// worst, and `work` counts it. Keeps its memory from call to call.
class ConvexParts {
 public:
  /// A line of the boundary; the polygon is on its left.
  struct Line {
    Vec2 from, to;
  };
  struct Rectangle {
    Vec2 low, high;
  };
  /// Tells whether a place that is well away from all lines is in the polygon.
  using IsInside = std::function<bool(Vec2)>;

  /// Below `narrow` places are too close to each other for `is_inside` to tell them apart.
  ConvexParts(IsInside is_inside, double narrow) : is_inside_(std::move(is_inside)), narrow_(narrow) {}

  /// Adds them to `out`. Requires: `lines` holds all that meet the rectangle.
  void cut(const Rectangle& rectangle, std::span<const Line> lines, ChartPieces& out);
  /// The last call found all of its rectangle to be inside.
  bool is_whole() const { return whole_; }
  /// Crossings of lines and slabs so far, in all calls.
  double work() const { return work_; }

 private:
  static constexpr int bottom = -1, top = -2, continued = -3;
  /// A line's part in the rectangle, from left to right.
  struct Part {
    Vec2 left, right;
    double slope;
    bool inside_above;
    double at(double x) const;
  };
  struct Trapezoid {
    int below, above;  ///< numbers of parts
    double left, right, low_left, high_left, low_right, high_right;
  };
  struct Crossing {
    int part;
    double left, right;  ///< heights at both sides of the slab
    bool is_below(const Crossing& o) const {
      const double sum = left + right, other = o.left + o.right;
      return sum != other ? sum < other : part < o.part;
    }
  };

  void clip(std::span<const Line> lines);
  void collect_stops();
  void cut_slab(double left, double right);
  void collect_crossings(double left, double right);
  double twice_height(std::size_t gap) const;  ///< between crossings gap - 1 and gap, in the slab's middle
  bool lowest_is_inside(double left, double right) const;
  void add(const Crossing& below, const Crossing& above, double left, double right);
  void emit(const Trapezoid& trapezoid, ChartPieces& out);

  IsInside is_inside_;
  double narrow_;
  Vec2 given(Vec2 p) const { return transposed_ ? Vec2{p.y, p.x} : p; }

  Rectangle rectangle_;
  bool transposed_ = false;  ///< x and y are exchanged in all that follows, so that lines are steep
  bool whole_ = false;
  double work_ = 0;
  std::vector<Part> parts_;
  std::vector<double> stops_;
  std::vector<int> active_;  ///< parts that the present slab may cross
  std::size_t next_part_ = 0;
  std::vector<Crossing> crossings_;     ///< of the present slab, upward
  std::vector<Trapezoid> open_, next_;  ///< that end at the slab's left and right side
  std::size_t next_open_ = 0;
  std::vector<Trapezoid> done_;
};

}  // namespace wellspaced

#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/domain/polygon_rings.h"

namespace wellspaced {

/// Squares over the box of a polygon, with the edges that come near each.
///
/// Guarantees: every point of an edge, and every place within `margin` of one along each axis, is in a square
/// that lists the edge, as `square_of` tells squares; lists are ascending.
/// Cost: linear in edges, squares and entries of lists.
class EdgeGrid {
 public:
  /// About that many squares.
  EdgeGrid(const PolygonRings& rings, double squares);
  /// Each made of four squares of a finer grid.
  EdgeGrid(const PolygonRings& rings, const EdgeGrid& finer);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t squares() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
  double side() const { return side_; }
  double margin() const { return margin_; }

  /// Of a local coordinate; places outside belong to the nearest square.
  int column_of(double x) const { return index(x, columns_); }
  int row_of(double y) const { return index(y, rows_); }
  std::size_t square(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  /// The middle of a square, in the polygon's coordinates.
  Vec2 middle(int column, int row) const {
    return {low_.x + (column + 0.5) * side_, low_.y + (row + 0.5) * side_};
  }

  std::span<const std::uint32_t> edges_in(std::size_t square) const {
    return {edges_.data() + begin_[square], edges_.data() + begin_[square + 1]};
  }
  /// How many pairs of edges share a square, at most: what work inside squares costs.
  double pairs() const { return pairs_; }
  std::size_t entries() const { return begin_.back(); }

  /// visit(square) for all squares that the segment between two local places comes near.
  template <class Visit>
  void visit_squares(Vec2 a, Vec2 b, const Visit& visit) const {
    if (a.x > b.x) std::swap(a, b);
    const double slope = b.x > a.x ? (b.y - a.y) / (b.x - a.x) : 0;
    const auto [lowest, highest] = std::minmax(a.y, b.y);
    const int last = column_of(b.x + margin_);
    for (int column = column_of(a.x - margin_); column <= last; ++column) {
      const double left = column * side_ - margin_, right = (column + 1) * side_ + margin_;
      // Beyond an end of the segment its box says enough.
      double y = left > a.x ? a.y + (left - a.x) * slope : a.y;
      double z = right < b.x ? a.y + (right - a.x) * slope : b.y;
      if (y > z) std::swap(y, z);
      const int top = row_of(std::min(z, highest) + margin_);
      for (int row = row_of(std::max(y, lowest) - margin_); row <= top; ++row) visit(square(column, row));
    }
  }

 private:
  int index(double x, int count) const {
    return static_cast<int>(std::clamp(x * per_side_, 0.0, static_cast<double>(count - 1)));
  }
  void fill(const PolygonRings& rings);

  Vec2 low_;
  double side_ = 0, per_side_ = 0, margin_ = 0, pairs_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> begin_, edges_;
};

}  // namespace wellspaced

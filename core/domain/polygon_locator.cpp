#include "core/domain/polygon_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/domain/polygon_validation.h"

namespace wellspaced {
namespace {

// Windings are asked of the place p + (-d, e) with infinitely small d << e instead of p: it is on no edge,
// and no corner is straight above, below or beside it.

/// Such a place is on the left of the edge.
bool is_left(const PolygonEdge& e, Vec2 p) {
  const int side = orientation(e.from, e.to, p);
  if (side != 0) return side > 0;
  return e.to.x != e.from.x ? e.to.x > e.from.x : e.to.y > e.from.y;
}
/// The horizontal line through such a place crosses the edge.
bool passes_height(const PolygonEdge& e, double y) { return (e.from.y > y) != (e.to.y > y); }
/// The vertical one.
bool passes_column(const PolygonEdge& e, double x) { return (e.from.x >= x) != (e.to.x >= x); }

/// What an edge adds to the winding around p, seen from the far left.
int winding_west(const PolygonEdge& e, Vec2 p) {
  const bool down = e.from.y > e.to.y;
  return is_left(e, p) == down ? (down ? 1 : -1) : 0;
}
/// The same, seen from far below.
int winding_south(const PolygonEdge& e, Vec2 p) {
  const bool right = e.to.x > e.from.x;
  return is_left(e, p) == right ? (right ? 1 : -1) : 0;
}

double squares_for(const PolygonRings& rings) {
  return std::max(65536.0, 8 * static_cast<double>(rings.edges().size()));
}

}  // namespace

PolygonLocator::PolygonLocator(const PolygonRings& rings) : rings_(rings), grid_(rings, squares_for(rings)) {
  require_no_contact(rings, grid_);
  const std::vector<std::int32_t> windings = windings_of_middles();
  require_nesting(rings, [&](Vec2 p) {
    const Vec2 local = rings.local(p);
    const int column = grid_.column_of(local.x), row = grid_.row_of(local.y);
    return windings[grid_.square(column, row)] + winding_from_middle(p, column, row);
  });
  states_.resize(grid_.squares());
  for (std::size_t s = 0; s < states_.size(); ++s)
    states_[s] = static_cast<std::uint8_t>((windings[s] == 1 ? 1 : 0) + (grid_.edges_in(s).empty() ? 0 : 2));
  count_full();
}

std::vector<std::int32_t> PolygonLocator::windings_of_middles() const {
  std::vector<std::int32_t> windings(grid_.squares());
  for (const PolygonEdge& e : rings_.edges()) {
    const auto [low, high] = std::minmax(e.from.y, e.to.y);
    const int last = grid_.row_of(rings_.local({0, high}).y + grid_.margin());
    for (int row = grid_.row_of(rings_.local({0, low}).y - grid_.margin()); row <= last; ++row) {
      const double y = grid_.middle(0, row).y;
      if (!passes_height(e, y)) continue;
      const auto is_east = [&](int column) { return winding_west(e, grid_.middle(column, row)) != 0; };
      const double x = e.from.x + (y - e.from.y) * ((e.to.x - e.from.x) / (e.to.y - e.from.y));
      int column = grid_.column_of(rings_.local({x, 0}).x);
      while (column > 0 && is_east(column - 1)) --column;
      while (column < grid_.columns() && !is_east(column)) ++column;
      if (column < grid_.columns()) windings[grid_.square(column, row)] += e.from.y > e.to.y ? 1 : -1;
    }
  }
  for (int row = 0; row < grid_.rows(); ++row)
    for (int column = 1; column < grid_.columns(); ++column)
      windings[grid_.square(column, row)] += windings[grid_.square(column - 1, row)];
  return windings;
}

int PolygonLocator::winding_from_middle(Vec2 p, int column, int row) const {
  const Vec2 q = grid_.middle(column, row), turn{q.x, p.y};  // the way: beside p, then up or down to q
  int difference = 0;
  for (const std::uint32_t k : grid_.edges_in(grid_.square(column, row))) {
    const PolygonEdge& e = rings_.edges()[k];
    if (passes_height(e, p.y)) difference += winding_west(e, p) - winding_west(e, turn);
    if (passes_column(e, q.x)) difference += winding_south(e, turn) - winding_south(e, q);
  }
  return difference;
}

Located PolygonLocator::locate(Vec2 p) const {
  const Vec2 local = rings_.local(p);
  const double margin = grid_.margin();
  if (!(local.x >= -margin && local.x <= rings_.size().x + margin)) return {};
  if (!(local.y >= -margin && local.y <= rings_.size().y + margin)) return {};
  const int column = grid_.column_of(local.x), row = grid_.row_of(local.y);
  const std::size_t square = grid_.square(column, row);
  if (!has_edges(square)) return {is_full(square) ? Place::inside : Place::outside};
  const UlpBox box(p);
  Located found;
  for (const std::uint32_t k : grid_.edges_in(square)) {
    const PolygonEdge& e = rings_.edges()[k];
    if (e.from == p) return {Place::corner, k};
    if (found.place == Place::outside && box.meets(e.from, e.to)) found = {Place::edge, k};
  }
  if (found.place == Place::edge) return found;
  const int winding = (states_[square] & 1) + winding_from_middle(p, column, row);
  return {winding == 1 ? Place::inside : Place::outside};
}

bool PolygonLocator::is_just_inside(Vec2 p) const {
  const Vec2 local = rings_.local(p);
  const int column = grid_.column_of(local.x), row = grid_.row_of(local.y);
  const std::size_t square = grid_.square(column, row);
  if (!has_edges(square)) return is_full(square);
  return (states_[square] & 1) + winding_from_middle(p, column, row) == 1;
}

void PolygonLocator::count_full() {
  const std::size_t width = static_cast<std::size_t>(grid_.columns()) + 1;
  full_before_.assign(width * (static_cast<std::size_t>(grid_.rows()) + 1), 0);
  for (int row = 0; row < grid_.rows(); ++row) {
    std::uint32_t in_row = 0;
    const std::size_t below = static_cast<std::size_t>(row) * width;
    for (int column = 0; column < grid_.columns(); ++column) {
      in_row += is_full(grid_.square(column, row)) ? 1 : 0;
      const std::size_t k = below + static_cast<std::size_t>(column) + 1;
      full_before_[k + width] = full_before_[k] + in_row;
    }
  }
}

bool PolygonLocator::all_full(Vec2 low, Vec2 high) const {
  if (low.x < 0 || low.y < 0 || high.x > rings_.size().x || high.y > rings_.size().y) return false;
  const auto i0 = static_cast<std::size_t>(grid_.column_of(low.x));
  const auto i1 = static_cast<std::size_t>(grid_.column_of(high.x)) + 1;
  const auto j0 = static_cast<std::size_t>(grid_.row_of(low.y));
  const auto j1 = static_cast<std::size_t>(grid_.row_of(high.y)) + 1;
  const std::size_t width = static_cast<std::size_t>(grid_.columns()) + 1;
  return full_before_[j1 * width + i1] - full_before_[j0 * width + i1] - full_before_[j1 * width + i0] +
             full_before_[j0 * width + i0] ==
         (i1 - i0) * (j1 - j0);
}

bool PolygonLocator::surrounds(Vec2 p, double reach) const {
  const Vec2 c = rings_.local(p);
  const auto box = [&](double x, double y) {
    return all_full({c.x - x * reach, c.y - y * reach}, {c.x + x * reach, c.y + y * reach});
  };
  if (box(1, 1)) return true;
  constexpr double cos30 = 0.8660254037844387;  // three boxes that hold the disk, for 30 degrees each
  return box(1, 0.5) && box(cos30, cos30) && box(0.5, 1);
}

double PolygonLocator::free_part(Vec2 p, Vec2 u) const {
  const Vec2 from = rings_.local(p), to = from + u;
  if (all_full({std::min(from.x, to.x), std::min(from.y, to.y)},
               {std::max(from.x, to.x), std::max(from.y, to.y)}))
    return 1;
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  double part = 1;
  grid_.visit_squares(from, to, [&](std::size_t square) {
    for (const std::uint32_t k : grid_.edges_in(square)) {
      const PolygonEdge& e = rings_.edges()[k];
      const Vec2 a = e.from - p, d = e.to - e.from;
      const double speed = cross(u, d);  // at which p goes to the right across the edge's line
      const int side = orientation(e.from, e.to, p);
      if (speed == 0 || (side > 0 && speed < 0) || (side < 0 && speed > 0)) continue;
      const double error = rounding / std::abs(speed);
      const double along = cross(a, u) / speed;
      const double along_error = 1e-9 + error * (std::abs(a.x * u.y) + std::abs(a.y * u.x));
      if (along < -along_error || along > 1 + along_error) continue;
      const double way = cross(a, d) / speed - error * (std::abs(a.x * d.y) + std::abs(a.y * d.x));
      part = std::min(part, std::max(0.0, way));
    }
  });
  return part;
}

}  // namespace wellspaced

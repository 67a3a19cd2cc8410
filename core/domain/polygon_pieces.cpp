#include "core/domain/polygon_pieces.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/domain/convex_parts.h"
#include "core/error.h"

namespace wellspaced {
namespace {

/// Squares of a row or more that are inside, as one rectangle. Columns and rows: from the first to the last.
struct Run {
  int first_column = 0, last_column = -1, first_row = 0, last_row = 0;
  bool empty() const { return last_column < first_column; }
  bool same_columns(const Run& o) const {
    return first_column == o.first_column && last_column == o.last_column;
  }
};

void emit(const Run& run, double side, Vec2 origin, ChartPieces& out) {
  const double left = run.first_column * side - origin.x, right = (run.last_column + 1) * side - origin.x;
  const double low = run.first_row * side - origin.y, high = (run.last_row + 1) * side - origin.y;
  out.corners.insert(out.corners.end(), {{left, low}, {right, low}, {right, high}, {left, high}});
  out.close();
}

/// Corners that rounding makes one are one; what is no polygon any more is left out.
void copy(const ChartPieces& from, std::size_t piece, Vec2 origin, ChartPieces& out) {
  const std::size_t first = out.corners.size();
  for (const Vec2 corner : from[piece]) {
    const Vec2 moved = corner - origin;
    if (out.corners.size() == first || out.corners.back() != moved) out.corners.push_back(moved);
  }
  while (out.corners.size() > first && out.corners.back() == out.corners[first]) out.corners.pop_back();
  if (out.corners.size() - first < 3)
    out.corners.resize(first);
  else
    out.close();
}

}  // namespace

PolygonPieces::PolygonPieces(const PolygonRings& rings, const PolygonLocator& locator)
    : low_(rings.low()), size_(rings.size()) {
  const auto edges = static_cast<double>(rings.edges().size());
  auto level = make_level(rings, locator, locator.grid(), 0x1p26 + 32 * edges);
  if (!level)
    throw Error(ErrorCode::degenerate_input,
                "too many edges are beside and above each other in the same places; simplify the rings",
                "/rings");
  const double most_work = std::max(level->work, 0x1p20 + 32 * edges);
  double corners = 0;
  for (EdgeGrid grid(rings, locator.grid()); level; grid = EdgeGrid(rings, grid)) {
    levels_.push_back(std::move(*level));
    corners += static_cast<double>(levels_.back().pieces.corners.size());
    if (levels_.back().first.size() == 2 || corners > 0x1p23 + 16 * edges) break;
    level = make_level(rings, locator, grid, most_work);
  }
}

std::optional<PolygonPieces::Level> PolygonPieces::make_level(const PolygonRings& rings,
                                                              const PolygonLocator& locator,
                                                              const EdgeGrid& grid, double most) {
  Level level{grid.side(), grid.columns(), grid.rows(), 0, {}, {}, {}};
  level.full.resize(grid.squares());
  ConvexParts parts([&](Vec2 local) { return locator.is_just_inside(rings.low() + local); },
                    1e-14 * grid.side() + 4 * rings.ulp());
  std::vector<ConvexParts::Line> lines;
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      const std::size_t square = grid.square(column, row);
      level.first.push_back(static_cast<std::uint32_t>(level.pieces.ends.size()));
      if (grid.edges_in(square).empty()) {
        level.full[square] = locator.is_just_inside(grid.middle(column, row));
        continue;
      }
      lines.clear();
      for (const std::uint32_t e : grid.edges_in(square))
        lines.push_back({rings.local(rings.edges()[e].from), rings.local(rings.edges()[e].to)});
      const double x = column * level.side, y = row * level.side;
      parts.cut({{x, y}, {(column + 1) * level.side, (row + 1) * level.side}}, lines, level.pieces);
      if (parts.work() > most) return {};
      if (!parts.is_whole()) continue;
      level.full[square] = true;
      level.pieces.ends.pop_back();
      level.pieces.corners.resize(level.pieces.ends.empty() ? 0 : level.pieces.ends.back());
    }
  level.first.push_back(static_cast<std::uint32_t>(level.pieces.ends.size()));
  level.work = parts.work();
  return level;
}

const PolygonPieces::Level& PolygonPieces::level_for(double reach) const {
  std::size_t k = 0;
  while (k + 1 < levels_.size() && levels_[k].side < 0.5 * reach) ++k;
  return levels_[k];
}

void PolygonPieces::near(Vec2 p, double reach, ChartPieces& out) const {
  out.clear();
  const Level& level = level_for(reach);
  const Vec2 c = p - low_;
  const auto index = [&](double x, int count) {
    return static_cast<int>(std::clamp(x / level.side, 0.0, static_cast<double>(count - 1)));
  };
  const int i0 = index(c.x - reach, level.columns), i1 = index(c.x + reach, level.columns);
  const int j0 = index(c.y - reach, level.rows), j1 = index(c.y + reach, level.rows);
  const auto is_near = [&](int column, int row) {
    const double x = std::max({0.0, column * level.side - c.x, c.x - (column + 1) * level.side});
    const double y = std::max({0.0, row * level.side - c.y, c.y - (row + 1) * level.side});
    return x * x + y * y <= reach * reach;
  };
  Run last;
  for (int row = j0; row <= j1; ++row) {
    const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns);
    bool goes_on = false;
    for (int column = i0; column <= i1; ++column) {
      const std::size_t square = begin + static_cast<std::size_t>(column);
      if (is_near(column, row))
        for (std::uint32_t k = level.first[square]; k < level.first[square + 1]; ++k)
          copy(level.pieces, k, c, out);
      if (!level.full[square]) continue;
      Run run{column, column, row, row};
      while (run.last_column < i1 && level.full[begin + static_cast<std::size_t>(run.last_column) + 1])
        ++run.last_column;
      column = run.last_column;
      if (!goes_on && run.same_columns(last) && last.last_row == row - 1) {
        last.last_row = row;
      } else {
        if (!last.empty()) emit(last, level.side, c, out);
        last = run;
      }
      goes_on = true;
    }
  }
  if (!last.empty()) emit(last, level.side, c, out);
}

}  // namespace wellspaced

#include "core/domain/polygon_pieces.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/domain/convex_parts.h"

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

void copy(const ChartPieces& from, std::size_t piece, Vec2 origin, ChartPieces& out) {
  for (const Vec2 corner : from[piece]) out.corners.push_back(corner - origin);
  out.close();
}

}  // namespace

PolygonPieces::PolygonPieces(const PolygonRings& rings, const PolygonLocator& locator)
    : low_(rings.low()), size_(rings.size()) {
  const double most_pairs = 0x1p23 + 64 * static_cast<double>(rings.edges().size());
  levels_.push_back(make_level(rings, locator, locator.grid()));
  EdgeGrid grid(rings, locator.grid());
  for (; grid.pairs() <= most_pairs; grid = EdgeGrid(rings, grid)) {
    levels_.push_back(make_level(rings, locator, grid));
    if (grid.squares() == 1) break;
  }
}

PolygonPieces::Level PolygonPieces::make_level(const PolygonRings& rings, const PolygonLocator& locator,
                                               const EdgeGrid& grid) {
  Level level{grid.side(), grid.columns(), grid.rows(), {}, {}, {}};
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
      if (!parts.is_whole()) continue;
      level.full[square] = true;
      level.pieces.ends.pop_back();
      level.pieces.corners.resize(level.pieces.ends.empty() ? 0 : level.pieces.ends.back());
    }
  level.first.push_back(static_cast<std::uint32_t>(level.pieces.ends.size()));
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
  Run last;
  for (int row = j0; row <= j1; ++row) {
    const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns);
    bool goes_on = false;
    for (int column = i0; column <= i1; ++column) {
      const std::size_t square = begin + static_cast<std::size_t>(column);
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

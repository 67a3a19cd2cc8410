#include "core/generate/lattice.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace wellspaced {
namespace {

/// Puts `motif` (in units of a cell) into each cell of the grid, one row of the motif's points after the
/// other.
PointSet tile(const std::shared_ptr<const Torus>& torus, GridShape grid,
              std::span<const std::vector<Vec2>> motif_rows, Control& control) {
  PointSet points{torus, {}};
  const double w = torus->width() / static_cast<double>(grid.columns);
  const double h = torus->height() / static_cast<double>(grid.rows);
  for (std::uint64_t row = 0; row < grid.rows; ++row) {
    control.check();
    for (const auto& motif : motif_rows)
      for (std::uint64_t column = 0; column < grid.columns; ++column)
        for (const Vec2 at : motif)
          points.push_back({wrap((static_cast<double>(column) + at.x) * w, torus->width()),
                            wrap((static_cast<double>(row) + at.y) * h, torus->height()), 0});
  }
  return points;
}

}  // namespace

GridShape fit_grid(const Torus& torus, double cells, double cell_aspect) {
  // Along the axis with fewer cells every number near the ideal one is tried; the other axis makes up the
  // count.
  const double ideal_rows = std::sqrt(cells * torus.height() / (torus.width() * cell_aspect));
  const bool few_rows = ideal_rows * ideal_rows <= cells;
  const double ideal = few_rows ? ideal_rows : cells / ideal_rows;
  GridShape best;
  double best_cost = INFINITY;
  const double from = std::max(1.0, std::floor(ideal * 0.9) - 1), to = std::ceil(ideal * 1.1) + 1;
  for (double few = from; few <= to; ++few) {
    for (const double many : {std::floor(cells / few), std::ceil(cells / few)}) {
      if (many < 1) continue;
      const double rows = few_rows ? few : many, columns = few_rows ? many : few;
      const double stretch = torus.height() / rows / (torus.width() / columns * cell_aspect);
      // Ratios stand in for logarithms: max(t, 1/t) - 1 is |log t| to first order, and needs no libm.
      const auto off = [](double t) { return std::max(t, 1 / t) - 1; };
      const double cost = off(columns * rows / cells) + off(stretch);
      if (cost < best_cost) {
        best_cost = cost;
        best = {static_cast<std::uint64_t>(columns), static_cast<std::uint64_t>(rows)};
      }
    }
  }
  return best;
}

PointSet triangular_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count,
                            Control& control) {
  // A cell holds two rows: spacing a wide, sqrt(3) a high.
  const GridShape grid = fit_grid(*torus, static_cast<double>(count) / 2, std::sqrt(3.0));
  const std::vector<Vec2> rows[] = {{{0, 0}}, {{0.5, 0.5}}};
  return tile(torus, grid, rows, control);
}

PointSet square_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control) {
  const std::vector<Vec2> rows[] = {{{0, 0}}};
  return tile(torus, fit_grid(*torus, static_cast<double>(count), 1), rows, control);
}

PointSet hexagonal_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control) {
  // A cell holds four corners of hexagons with side s: sqrt(3) s wide, 3 s high.
  const GridShape grid = fit_grid(*torus, static_cast<double>(count) / 4, std::sqrt(3.0));
  const std::vector<Vec2> rows[] = {{{0, 0}}, {{0.5, 1.0 / 6}}, {{0.5, 0.5}}, {{0, 2.0 / 3}}};
  return tile(torus, grid, rows, control);
}

PointSet jittered(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Rng& rng,
                  Control& control) {
  const GridShape grid = fit_grid(*torus, static_cast<double>(count), 1);
  PointSet points{torus, {}};
  const double w = torus->width() / static_cast<double>(grid.columns);
  const double h = torus->height() / static_cast<double>(grid.rows);
  for (std::uint64_t row = 0; row < grid.rows; ++row) {
    control.check();
    for (std::uint64_t column = 0; column < grid.columns; ++column) {
      const double x = (static_cast<double>(column) + rng.uniform()) * w;
      const double y = (static_cast<double>(row) + rng.uniform()) * h;
      points.push_back({wrap(x, torus->width()), wrap(y, torus->height()), 0});
    }
  }
  return points;
}

}  // namespace wellspaced

#pragma once

#include <cstdint>
#include <memory>

#include "core/control.h"
#include "core/domain/torus.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

/// A grid of columns x rows cells that fit a torus exactly.
struct GridShape {
  std::uint64_t columns = 1, rows = 1;
};

/// The columns x rows nearest to `cells` cells of the given height / width ratio.
///
/// Guarantees: of the shapes whose shorter axis has within a tenth of the ideal number, the one least off in
/// number and in stretch; columns * rows is within one row or column of `cells`, and at least 1.
GridShape fit_grid(const Torus& torus, double cells, double cell_aspect);

/// Triangular (hexagonally packed) lattice: beta = 1/sqrt(3). Rows alternate by half a spacing.
///
/// Guarantees (all three): row by row from (0, 0); about `count` points, namely as many as the nearest
/// periodic lattice has. One that doesn't fit the torus is stretched a little, and its beta is then a little
/// above the closed form; the triangular one is exact where height / width = rows * sqrt(3) / (2 columns) is
/// near enough, as on a torus of aspect sqrt(3). Errors: cancelled, deadline_exceeded.
PointSet triangular_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control);

/// Square lattice: beta = 1/sqrt(2).
PointSet square_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control);

/// Honeycomb: the corners of regular hexagons, two a triangular cell; beta = 1.
PointSet hexagonal_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control);

/// One uniform point in each cell of the square lattice's grid, row by row.
PointSet jittered(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Rng& rng, Control& control);

}  // namespace wellspaced

#pragma once

#include <cstdint>
#include <memory>

#include "core/control.h"
#include "core/domain/torus.h"
#include "core/point_set.h"

namespace wellspaced {

/// Triangular (hexagonally packed) lattice: beta = 1/sqrt(3) where it fits.
///
/// Of all lattices with exactly `count` points that repeat with the torus (sheared ones included), the one
/// that is least stretched.
///
/// Guarantees (all three): exactly `count` points, at least 1; a lattice, so that every point sees the same
/// around it (of the honeycomb: every second one). Only a few counts fit a torus exactly, as n = 2 k^2 does
/// for the triangular lattice on aspect sqrt(3); for others beta is above the closed form, the less the more
/// points there are: measure it. Order: row by row from (0, 0). Errors: cancelled, deadline_exceeded. Cost:
/// O(sigma(count)), the sum of its divisors, below 5 count for all counts to ten million; about 10 ns each.
/// Reference: sublattices by their Hermite normal forms; Cassels, "An Introduction to the Geometry of
/// Numbers".
PointSet triangular_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control);

/// Square lattice: beta = 1/sqrt(2) where it fits, as n = k^2 does on a square torus.
PointSet square_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control);

/// Honeycomb: the corners of regular hexagons; beta = 1 where it fits. Order: cell by cell, row by row, the
/// two points of a cell one after the other. Errors, besides: infeasible at /count if it is odd.
PointSet hexagonal_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control);

/// A honeycomb has two points a cell. Errors: infeasible at /count for an odd count.
void require_even(std::uint64_t count);

}  // namespace wellspaced

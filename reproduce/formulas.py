"""What follows from beta, and few statistics."""

import math
import statistics

TRIANGULAR = 1 / math.sqrt(3)
SQUARE = 1 / math.sqrt(2)
HEXAGONAL = 1.0
ROUNDING = 1e-9


def known(values):
    """Without what an answer doesn't tell: null."""
    return [value for value in values if value is not None]


def least(values):
    return min(known(values), default=None)


def most(values):
    return max(known(values), default=None)


def d_hex(area, n):
    """Spacing of the triangular lattice with as many points."""
    return math.sqrt(2 * area / (math.sqrt(3) * n))


def angle_bounds_deg(beta):
    """All angles of the Delaunay triangles of a torus are between these (section 6.1); without a beta there are
    none."""
    if beta is None:
        return None, None
    if beta < 0.5:
        raise ValueError(f"no point set has beta {beta}")
    smallest = math.degrees(math.asin(1 / (2 * beta)))
    return smallest, 180 - 2 * smallest


def longest_edge_bound(beta):
    """Of the Delaunay edges, in r_f; the shortest is r_f itself."""
    return None if beta is None else 2 * beta


def no_obtuse_triangle(beta):
    """Whether beta rules them out."""
    return beta is not None and beta < SQUARE


def least_rho(beta):
    """r_c is at least d_hex / sqrt(3), whatever the point set, so rho = r_c / (beta d_hex) is at least this."""
    return TRIANGULAR / beta


def bounds_hold(spacing):
    """Which of section 6.1's bounds a point set obeys, by name."""
    low, high = angle_bounds_deg(spacing["beta"])
    holds = {
        "smallest angle": spacing["angle_min_deg"] >= low * (1 - ROUNDING),
        "largest angle": spacing["angle_max_deg"] <= high * (1 + ROUNDING),
        "shortest edge": spacing["edge_min"] >= 1 - ROUNDING,
        "longest edge": spacing["edge_max"] <= longest_edge_bound(spacing["beta"]) * (1 + ROUNDING),
    }
    if no_obtuse_triangle(spacing["beta"]):
        holds["no obtuse triangle"] = spacing["angle_max_deg"] <= 90 * (1 + ROUNDING)
    return holds


def all_bounds_hold(spacing):
    """Nothing where the numbers that it takes are not known."""
    if None in (spacing[name] for name in ("beta", "angle_min_deg", "angle_max_deg", "edge_min", "edge_max")):
        return None
    return all(bounds_hold(spacing).values())


def shares(counts):
    """Of all, by whole number: {"5": 1, "6": 3} is {5: .25, 6: .75}."""
    total = sum(counts.values())
    return {int(value): count / total for value, count in sorted(counts.items(), key=lambda item: int(item[0]))}


def first_sweep_at(history, beta):
    """The first sweep of a history [[sweep, beta, r_c, r_f], ...] after which beta is at most that; or nothing."""
    return next((row[0] for row in history if row[1] is not None and row[1] <= beta), None)


def beta_after(history, sweep):
    """beta after that sweep, by the last one before it that was recorded; nothing when it was over before."""
    rows = [row for row in history if row[0] <= sweep]
    return None if not rows or sweep > history[-1][0] else rows[-1][1]


def median_and_range(values):
    return statistics.median(values), min(values), max(values)


def floor_to(value, digits):
    return math.floor(value * 10**digits) / 10**digits

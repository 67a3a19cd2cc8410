"""What the sections share: the client, how large everything is, and jobs that several of them look at."""

import re
from dataclasses import dataclass
from functools import cached_property

from reproduce import bodies
from reproduce.client import Client, Job

TARGETS = (0.95, 0.90, 0.85, 0.80, 0.75, 0.70)
MESH_MEASURES = ["spacing", "certificate", "bond-order", "spectrum"]


@dataclass(frozen=True)
class Sizes:
    seeds: int           # sets that are averaged over
    type_side: int       # Fig. 2: the square of it is the number of points; even, so that the honeycomb fits
    methods_points: int  # Figs. 4 and 5
    sweep_points: int    # Figs. 6 and 11; up to 5000, opt-beta measures often enough for a curve
    plate_side: int      # Fig. 7: the square of it is the number of points
    plate_sweeps: int    # of CVT there
    mesh_points: int     # Figs. 8 and 9, section 6.1
    local_sweeps: int    # of opt-beta-local where it may not reach its target
    race_points: int     # section 6.2
    race_repeats: int
    polygon_radii: tuple # Table 1: its rows that are made
    curved_sweeps: int   # Figs. 13 and 14: of the methods that don't come to their target
    surface_points: int  # Fig. 15
    race_sweeps: dict    # most sweeps of the methods that have no target


FULL = Sizes(seeds=10, type_side=20, methods_points=1000, sweep_points=5000, plate_side=350, plate_sweeps=100,
             mesh_points=1024, local_sweeps=300, race_points=10_000, race_repeats=5, polygon_radii=("coarse", "fine"), curved_sweeps=100,
             surface_points=10_000,
             race_sweeps={"lloyd": 3000, "accelerated": 1000, "distmesh": 3000, "far-point": 300})
SHORT = Sizes(seeds=3, type_side=12, methods_points=300, sweep_points=1000, plate_side=100, plate_sweeps=50,
              mesh_points=256, local_sweeps=50, race_points=1000, race_repeats=3, polygon_radii=("coarse",), curved_sweeps=10,
              surface_points=1000,
              race_sweeps={"lloyd": 500, "accelerated": 200, "distmesh": 500, "far-point": 50})


@dataclass
class Context:
    client: Client
    sizes: Sizes

    def compare(self, groups, measures) -> Job:
        return self.client.job("analyze", bodies.comparison(groups, measures))

    def averaged(self, label, points):
        return bodies.group(label, points, self.sizes.seeds)

    def to_targets(self, method, targets, measures, **parameters):
        """One method from the same MPS input to each of several targets."""
        start = bodies.mps(self.sizes.mesh_points)
        return self.compare([self.averaged(f"{method}, beta {beta:.2f}",
                                           bodies.optimized(start, method, beta=beta, **parameters))
                             for beta in targets], measures)

    @cached_property
    def local_targets(self):
        return self.to_targets("opt-beta-local", TARGETS, MESH_MEASURES, max_sweeps=self.sizes.local_sweeps)

    @cached_property
    def own_targets(self):
        return self.to_targets("opt-beta", TARGETS, MESH_MEASURES)

    @cached_property
    def references(self):
        """What the optimizers start from, and two methods that have no target."""
        start = bodies.mps(self.sizes.mesh_points)
        return self.compare([self.averaged("MPS", start),
                             self.averaged("cvt, Lloyd, 100 sweeps",
                                           bodies.optimized(start, "cvt", variant="lloyd", max_sweeps=100)),
                             self.averaged("far-point", bodies.optimized(start, "far-point"))], MESH_MEASURES)


def target_of(group):
    """What the sets of a group of `to_targets` were asked for; nothing for others."""
    named = re.search(r", beta (\d\.\d+)$", group["label"])
    return float(named[1]) if named else None


def sets_of(group):
    """The spacing of each set of a group."""
    return group["spacing"].get("by_set", [group["spacing"]])


def values(group, name):
    return [spacing[name] for spacing in sets_of(group)]


def reached(group):
    """How many of a group's sets came to their target, by proof; and how many there are."""
    return sum(summary["converged"] is True for summary in group["optimized"]), len(group["optimized"])


def reached_text(group):
    """The same for a table; a dash for what has no target."""
    has_target = any(summary["converged"] is not None for summary in group.get("optimized", []))
    return "{} of {}".format(*reached(group)) if has_target else "\u2013"


def beta_upper(group):
    """Of all sets of a group; nothing if that could not be proven."""
    return group["certificate"]["beta_upper"]


def proven(group, beta):
    """Whether all sets of a group have at most this beta, by proof."""
    return beta_upper(group) is not None and beta_upper(group) <= beta

"""The sections of the report, in its order: each a function of Context and Section that fills the latter."""

from dataclasses import dataclass
from typing import Callable

from reproduce.sections import (bounds, by_sweep, by_type, curved, later, mesh, methods, polygons, race, spectra,
                                zone_plate)


@dataclass(frozen=True)
class Entry:
    anchor: str
    title: str
    fill: Callable
    has: tuple = ("table", "figure", "details")  # what the finished section has to hold


ENTRIES = (
    Entry("types", "Fig. 2: beta by type of point set", by_type.fill),
    Entry("methods", "Figs. 4 and 5: the methods from the same MPS input", methods.fill),
    Entry("sweeps", "Figs. 6 and 11: beta by sweep", by_sweep.fill),
    Entry("zone-plate", "Fig. 7: zone plate", zone_plate.fill),
    Entry("mesh", "Fig. 8: valences and rho against beta", mesh.fill),
    Entry("spectra", "Fig. 9: spectra", spectra.fill),
    Entry("bounds", "Section 6.1: what beta bounds", bounds.fill, ("table", "details")),
    Entry("race", "Section 6.2: time to beta 0.85", race.fill, ("table", "details")),
    Entry("polygons", "Table 1, Figs. 10 and 12: bounded domains", polygons.fill),
    Entry("curved", "Figs. 13 to 15: sphere and surfaces", curved.fill),
    Entry("filtering", "Bilateral filtering", later.filtering, ("p",)),
)

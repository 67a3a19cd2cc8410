"""What the paper says, each with where this project has it from. Its full text could not be obtained: known are its
abstract, and what notes made for this project quote of it. Nothing else may stand here as the paper's."""

from dataclasses import dataclass

TITLE = "Improving Spatial Coverage while Preserving the Blue Noise of Point Sets"
AUTHORS = "Ebeida, Awad, Ge, Mahmoud, Mitchell, Knupp, Wei"
JOURNAL = "Computer-Aided Design 46, 2014 (online 2013)"

ABSTRACT = "abstract"
NOTE_P = "project notes, quoting the paper"
NOTE = "project notes"  # without a mark of their source
NOT_AVAILABLE_SHORT = "not available to us"
NOT_AVAILABLE = "not available to us (plot only / text not obtained)"


@dataclass(frozen=True)
class Statement:
    text: str
    source: str
    values: tuple = ()

    def __str__(self):
        return f"{self.text} [{self.source}]"


WHITE_NOISE = Statement("\u201cuniform random points have no aspect ratio bound\u201d", ABSTRACT)
MPS_BETA = Statement("\u201cMaximal Poisson-disk sampling provides \u03b2=1 and blue noise\u201d", ABSTRACT, (1.0,))
IMPROVEMENT = Statement(
    "\u201cimproving from 1.0 to around 0.8, about half-way to 0.58\u201d, said of beta_i", ABSTRACT,
    (1.0, 0.8, 0.58))
FLOOR = Statement("0.58, the theoretical bound given by a structured tiling", ABSTRACT, (0.58,))
# What of that goes beside which row of Fig. 2.
BY_TYPE = {"white noise": f"no bound [{ABSTRACT}]", "MPS": f"\u03b2 = 1 [{ABSTRACT}]",
           "triangular lattice": f"0.58 [{ABSTRACT}]", "opt-beta-local": f"beta_i around 0.8 [{ABSTRACT}]"}
OPEN_PROBLEM = Statement("constructing from scratch a set with a guarantee of beta < 1 is an open problem", ABSTRACT)

OPT_BETA_I = Statement(
    "Opt-\u03b2\u2071: sweeps in scan-line order with immediate updates; for each point ten Nelder-Mead steps from "
    "{x, x + r/10 e1, x + r/10 e2} on its own ratio; damping 0.6 to 0.8 for a target above 0.9; stops when the "
    "global beta is below the target", "project notes, of the paper's method")
DISTMESH = Statement("DistMesh with Fscale 1.2 and deltat 0.2", "project notes", (1.2, 0.2))

ANGLES = Statement("angles in [asin(1/(2 beta)), 180 \u2212 2 asin(1/(2 beta))] degrees", "section 6.1, by the project notes")
EDGES = Statement("edges in [1, 2 beta] r_f", "section 6.1, by the project notes")
OBTUSE = Statement("no obtuse triangle when beta < 1/\u221a2", "section 6.1, by the project notes")

MPS_DENSITY = Statement("N r\u00b2 = 0.6966 A", NOTE, (0.6966,))
MPS_RHO = Statement("rho = 0.777", NOTE, (0.777,))
MPS_BETA_I = Statement("mean beta_i = 0.859", NOTE, (0.859,))
MPS_VALENCE = Statement("4 to 8 neighbors: 1.1 / 24.6 / 50.0 / 21.8 / 2.4 %", NOTE, (1.1, 24.6, 50.0, 21.8, 2.4))

TABLE_1 = Statement("Table 1: beta 0.988 at r = 0.0314 and 0.932 at r = 0.0157", NOTE_P, (0.988, 0.932))
SPHERE = Statement("sphere: 0.73 at 1000 points (CVT 0.81)", NOTE_P, (0.73, 0.81))

# Not the paper's: this project's own trials.
TRIAL_FIRST_SWEEP = Statement("beta 1.03 to 1.12 after the first sweep of 10,000 points",
                              "project notes, own trials", (1.03, 1.12))

# Not the paper's: other authors' programs as measured for this project on this kind of machine, one thread, CPU
# seconds, 10,000 points out of MPS (project notes). Program, what it was asked for, seconds, beta reached.
PEERS = (
    ("push-pull, its authors' program", "beta 0.878", 0.033, 0.878),
    ("push-pull, its authors' program", "beta 0.788", 0.149, 0.788),
    ("push-pull, its authors' program", "beta 0.747", 0.332, 0.747),
    ("voro++, Lloyd", "1000 sweeps", 5.9, 0.856),
    ("Geogram, CVT", "300 Newton steps", 8.1, 0.858),
    ("farthest-point optimization", "rho 0.925", 6.6, 0.936),
)
# The same, for spectra: set, effective Nyquist frequency or nothing, oscillations by the tool PSA.
PEER_SPECTRA = (
    ("MPS", None, 1.59),
    ("push-pull, beta 0.878", 0.75, 2.05),
    ("push-pull, beta 0.788", 0.83, 2.33),
    ("push-pull, beta 0.747", 0.87, 2.68),
    ("push-pull, beta 0.716", 0.905, 2.87),
    ("push-pull, beta 0.689", 0.93, 3.37),
    ("farthest-point optimization", None, 4.70),
    ("CVT", None, 6.22),
)

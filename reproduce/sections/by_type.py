"""Fig. 2: what beta the known types of point set have."""

import math

from reproduce import bodies, formulas, paper
from reproduce.context import beta_upper, proven, sets_of, values
from reproduce.report import agrees, holds, not_available, number, percent, span

CLOSED_FORMS = {"triangular lattice": formulas.TRIANGULAR, "square lattice": formulas.SQUARE,
                "hexagonal lattice": formulas.HEXAGONAL}
LOCAL_TARGET, OWN_TARGET = 0.85, 0.70
COLUMNS = ["point set", "#points", "#sets", "#beta", "#beta_upper", "#max beta_i", "#mean beta_i", "#rho",
           "#closed form", "the paper's"]


def groups(context):
    side, averaged = context.sizes.type_side, context.averaged
    n = side * side
    start = bodies.mps(n)
    return [
        averaged("white noise", bodies.generated("white-noise", n, seed=1)),
        averaged("jittered", bodies.generated("jittered", n, seed=1)),
        bodies.group("Delaunay refinement", bodies.generated("delaunay-refinement", n)),
        averaged("MPS", start),
        # Tori on which these lattices fit exactly.
        bodies.group("hexagonal lattice", bodies.generated("hexagonal", n, domain=bodies.torus(math.sqrt(3), 1))),
        bodies.group("square lattice", bodies.generated("square", n)),
        bodies.group("triangular lattice",
                     bodies.generated("triangular", n, domain=bodies.torus(1, math.sqrt(3) / 2))),
        averaged("CVT", bodies.optimized(start, "cvt", variant="lloyd", max_sweeps=100)),
        averaged("opt-beta-local", bodies.optimized(start, "opt-beta-local", beta=LOCAL_TARGET)),
        averaged("opt-beta", bodies.optimized(start, "opt-beta", beta=OWN_TARGET)),
    ]


def fill(context, section):
    job = context.compare(groups(context), ["spacing", "certificate"])
    by_label = {group["label"]: group for group in job.groups}
    section.text("Ten types of point set on the torus: three that nobody optimized, the paper's input (MPS), the "
                 "three lattices, and what three optimizers make of the MPS sets: CVT (100 sweeps of Lloyd's), "
                 f"opt-beta-local (the paper's Opt-\u03b2\u2071, asked for beta {LOCAL_TARGET:.2f}) and "
                 f"opt-beta (this project's own, asked for {OWN_TARGET:.2f}). beta is the global ratio r_c / r_f; "
                 "beta_i is the local one, a point's farthest place in its cell over the distance of its nearest "
                 "neighbor, and at most beta.")
    section.table("beta by type of point set: mean over the sets (smallest to largest); max beta_i is the largest "
                  "of all sets, and beta_upper is proven for all sets of the row.", COLUMNS, [row(group) for group in job.groups])
    section.text(f"The plot's numbers: {paper.NOT_AVAILABLE}; the last column holds what the abstract says.")
    section.figure(job.picture("voronoi", size_px=245),
                   "Voronoi cells, colored by beta_i, of the first set of each type.",
                   "Voronoi diagrams of ten types of point set, colored by local beta")
    section.text("Where it differs: " + why(by_label), "differs")
    findings(section, by_label)
    section.requests(job.curl())


def row(group):
    label = group["label"]
    closed = CLOSED_FORMS.get(label)
    # White noise has sets of beta 50 and sets of 500.
    beta = group["spacing"]["beta"]
    digits = 3 if beta is not None and beta < 10 else 1
    return [label, str(group["n"]), str(len(sets_of(group))), span(values(group, "beta"), digits),
            number(beta_upper(group), digits), number(formulas.most(values(group, "beta_i_max")), digits),
            number(group["spacing"]["beta_i_mean"]), number(group["spacing"]["rho"]),
            number(closed, 6), paper.BY_TYPE.get(label, not_available())]


def why(by_label):
    local = by_label["opt-beta-local"]
    return ("the abstract speaks of beta_i, and so the largest beta_i of opt-beta-local "
            f"({span(values(local, 'beta_i_max'))} by set) is what compares with \u201caround 0.8\u201d; its "
            f"global beta is {span(values(local, 'beta'))}. It stops at the first sweep after which the global "
            "beta is below the target, or with the best set that it found. opt-beta is not in the paper.")


def findings(section, by_label):
    mps, local, own = by_label["MPS"], by_label["opt-beta-local"], by_label["opt-beta"]
    section.finding("beta of MPS", paper.MPS_BETA,
                    f"{span(values(mps, 'beta'), 4)}; proven: at most {number(beta_upper(mps), 4)}",
                    holds(proven(mps, paper.MPS_BETA.values[0])))
    off = farthest(by_label)
    section.finding("beta of the lattices", paper.FLOOR,
                    f"triangular {number(by_label['triangular lattice']['spacing']['beta'], 6)}; "
                    + ("not all three are known" if off is None else
                       f"all three are within {off:.0e} of 1/\u221a3, 1/\u221a2 and 1"),
                    holds(off if off is None else off < formulas.ROUNDING))
    white = values(by_label["white noise"], "beta")
    section.finding("white noise", paper.WHITE_NOISE, f"beta {span(white, 0)} in {len(white)} sets",
                    "no comparison: a bound can't be missed by examples")
    section.finding("opt-beta-local from MPS", paper.IMPROVEMENT,
                    f"largest beta_i of a set {span(values(mps, 'beta_i_max'))} before, "
                    f"{span(values(local, 'beta_i_max'))} after: {percent(half_way(mps, local), 0)} of the way to "
                    f"1/\u221a3; global beta {span(values(local, 'beta'))}",
                    agrees(rounds_to(local["spacing"]["beta_i_max"], paper.IMPROVEMENT.values[1])))
    section.finding("opt-beta from MPS", "not in the paper",
                    f"global beta {span(values(own, 'beta'))}, proven at most {number(beta_upper(own), 4)}",
                    holds(proven(own, OWN_TARGET)))


def farthest(by_label):
    """Of the lattices' beta from their closed forms; nothing unless all are known."""
    off = [None if by_label[label]["spacing"]["beta"] is None else abs(by_label[label]["spacing"]["beta"] - closed)
           for label, closed in CLOSED_FORMS.items()]
    return None if None in off else max(off)


def rounds_to(value, said):
    return None if value is None else round(value, 1) == said


def half_way(before, after):
    """How much of what separates the first from the triangular lattice is gone, by means of the largest beta_i."""
    start, end = before["spacing"]["beta_i_max"], after["spacing"]["beta_i_max"]
    return None if None in (start, end) else (start - end) / (start - formulas.TRIANGULAR)

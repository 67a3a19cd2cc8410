"""Fig. 8: valences and rho against beta."""

from reproduce import formulas, paper
from reproduce.chart import Chart, Series, axis_over, side_by_side
from reproduce.context import reached, reached_text, values
from reproduce.report import Html, not_available, number, percent, span

VALENCES = (4, 5, 6, 7, 8)
COLUMNS = ["point set", "#reached", "#beta", *(f"#valence {v}" for v in VALENCES), "#other", "#rho", "#mean beta_i"]


def valence_shares(group):
    return formulas.shares(group["spacing"]["valence"])


def fill(context, section):
    references, local, own = context.references, context.local_targets, context.own_targets
    groups = [*references.groups, *local.groups, *own.groups]
    section.text(f"From {context.sizes.seeds} MPS sets of {context.sizes.mesh_points} points to targets from 0.95 "
                 "to 0.70: how many points have that many Delaunay neighbors, and how far apart they are. Six "
                 "neighbors and rho = 1 would be the triangular lattice. \u201cReached\u201d counts sets that came "
                 "to their target by proof; a set that did not is the best that opt-beta-local found in "
                 f"{context.sizes.local_sweeps} sweeps.")
    section.figure(charts(references.groups, local.groups, own.groups),
                   "Left: share of points with six neighbors. Right: rho, with the least that any point set of "
                   "that beta can have, 1 / (\u221a3 beta). Dots without a line are single methods.",
                   "Shares of valence six and rho against beta")
    section.table(f"Shares of all points of {context.sizes.seeds} sets; beta: mean (smallest to largest).", COLUMNS,
                  [row(group) for group in groups] + [known()])
    section.text(f"The paper's curves: {paper.NOT_AVAILABLE}. The last row is what the project notes state of MPS "
                 "in general.")
    mps = references.groups[0]
    section.text("Where it differs: " + why(mps, local.groups, own.groups), "differs")
    findings(section, mps)
    section.requests(references.curl(), local.curl(), own.curl())


def row(group):
    shares = valence_shares(group)
    other = sum(share for valence, share in shares.items() if valence not in VALENCES)
    return [group["label"], reached_text(group), span(values(group, "beta")),
            *(percent(shares.get(v, 0)) for v in VALENCES), percent(other),
            number(group["spacing"]["rho"]), number(group["spacing"]["beta_i_mean"])]


def known():
    return ["MPS, as stated", "\u2013", "at most 1", *(percent(v / 100) for v in paper.MPS_VALENCE.values),
            percent(1 - sum(paper.MPS_VALENCE.values) / 100), number(paper.MPS_RHO.values[0]),
            number(paper.MPS_BETA_I.values[0])]


def charts(references, local, own):
    def curve(groups, y):
        return sorted((group["spacing"]["beta"], y(group)) for group in groups
                      if None not in (group["spacing"]["beta"], y(group)))

    def series(y):
        return [Series("opt-beta-local", curve(local, y)), Series("opt-beta", curve(own, y)),
                *(Series(group["label"], curve([group], y), line=False) for group in references)]

    def six(group):
        return valence_shares(group).get(6, 0)

    def rho(group):
        return group["spacing"]["rho"]

    def chart(title, label, low, curves):
        return Chart(title, x, axis_over(label, low, 1, [y for one in curves for _, y in one.points]), curves)

    x = axis_over("beta", 0.66, 1.02, [group["spacing"]["beta"] for group in (*references, *local, *own)])
    steps = [x.low + k * (x.high - x.low) / 60 for k in range(61)]
    bound = Series("least possible rho", [(b, formulas.least_rho(b)) for b in steps], dashed=True, marks=False)
    return side_by_side([chart("six neighbors", "share with six neighbors", 0.4, series(six)),
                         chart("rho", "rho", 0.55, [*series(rho), bound])],
                        "Share of points with six neighbors, and rho, against beta")


def why(mps, local, own):
    both = [(a, b) for a, b in zip(local, own) if reached(a)[0] == reached(a)[1]]
    texts = [f"{percent(valence_shares(a).get(6, 0), 0)} against {percent(valence_shares(b).get(6, 0), 0)} at "
             f"target {a['label'][-4:]}" for a, b in both]
    return (f"the shares of MPS are within {largest_difference(mps):.1f} percentage points of what is stated. At "
            "the same target opt-beta-local leaves other numbers of six-neighbored points than opt-beta "
            f"({'; '.join(texts) or 'no target was reached by all sets'}): it moves all points in "
            "every sweep, as far as that serves each, opt-beta only those near a violation and no farther than its "
            "radii ask.")


def findings(section, mps):
    spacing = mps["spacing"]
    density = mps["n"] * spacing["r_f"]**2
    shares = valence_shares(mps)
    section.finding("density of MPS", paper.MPS_DENSITY, f"N r_f\u00b2 = {number(density, 4)} A",
                    difference(density, paper.MPS_DENSITY.values[0]))
    section.finding("rho of MPS", paper.MPS_RHO, number(spacing["rho"]),
                    difference(spacing["rho"], paper.MPS_RHO.values[0]))
    section.finding("mean beta_i of MPS", paper.MPS_BETA_I, number(spacing["beta_i_mean"]),
                    difference(spacing["beta_i_mean"], paper.MPS_BETA_I.values[0]))
    section.finding("valences of MPS", paper.MPS_VALENCE,
                    " / ".join(f"{100 * shares.get(v, 0):.1f}" for v in VALENCES) + " %",
                    f"within {largest_difference(mps):.1f} percentage points")


def largest_difference(mps):
    """Of the shares of each valence from those stated, in percentage points."""
    shares = valence_shares(mps)
    return max(abs(100 * shares.get(v, 0) - said) for v, said in zip(VALENCES, paper.MPS_VALENCE.values))


def difference(ours, said):
    return not_available() if ours is None else Html(f"{number(100 * (ours / said - 1), 1)} %")

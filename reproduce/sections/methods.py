"""Figs. 4 and 5: the paper's four methods and ours, all from the same MPS input."""

from reproduce import bodies, paper
from reproduce.context import values
from reproduce.report import number, span

COLUMNS = ["method", "#r_f / d_hex", "#r_c / d_hex", "#beta", "#mean beta_i", "#max beta_i",
           "#smallest angle, \u00b0", "#largest angle, \u00b0", "#longest edge / r_f", "#sd of cell areas", "#sweeps"]


def groups(context):
    start = bodies.mps(context.sizes.methods_points)
    methods = [
        ("opt-beta-local to 0.80", "opt-beta-local", {"beta": 0.80}),
        ("cvt, Lloyd, 100 sweeps", "cvt", {"variant": "lloyd", "max_sweeps": 100}),
        ("distmesh, 100 sweeps", "distmesh", {"max_sweeps": 100}),
        ("far-point", "far-point", {}),
        ("push-pull", "push-pull", {}),
        ("opt-beta to 0.80", "opt-beta", {"beta": 0.80}),
        ("opt-beta to 0.70", "opt-beta", {"beta": 0.70}),
    ]
    return [context.averaged("MPS, the input", start)] + [
        context.averaged(label, bodies.optimized(start, method, **parameters))
        for label, method, parameters in methods]


def fill(context, section):
    job = context.compare(groups(context), ["spacing", "distributions"])
    section.text("The paper's own method and the three that it compares with, then push-pull (Ahmed et al. 2017) "
                 f"and opt-beta, each from the same {context.sizes.seeds} MPS sets of "
                 f"{context.sizes.methods_points} points. Those without a target go as far as the sweeps given "
                 "take them, or until they come to rest; each gives back the best state that it came through.")
    section.text(f"Settings of the paper that are known: {paper.OPT_BETA_I}. {paper.DISTMESH}; here without "
                 "control of density, since the number of points must stay.")
    section.table(f"Mean over {context.sizes.seeds} sets; of beta also the smallest to largest.", COLUMNS,
                  [row(group) for group in job.groups])
    section.text(f"The paper's numbers here: {paper.NOT_AVAILABLE}.")
    section.figure(job.picture("voronoi", size_px=330), "Voronoi cells, colored by beta_i, from the first set.",
                   "Voronoi diagrams before and after each method, colored by local beta")
    section.figure(job.picture("distributions"),
                   "Quality: local ratios, valences, angles, edges, nearest distances and cell areas of all sets "
                   "together.", "Histograms of quality by method")
    section.text("Where it differs: " + why({group["label"]: group for group in job.groups}), "differs")
    section.requests(job.curl())


def row(group):
    spacing = group["spacing"]
    sweeps = [summary["sweeps"] for summary in group.get("optimized", [])]
    return [group["label"], number(spacing["rho"]), number(spacing["coverage"]), span(values(group, "beta")),
            number(spacing["beta_i_mean"]), number(spacing["beta_i_max"]), number(spacing["angle_min_deg"], 1),
            number(spacing["angle_max_deg"], 1), number(spacing["edge_max"]), number(spacing["cell_area_sd"]),
            span(sweeps, 0) if sweeps else number(None)]


def why(by_label):
    def least(name):
        known = [label for label in by_label if "input" not in label and by_label[label]["spacing"][name] is not None]
        return min(known, key=lambda label: by_label[label]["spacing"][name], default=None)

    beta, mean = least("beta"), least("beta_i_mean")
    if None in (beta, mean):
        return "there is no method of which both the global and the mean ratio are available."
    return (f"how many sweeps the paper gave each method is {paper.NOT_AVAILABLE}, so only the order can be "
            f"compared. Here the least global beta is that of {beta}, the least mean beta_i that of {mean}"
            + (": a method that makes most cells regular may leave the worst as it is, and beta is about the worst."
               if beta != mean else "."))

"""Figs. 6 and 11: how beta falls by sweep."""

from reproduce import bodies, formulas, paper
from reproduce.report import number

SWEEPS = (0, 1, 2, 5, 10, 20, 50, 100)


def method_groups(start):
    methods = [("opt-beta-local to 0.80", "opt-beta-local", {"beta": 0.80}),
               ("cvt, Lloyd", "cvt", {"variant": "lloyd", "max_sweeps": 100}),
               ("cvt, accelerated", "cvt", {"variant": "accelerated", "max_sweeps": 100}),
               ("distmesh", "distmesh", {"max_sweeps": 100}),
               ("far-point", "far-point", {"max_sweeps": 100}),
               ("push-pull", "push-pull", {}),
               ("opt-beta to 0.75", "opt-beta", {"beta": 0.75})]
    return [bodies.group(label, bodies.optimized(start, method, **parameters))
            for label, method, parameters in methods]


def setting_groups(start):
    settings = [(f"to {beta:.2f}", {"beta": beta}) for beta in (0.95, 0.90, 0.85, 0.80)]
    settings += [(f"to 0.95, damping {damping:g}", {"beta": 0.95, "damping": damping}) for damping in (0.6, 1)]
    settings += [(f"to 0.80, damping {damping:g}", {"beta": 0.80, "damping": damping}) for damping in (0.6,)]
    return [bodies.group(f"opt-beta-local {label}", bodies.optimized(start, "opt-beta-local", **parameters))
            for label, parameters in settings]


def fill(context, section):
    start = bodies.mps(context.sizes.sweep_points)
    methods = context.compare(method_groups(start), ["spacing"])
    settings = context.compare(setting_groups(start), ["spacing"])
    default = default_damping(context.client.operations())
    section.text(f"One MPS set of {context.sizes.sweep_points} points, and what each method makes of it sweep by "
                 "sweep. In the paper's terms a sweep is one visit to every point; a sweep of opt-beta and of "
                 "push-pull visits only points near a violation, so theirs cost a fraction of the others'.")
    section.figure(methods.picture("convergence", last_sweep=SWEEPS[-1], size_px=290),
                   "beta, coverage radius and conflict radius after each sweep.",
                   "beta, r_c and r_f by sweep, by method")
    section.table("beta after that many sweeps, by the last one recorded; a dash where it was over before, or "
                  "where beta is not available.",
                  ["method", *(f"#{sweep}" for sweep in SWEEPS), "#last sweep", "#beta of the result"],
                  [row(group) for group in methods.groups])
    section.text(f"The paper's curves: {paper.NOT_AVAILABLE}.")
    section.heading("opt-beta-local by target and damping")
    section.figure(settings.picture("convergence", last_sweep=40, size_px=290),
                   "opt-beta-local with several targets and dampings."
                   + (f" Without one given, damping is {default}." if default else "")
                   + f" {same_way(settings.groups)}",
                   "beta, r_c and r_f by sweep of opt-beta-local, by target and damping")
    section.table("The same as numbers.",
                  ["settings", *(f"#{sweep}" for sweep in SWEEPS), "#last sweep", "#beta of the result"],
                  [row(group) for group in settings.groups])
    section.text("Where it differs: " + why(methods.groups[0]), "differs")
    section.requests(methods.curl(), settings.curl())


def default_damping(operations):
    """What opt-beta-local does without one, as the service describes it; nothing if it doesn't."""
    methods = {method["name"]: method for operation in operations["operations"]
               for method in operation.get("methods", [])}
    damping = methods.get("opt-beta-local", {}).get("parameters", {}).get("damping", {})
    return damping.get("description", "").partition("; default: ")[2] or None


def same_way(groups):
    """Of settings whose first sweeps give the same: whether all sweeps do that two of them have both."""
    def betas(group):
        return [record[1] for record in group["optimized"][0]["history"]]

    alike = {}
    for group in groups:
        alike.setdefault(tuple(betas(group)[:2]), []).append(group)
    sentences = []
    for together in (members for members in alike.values() if len(members) > 1):
        longest = max((betas(group) for group in together), key=len)
        same = all(longest[:len(betas(group))] == betas(group) for group in together)
        names = "; ".join(group["label"].removeprefix("opt-beta-local ") for group in together)
        how = "go the same way, and stop earlier or later" if same else "begin alike and part"
        sentences.append(f"These {how}: {names}.")
    return " ".join(sentences) or "No two go the same way."


def row(group):
    run = group["optimized"][0]
    return [group["label"], *(number(formulas.beta_after(run["history"], sweep)) for sweep in SWEEPS),
            str(run["sweeps"]), number(run["beta"])]


def why(local):
    history = local["optimized"][0]["history"]
    if len(history) < 2 or None in (history[0][1], history[1][1]):
        return "opt-beta-local had nothing to do here."
    before, first = history[0][1], history[1][1]
    text = f"the first sweep of opt-beta-local takes the global beta from {number(before)} to {number(first)}. "
    if first > before:
        text += ("It rises, though every single move lowers the mover's own beta_i: a point moves for itself, and "
                 f"its neighbors' distances are not looked at. This project's trials saw it too: "
                 f"{paper.TRIAL_FIRST_SWEEP}. ")
    return text + f"Whether the paper's curves show the like is {paper.NOT_AVAILABLE}."

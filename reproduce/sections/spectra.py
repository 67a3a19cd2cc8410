"""Fig. 9: spectra at each beta."""

from reproduce import formulas, paper
from reproduce.context import MESH_MEASURES, TARGETS, reached, reached_text
from reproduce.report import number

COLUMNS = ["point set", "#reached", "#beta", "#effective Nyquist", "#oscillations", "#anisotropy, dB",
           "#expected, dB", "#peak of the radial mean", "#psi6, global", "#psi6, local", "#psi6, edges"]
PICTURE = {"size_px": 240}


def fill(context, section):
    seeds, n = context.sizes.seeds, context.sizes.mesh_points
    all_local = context.local_targets
    came_to = [beta for beta, group in zip(TARGETS, all_local.groups) if reached(group)[0] == seeds]
    local = context.to_targets("opt-beta-local", came_to, MESH_MEASURES, max_sweeps=context.sizes.local_sweeps) \
        if came_to else None
    own, references = context.own_targets, context.references
    missed = [f"{beta:.2f} ({reached(group)[0]} of {seeds})" for beta, group in zip(TARGETS, all_local.groups)
              if beta not in came_to]
    section.text(f"Power spectra averaged over K = {seeds} sets of {n} points from MPS; frequencies in units of "
                 "\u221a(n / A), white noise has power 1. Effective Nyquist frequency and oscillations are those "
                 "of Heck, Schloemer and Deussen (2013); anisotropy is the mean over rings from 0.5 to 2.5, and "
                 "\u221210 log10 K where nothing has a direction. psi6 is bond order in three variants, each 1 for "
                 "the triangular lattice.")
    section.text(f"opt-beta-local is shown at the targets that all {seeds} sets reached within "
                 f"{context.sizes.local_sweeps} sweeps{'; not at ' + ', '.join(missed) if missed else ''}.")
    show(section, references, "MPS, CVT and far-point")
    if local:
        show(section, local, "opt-beta-local")
    show(section, own, "opt-beta")
    groups = [*references.groups, *(local.groups if local else []), *own.groups]
    section.table(f"What the spectra say, K = {seeds}.", COLUMNS, [row(group) for group in groups])
    section.text(f"The paper's spectra: {paper.NOT_AVAILABLE}.")
    section.table("For comparison, not the paper's: other programs' sets of 10,000 points, measured for this "
                  "project.", ["point set", "#effective Nyquist", "#oscillations"],
                  [[name, number(nyquist), number(omega, 2)] for name, nyquist, omega in paper.PEER_SPECTRA])
    section.text("Where it differs: " + why(local, own), "differs")
    section.requests(*([local.curl()] if local else []), own.curl(), references.curl())


def show(section, job, name):
    section.figure(job.picture("spectrum", **PICTURE), f"{name}: radial mean power and anisotropy.",
                   f"Radial mean power and anisotropy of {name}")
    section.figure(job.picture("periodogram", **PICTURE), f"{name}: periodograms.", f"Periodograms of {name}")


def row(group):
    spectrum, bonds = group["spectrum"], group["bond-order"]
    peak = formulas.most(spectrum["power"])
    return [group["label"], reached_text(group), number(group["spacing"]["beta"]),
            number(spectrum["effective_nyquist"]), number(spectrum["oscillations"], 2),
            number(spectrum["anisotropy_mean_db"], 2),
            number(spectrum["anisotropy_expected_db"], 2), number(peak, 2),
            number(bonds["psi6_global"]), number(bonds["psi6_local"]), number(bonds["psi6_edges"])]


def is_known(group):
    return None not in (group["spectrum"]["oscillations"], group["spacing"]["beta"])


def why(local, own):
    if not local:
        return "opt-beta-local reached none of its targets with all sets."
    pairs = [(a, next(b for b in own.groups if b["label"][-4:] == a["label"][-4:])) for a in local.groups]
    pairs = [pair for pair in pairs if all(map(is_known, pair))]
    less = [b["label"][-4:] for a, b in pairs if b["spectrum"]["oscillations"] < a["spectrum"]["oscillations"]]
    text = f"at the same target opt-beta's spectra oscillate less than opt-beta-local's at {len(less)} of {len(pairs)}"
    text += f" targets{' (' + ', '.join(less) + ')' if less else ''}"
    if len(less) > len(pairs) / 2:
        text += ": points move no farther than its radii ask, and what is left alone stays random"
    past = sum(a["spacing"]["beta"] < b["spacing"]["beta"] for a, b in pairs)
    return text + (f". At {past} of them opt-beta-local went further past the target." if past else ".")

"""Section 6.1: what beta bounds, and whether it does."""

from reproduce import formulas, paper
from reproduce.context import reached, sets_of, target_of, values
from reproduce.report import holds, number, span

COLUMNS = ["point set", "#beta", "#smallest angle: bound", "#measured", "#largest angle: bound", "#measured",
           "#longest edge / r_f: bound", "#measured", "obtuse triangles", "all bounds"]

NOT_KNOWN = "not available"
AT_TARGET = 0.01  # part of the target that beta may be below it


def fill(context, section):
    jobs = (context.references, context.local_targets, context.own_targets)
    groups = [group for job in jobs for group in job.groups]
    section.text(f"The paper: {paper.ANGLES}; {paper.EDGES}; {paper.OBTUSE}. Bounds follow from each set's own "
                 "global beta; each set is held against its own, and the verdict is computed set by set.")
    section.table("Bounds of the set with the largest beta of each row, and the worst that was measured in any; "
                  "angles in degrees.",
                  COLUMNS, [row(group) for group in groups])
    total = [spacing for group in groups for spacing in sets_of(group)]
    judged = [spacing for spacing in total if formulas.all_bounds_hold(spacing) is not None]
    broken = [spacing for spacing in judged if not formulas.all_bounds_hold(spacing)]
    sharp = [spacing for spacing in judged if formulas.no_obtuse_triangle(spacing["beta"])]
    left = len(total) - len(judged)
    section.text(f"{len(judged)} sets were held against their bounds; {len(broken)} break one. "
                 + (f"Of {left} more beta is not available. " if left else "") + f"{len(sharp)} of them "
                 "have beta below 1/\u221a2, and so may have no obtuse triangle; the largest angle among those is "
                 f"{number(max((s['angle_max_deg'] for s in sharp), default=None), 2)} degrees.")
    section.text("Where it differs: on the torus nothing can, these are theorems; the page would say so if it did. "
                 + closest(groups), "differs")
    section.finding("angles, edges and obtuse triangles", f"{paper.ANGLES}; {paper.EDGES}; {paper.OBTUSE}",
                    f"{len(judged) - len(broken)} of {len(total)} sets within all bounds",
                    holds(len(broken) == 0 if judged else None))
    section.requests(*(job.curl() for job in jobs))


def row(group):
    sets = sets_of(group)
    beta = formulas.most(values(group, "beta"))
    low, high = formulas.angle_bounds_deg(beta)
    largest = max(values(group, "angle_max_deg"))
    ok = [formulas.all_bounds_hold(spacing) for spacing in sets]
    obtuse = "some" if largest > 90 * (1 + formulas.ROUNDING) else "none"
    if formulas.no_obtuse_triangle(beta):
        obtuse += ", as it must be" if obtuse == "none" else ", though none may be"
    return [group["label"], span(values(group, "beta")), number(low, 2),
            number(min(values(group, "angle_min_deg")), 2), number(high, 2), number(largest, 2),
            number(formulas.longest_edge_bound(beta)), number(formulas.most(values(group, "edge_max"))), obtuse,
            holds(False if False in ok else None if None in ok else True)]


def closest(groups):
    """How near the smallest angles come to their bound, and why if the numbers show it."""
    def slack(group):
        return min(s["angle_min_deg"] - formulas.angle_bounds_deg(s["beta"])[0] for s in sets_of(group))

    known = [group for group in groups if None not in map(formulas.all_bounds_hold, sets_of(group))]
    if not known:
        return f"How near smallest angles come to their bound is {NOT_KNOWN}."
    near, far = min(known, key=slack), max(known, key=slack)
    text = (f"Smallest angles come nearest to their bound in {near['label']} ({number(slack(near), 3)} degrees "
            f"above it) and stay farthest from it in {far['label']} ({number(slack(far), 2)})")
    if just_at_target(near) and not just_at_target(far):
        return text + (": a method that stops where both radii are just as wanted has many triangles with the largest "
                       "circumradius, and one of them with the shortest edge.")
    return text + (". That a method stops where both radii are just as wanted does not explain it here: that would "
                   "have to be so of the nearest and not of the farthest.")


def just_at_target(group):
    """Whether all sets came to their target, and none went much past it."""
    target = target_of(group)
    if target is None or reached(group)[0] < reached(group)[1]:
        return False
    return min(values(group, "beta")) > (1 - AT_TARGET) * target

"""Section 6.1: what beta bounds, and whether it does."""

from reproduce import formulas, paper
from reproduce.context import sets_of, values
from reproduce.report import holds, number, span

COLUMNS = ["point set", "#beta", "#smallest angle: bound", "#measured", "#largest angle: bound", "#measured",
           "#longest edge / r_f: bound", "#measured", "obtuse triangles", "all bounds"]


def fill(context, section):
    jobs = (context.references, context.local_targets, context.own_targets)
    groups = [group for job in jobs for group in job.groups]
    section.text(f"The paper: {paper.ANGLES}; {paper.EDGES}; {paper.OBTUSE}. Bounds follow from each set's own "
                 "global beta; each set is held against its own, and the verdict is computed set by set.")
    section.table("Bounds of the set with the largest beta of each row, and the worst that was measured in any; "
                  "angles in degrees.",
                  COLUMNS, [row(group) for group in groups])
    total = [spacing for group in groups for spacing in sets_of(group)]
    broken = [spacing for spacing in total if not all(formulas.bounds_hold(spacing).values())]
    sharp = [spacing for spacing in total if formulas.no_obtuse_triangle(spacing["beta"])]
    section.text(f"{len(total)} sets were held against their bounds; {len(broken)} break one. {len(sharp)} of them "
                 "have beta below 1/\u221a2, and so may have no obtuse triangle; the largest angle among those is "
                 f"{number(max((s['angle_max_deg'] for s in sharp), default=None), 2)} degrees.")
    section.text("Where it differs: on the torus nothing can, these are theorems; the page would say so if it did. "
                 + closest(groups), "differs")
    section.finding("angles, edges and obtuse triangles", f"{paper.ANGLES}; {paper.EDGES}; {paper.OBTUSE}",
                    f"{len(total) - len(broken)} of {len(total)} sets within all bounds", holds(not broken))
    section.requests(*(job.curl() for job in jobs))


def row(group):
    sets = sets_of(group)
    beta = max(values(group, "beta"))
    low, high = formulas.angle_bounds_deg(beta)
    largest = max(values(group, "angle_max_deg"))
    ok = [all(formulas.bounds_hold(spacing).values()) for spacing in sets]
    obtuse = "some" if largest > 90 * (1 + formulas.ROUNDING) else "none"
    if formulas.no_obtuse_triangle(beta):
        obtuse += ", as it must be" if obtuse == "none" else ", though none may be"
    return [group["label"], span(values(group, "beta")), number(low, 2),
            number(min(values(group, "angle_min_deg")), 2), number(high, 2), number(largest, 2),
            number(formulas.longest_edge_bound(beta)), number(max(values(group, "edge_max"))), obtuse, holds(all(ok))]


def closest(groups):
    """How near the smallest angles come to their bound."""
    def slack(group):
        return min(s["angle_min_deg"] - formulas.angle_bounds_deg(s["beta"])[0] for s in sets_of(group))

    near, far = min(groups, key=slack), max(groups, key=slack)
    return (f"Smallest angles come nearest to their bound in {near['label']} ({number(slack(near), 3)} degrees "
            f"above it) and stay farthest from it in {far['label']} ({number(slack(far), 2)}): a method that stops "
            "where both radii are just as wanted has many triangles with the largest circumradius, and one of them "
            "with the shortest edge.")

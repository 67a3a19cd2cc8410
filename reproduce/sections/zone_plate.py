"""Fig. 7: the zone plate, an image of rings that get finer outwards, sampled at the points."""

from reproduce import bodies, paper
from reproduce.report import number

PANEL_PX = 350
LATTICE = "square lattice"
COARSE, FINE = 0.5, 1.0  # cycles a mean sample spacing at the end of the lower edge


def optimizer_jobs(context):
    """Each once, to be looked at twice; by label."""
    start = bodies.mps(context.sizes.plate_side**2)
    wanted = [("CVT", "cvt", {"variant": "lloyd", "max_sweeps": context.sizes.plate_sweeps}),
              ("opt-beta-local, 0.85", "opt-beta-local", {"beta": 0.85}),
              ("opt-beta, 0.85", "opt-beta", {"beta": 0.85}),
              ("opt-beta, 0.75", "opt-beta", {"beta": 0.75})]
    return {label: context.client.job("optimize", {"points": start, "method": method, **parameters})
            for label, method, parameters in wanted}


def groups(context, optimized):
    n = context.sizes.plate_side**2
    return [bodies.group("MPS", bodies.mps(n)),
            *(bodies.group(label, {"job": job.id}) for label, job in optimized.items()),
            bodies.group(LATTICE, bodies.generated("square", n))]


def fill(context, section):
    optimized = optimizer_jobs(context)
    coarse, fine = (context.compare(groups(context, optimized),
                                    ["spacing", {"measure": "zone-plate", "frequency": frequency}])
                    for frequency in (COARSE, FINE))
    plate = coarse.groups[0]["zone-plate"]
    side = context.sizes.plate_side
    section.text(f"{side} x {side} = {side**2} samples of {plate['function']}, shown as {plate['columns']} x "
                 f"{plate['rows']} pixels through a Gaussian of sigma = {plate['sigma']} mean sample spacings. At "
                 f"the end of the lower edge the rings have {COARSE:g} cycles a sample spacing (k = "
                 f"{plate['k']:g}), which is the limit of a square lattice, or {FINE:g} (k = "
                 f"{fine.groups[0]['zone-plate']['k']:g}), beyond it. rmse is the root mean square difference of "
                 "the pixels (values from 0 to 1) from the function filtered exactly: aliasing and noise together.")
    section.figure(coarse.picture("zone-plate", frequency=COARSE, size_px=PANEL_PX),
                   f"Rings up to the limit, {COARSE:g} cycles a sample spacing at the end of the lower edge.",
                   "Zone plates of six point sets, up to the limit of a square lattice")
    section.figure(fine.picture("zone-plate", frequency=FINE, size_px=PANEL_PX),
                   f"The same with {FINE:g}. Beyond the limit a lattice shows rings that are not there; random sets "
                   "turn what they can't represent into noise.",
                   "Zone plates of six point sets, beyond the limit of a square lattice")
    section.table("Error of the zone plate.",
                  ["points", "#beta", "#sweeps", f"#rmse, {COARSE:g} cycles", f"#rmse, {FINE:g} cycles"],
                  [row(*pair, optimized) for pair in zip(coarse.groups, fine.groups)])
    section.text(f"The paper's function, filter and errors: {paper.NOT_AVAILABLE}; that it has about 350 x 350 samples "
                 "is what this project's notes say.")
    section.text("Where it differs: function and filter are this service's, so pictures compare in kind only. "
                 + story(coarse.groups, fine.groups), "differs")
    section.requests(*(job.curl() for job in optimized.values()),
                     "# the ids that those answered stand in these:", coarse.curl(), fine.curl())


def row(coarse, fine, optimized):
    job = optimized.get(fine["label"])
    return [fine["label"], number(fine["spacing"]["beta"]), str(job.result["sweeps"]) if job else number(None),
            number(coarse["zone-plate"]["rmse"], 4), number(fine["zone-plate"]["rmse"], 4)]


def story(coarse, fine):
    def order(groups):
        return "; ".join(group["label"] for group in sorted(groups, key=lambda group: group["zone-plate"]["rmse"]))

    return (f"From the smallest error to the largest it is {order(coarse)} up to the limit, and {order(fine)} "
            "beyond it. " + beyond(fine))


def beyond(groups):
    """What the lattice's error there says."""
    lattice = next(group for group in groups if group["label"] == LATTICE)["zone-plate"]["rmse"]
    random = [group["zone-plate"]["rmse"] for group in groups if group["label"] != LATTICE]
    worse = sum(error > lattice for error in random)
    if not worse:
        return "Beyond it the lattice's false rings are the largest error too."
    return (f"A small error is not all there is to it: beyond the limit the lattice's is smaller than that of {worse} "
            f"of the {len(random)} random sets, and it is false rings, while theirs is noise.")

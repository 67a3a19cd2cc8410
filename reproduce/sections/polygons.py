"""Table 1, Figs. 10 and 12: a bounded domain that is not convex, with a hole."""

from reproduce import bodies, paper
from reproduce.mesh_drawing import draw
from reproduce.report import bar_verdict, number

# Ours: the paper's outline is not published. Its radii are kept.
OUTLINE = {"type": "polygon", "rings": [
    [[0, 0], [0.9, 0], [1, 0.12], [1, 0.55], [0.72, 0.55], [0.62, 0.4], [0.5, 0.55], [0.5, 0.8], [0.15, 0.8], [0, 0.62]],
    [[0.2, 0.2], [0.32, 0.14], [0.4, 0.22], [0.36, 0.36], [0.24, 0.38]]]}
RADII = (("coarse", 0.0314), ("fine", 0.0157))
BARS = (0.82, 0.80)
COLUMNS = ["method", "#points", "#r_f", "#r_c", "#beta", "#beta_upper", "#mean beta_i", "#smallest angle, \u00b0",
           "#largest angle, \u00b0"]


def start(radius, seed=1):
    return {"generate": {"method": "poisson-disk", "radius": radius, "seed": seed, "domain": OUTLINE}}


def groups(radius):
    points = start(radius)
    methods = [
        ("opt-beta-local to 0.80", "opt-beta-local", {"beta": 0.80}),
        ("opt-beta to 0.75", "opt-beta", {"beta": 0.75}),
        ("cvt, Lloyd, 100 sweeps", "cvt", {"variant": "lloyd", "max_sweeps": 100}),
        ("distmesh, 100 sweeps", "distmesh", {"max_sweeps": 100}),
        ("far-point", "far-point", {}),
    ]
    return [bodies.group("MPS, the input", points)] + [
        bodies.group(label, bodies.optimized(points, method, **parameters)) for label, method, parameters in methods]


def fill(context, section):
    section.text("Corners and edges of the boundary are sampled first and slide along their edges afterwards; places outside "
                 "count for nothing. The paper's outline is not published: this one is ours, with its radii. "
                 f"What the paper says: {paper.TABLE_1}.")
    jobs = []
    for k, (name, radius) in enumerate(RADII):
        if name not in context.sizes.polygon_radii:
            continue
        job = context.compare(groups(radius), ["spacing", "certificate"])
        jobs.append(job)
        section.table(f"{name.capitalize()}: r = {radius}. r_f is that of all pairs but fixed corner to fixed corner.", COLUMNS,
                      [row(group) for group in job.groups])
        ours = {group["label"]: group for group in job.groups}["opt-beta to 0.75"]
        upper = ours["certificate"]["beta_upper"]
        section.finding(f"bounded domain, {name}", f"beta {paper.TABLE_1.values[k]} [{paper.TABLE_1.source}]",
                        f"{number(upper)} by proof", bar_verdict(upper, BARS[k], rivals_beat(job.groups, ours)))
    section.text("Where it differs: " + why(jobs), "differs")
    meshes = [(method, [context.client.job("mesh", {"points": points, "method": method}) for points in ends()])
              for method in ("delaunay", "voronoi")]
    for method, made in meshes:
        kind = "Constrained Delaunay triangles" if method == "delaunay" else "Voronoi cells, clipped to the domain, colored by their corners"
        section.figure(draw([(title, job.result) for title, job in zip(("MPS", "opt-beta to 0.75"), made)]),
                       f"{kind}, before and after, r = {RADII[0][1]}.", f"{kind} before and after optimization")
    section.table("The Delaunay meshes.", ["mesh", "#triangles", "#smallest angle, \u00b0", "#largest angle, \u00b0",
                                           "#largest aspect ratio", "#area of all / of the domain"],
                  [quality_row(title, job.result["quality"]) for title, job in zip(("MPS", "opt-beta to 0.75"), meshes[0][1])])
    section.requests(*(job.curl() for job in jobs), *(job.curl() for _, made in meshes for job in made))


def ends():
    points = start(RADII[0][1])
    return points, bodies.optimized(points, "opt-beta", beta=0.75)


def row(group):
    spacing = group["spacing"]
    return [group["label"], str(group["n"]), number(spacing["r_f_free"], 4), number(spacing["r_c"], 4), number(spacing["beta"]),
            number(group["certificate"]["beta_upper"]), number(spacing["beta_i_mean"]), number(spacing["angle_min_deg"], 1),
            number(spacing["angle_max_deg"], 1)]


def quality_row(title, quality):
    return [title, str(quality["faces"]), number(quality["angle_deg"]["min"], 1), number(quality["angle_deg"]["max"], 1),
            number(quality["aspect_ratio"]["max"], 2), number(quality["area"] / quality["domain_area"], 9)]


def rivals_beat(groups, ours):
    """Those that are better in r_f, r_c and beta at once."""
    def better(group):
        a, b = group["spacing"], ours["spacing"]
        return (None not in (a["beta"], b["beta"]) and a["beta"] < b["beta"] and a["r_c"] < b["r_c"]
                and a["r_f_free"] > b["r_f_free"])
    return [group["label"] for group in groups if group is not ours and better(group)]


def why(jobs):
    texts = []
    for (name, _), job in zip(RADII, jobs):
        known = [group for group in job.groups if group["spacing"]["beta"] is not None]
        if not known:
            continue
        worst = max((group for group in known if "input" not in group["label"]), default=known[0],
                    key=lambda group: group["spacing"]["beta"])
        texts.append(f"{name}: the largest beta after optimization is that of {worst['label']}, {number(worst['spacing']['beta'])}")
    return ("on a bounded domain the cells at the boundary decide: a point there has one degree of freedom only, and those in corners "
            "none. What the others push towards the boundary comes so near to it that triangles become flat: points inside stay inside, "
            f"as the input has them ({'; '.join(texts) or 'no beta is known'}).")

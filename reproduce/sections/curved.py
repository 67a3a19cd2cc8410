"""Figs. 13 to 15: the sphere and a surface, with and without a sizing function."""

import os
import pathlib

from reproduce import bodies, paper
from reproduce.mesh_drawing import draw
from reproduce.report import Html, bar_verdict, number

SPHERE = {"type": "sphere", "radius": 1}
SPHERE_BAR = 0.72
SPHERE_SIZING = {"type": "linear", "axis": "z", "from": 0.21, "to": 0.01}
COLUMNS = ["point set", "#points", "#beta", "#beta_upper", "#mean beta_i", "#smallest angle, \u00b0", "#largest angle, \u00b0", "#sweeps"]
SOURCES = pathlib.Path(__file__).resolve().parents[2]


def surface_file():
    """The paper's Fertility where it is to be had, else a smaller surface with a handle."""
    folder = os.environ.get("WELLSPACED_DATA_DIR")
    fertility = pathlib.Path(folder or "/nowhere") / "meshes" / "fertility_small.off"
    return fertility if fertility.exists() else SOURCES / "tests" / "data" / "meshes" / "bob_small.ply"


def made(domain, sizing=None, **fields):
    body = {"method": "poisson-disk", "seed": 1, "domain": domain, **fields}
    if sizing is not None:
        body["sizing"] = sizing
    return {"generate": body}


def fill(context, section):
    sphere(context, section)
    sized_sphere(context, section)
    surface(context, section)


def compared(context, section, caption, start, methods):
    groups = [bodies.group("MPS", start)] + [bodies.group(label, bodies.optimized(start, method, **parameters))
                                             for label, method, parameters in methods]
    job = context.compare(groups, ["spacing", "certificate"])
    section.table(caption, COLUMNS, [row(group) for group in job.groups])
    section.requests(job.curl())
    return job


def row(group):
    spacing = group["spacing"]
    certificate = group.get("certificate") or {}
    sweeps = [str(run["sweeps"]) for run in group.get("optimized", [])]
    return [group["label"], str(group["n"]), number(spacing["beta"]), number(certificate.get("beta_upper")),
            number(spacing["beta_i_mean"]), number(spacing["angle_min_deg"], 1), number(spacing["angle_max_deg"], 1),
            sweeps[0] if sweeps else number(None)]


def meshes(context, method, start, end, **how):
    return draw([(title, context.client.job("mesh", {"points": points, "method": method}).result)
                 for title, points in (("MPS", start), ("opt-beta", end))], **how)


def sphere(context, section):
    section.heading("Fig. 13: the sphere")
    start, sweeps = made(SPHERE, count=1000), context.sizes.curved_sweeps
    job = compared(context, section, "1000 points.", start, [
        ("opt-beta to 0.72", "opt-beta", {"beta": SPHERE_BAR}),
        ("opt-beta-local to 0.75", "opt-beta-local", {"beta": 0.75, "max_sweeps": sweeps}),
        (f"cvt, Lloyd, {sweeps} sweeps", "cvt", {"variant": "lloyd", "max_sweeps": sweeps}),
        ("far-point", "far-point", {"max_sweeps": sweeps})])
    upper = job.groups[1]["certificate"]["beta_upper"]
    section.finding("sphere", paper.SPHERE, f"{number(upper)} by proof", bar_verdict(upper, SPHERE_BAR))
    section.figure(meshes(context, "voronoi", start, bodies.optimized(start, "opt-beta", beta=SPHERE_BAR), azimuth_deg=20, tilt_deg=20),
                   "Voronoi cells of 1000 points, colored by their corners.", "Voronoi cells on a sphere before and after")
    section.text(f"What the paper says: {paper.SPHERE}. Where it differs: beta here is proven, and the lower one comes of an optimizer "
                 "that goes for the global ratio.", "differs")


def sized_sphere(context, section):
    section.heading("Fig. 14: the sphere with a sizing function")
    start = made(SPHERE, SPHERE_SIZING)
    compared(context, section, "Radii linear in z from 0.21 at the south pole to 0.01 at the north pole; beta with each point's own radius.",
             start, [("opt-beta to 0.80", "opt-beta", {"beta": 0.80}), ("opt-beta-local to 0.80", "opt-beta-local",
                                                                     {"beta": 0.80, "max_sweeps": context.sizes.curved_sweeps})])
    section.figure(meshes(context, "delaunay", start, bodies.optimized(start, "opt-beta", beta=0.80), azimuth_deg=20, tilt_deg=35),
                   "Delaunay triangles.", "Triangles on a sphere that become finer to the north, before and after")


def surface(context, section):
    path = surface_file()
    section.heading("Fig. 15: a surface with a sizing function")
    known = context.client.upload(path)
    domain = {"type": "mesh", "id": known["id"]}
    section.text(f"{path.name}: {known['faces']} faces, genus {known['genus']}, uploaded once. Radii grow from 1 to 3 across it, and "
                 f"{context.sizes.surface_points} points are asked for.")
    sizing = {"type": "linear", "axis": "x", "from": 1, "to": 3}
    start = made(domain, sizing, count=context.sizes.surface_points)
    job = compared(context, section, "beta with each point's own radius; nothing is proven on meshes.", start,
                   [("opt-beta to 0.80", "opt-beta", {"beta": 0.80})])
    before, after = (group["spacing"]["beta_i_mean"] for group in job.groups[:2])
    falls = None not in (before, after) and after < before
    section.finding("surface with a sizing function", paper.IMPROVEMENT,
                    f"mean beta_i {number(before)} to {number(after)}",
                    Html(f'<span class="{"holds" if falls else "fails"}">{"falls" if falls else "does not fall"}</span>'))
    section.figure(meshes(context, "delaunay", start, bodies.optimized(start, "opt-beta", beta=0.80), azimuth_deg=200, tilt_deg=25, up=1),
                   "Delaunay triangles of the points, on the surface.", "A triangulated surface, before and after")

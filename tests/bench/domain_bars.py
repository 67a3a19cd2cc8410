#!/usr/bin/env python3
"""Time, memory and beta of the main work on other domains than the torus, each as a process of its own.

usage: domain_bars.py PROGRAM [--long | --meshes]
--long: a million points, too
--meshes: how long Delaunay and Voronoi meshes take instead, beyond making their points; with --long also of a million
The surface is fertility_small.off of the folder that WELLSPACED_DATA_DIR names; without it that row is left out.
"""

import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from reproduce.sections.polygons import OUTLINE  # noqa: E402: the path comes first

SPHERE = {"type": "sphere"}


def jagged(edges):
    """A polygon with seven lobes and a jagged edge."""
    random.seed(1)
    ring = []
    for k in range(edges):
        angle = 2 * math.pi * k / edges
        radius = 1 + 0.3 * math.sin(7 * angle) + 0.02 * random.random()
        ring.append([radius * math.cos(angle), radius * math.sin(angle)])
    return {"type": "polygon", "rings": [ring]}


def read_off(path):
    words = " ".join(line.split("#")[0] for line in path.read_text().splitlines()).split()
    vertices, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    places = [[float(x) for x in numbers[3 * k:3 * k + 3]] for k in range(vertices)]
    rest = numbers[3 * vertices:]
    return {"type": "mesh", "vertices": places,
            "faces": [[int(x) for x in rest[4 * k + 1:4 * k + 4]] for k in range(faces)]}


def run(program, operation, request, folder, answer="result.json"):
    """Seconds, MB and, as JSON, the result."""
    asked, answered = folder / "request.json", folder / answer
    asked.write_text(json.dumps(request))
    started = time.perf_counter()
    process = subprocess.Popen([program, "run", operation, str(asked), "-o", str(answered)])
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - started
    if status != 0:
        sys.exit(f"{operation} failed")
    return seconds, usage.ru_maxrss / 1e3, json.loads(answered.read_text()) if answer.endswith("json") else None


def optimized(domain, beta, sizing=None, **density):
    made = {"domain": domain, **density}
    if sizing is not None:
        made["sizing"] = sizing
    return {"points": {"generate": made}, "beta": beta}


def rows(long):
    yield "sphere, 1000 points, opt-beta to .72", "optimize", optimized(SPHERE, 0.72, count=1000), "at most .3 s"
    for name, radius, bar in (("coarse", 0.0314, 0.82), ("fine", 0.0157, 0.80)):
        yield (f"Table 1, {name}: polygon with a hole, r {radius}, opt-beta to .75", "optimize",
               optimized(OUTLINE, 0.75, radius=radius), f"beta at most {bar}")
    folder = os.environ.get("WELLSPACED_DATA_DIR")
    if folder:
        surface = read_off(pathlib.Path(folder) / "meshes" / "fertility_small.off")
        sizing = {"type": "linear", "axis": "x", "from": 1, "to": 3}
        yield ("fertility_small, linear sizing 1 to 3, 10,000 points, opt-beta to .80", "optimize",
               optimized(surface, 0.80, sizing, count=10_000), "at most 10 s")
    request = {"domain": jagged(10_000), "allow_small_features": True, "radius": 0.0048}
    yield "polygon of 10,000 edges, 100,000 points of MPS", "generate", request, ""
    if long:
        yield ("polygon of 10,000 edges, a million points of MPS", "generate", request | {"radius": 0.00152},
               "at most 60 s and 1 GB")


def mesh_rows(long):
    for n in (100_000, 1_000_000) if long else (100_000,):
        yield f"torus, {n} points", {"count": n}
    yield "box, 100,000 points", {"domain": {"type": "box"}, "count": 100_000}
    yield ("polygon of 10,000 edges, 100,000 points",
           {"domain": jagged(10_000), "allow_small_features": True, "radius": 0.0048})
    yield "sphere, 100,000 points", {"domain": SPHERE, "count": 100_000}
    folder = os.environ.get("WELLSPACED_DATA_DIR")
    if folder:
        surface = read_off(pathlib.Path(folder) / "meshes" / "fertility_small.off")
        yield "fertility_small, 10,000 points", {"domain": surface, "count": 10_000}


def time_meshes(program, long, folder):
    for name, made in mesh_rows(long):
        alone, _, _ = run(program, "generate", made, folder, "points.npy")
        said = []
        for method in ("delaunay", "voronoi"):
            request = {"points": {"generate": made}, "method": method}
            seconds, megabytes, _ = run(program, "mesh", request, folder, "mesh.ply")
            said.append(f"{method} {seconds - alone:.2f} s, {megabytes:.0f} MB")
        print(f"{name}: {'; '.join(said)}", flush=True)


def main():
    program, long = sys.argv[1], "--long" in sys.argv[2:]
    with tempfile.TemporaryDirectory() as folder:
        if "--meshes" in sys.argv[2:]:
            time_meshes(program, long, pathlib.Path(folder))
            return
        for name, operation, request, bar in rows(long):
            seconds, megabytes, result = run(program, operation, request, pathlib.Path(folder))
            beta = result.get("beta_upper") or result.get("beta")
            said = f", beta {beta:.4f}, mean beta_i {result['beta_i_mean']:.4f}" if beta else ""
            print(f"{name}: {seconds:.2f} s, {megabytes:.0f} MB, {result['n']} points{said}" +
                  (f" (bar: {bar})" if bar else ""), flush=True)


if __name__ == "__main__":
    main()

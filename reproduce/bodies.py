"""Bodies of requests, and how they are sent by hand."""

import json
import shlex

MOST_GROUPS = 16
LONGEST_LABEL = 60


def generated(method, count, seed=None, domain=None):
    """Points out of a generator; without a seed for those that take none."""
    fields = {"method": method, "count": count}
    if seed is not None:
        fields["seed"] = seed
    if domain is not None:
        fields["domain"] = domain
    return {"generate": fields}


def mps(count, seed=1):
    return generated("poisson-disk", count, seed)


def optimized(points, method, **parameters):
    return {"optimize": {"points": points, "method": method, **parameters}}


def torus(width, height):
    return {"type": "torus", "width": width, "height": height}


def group(label, points, seeds=None):
    """One of several that are compared: `seeds` sets of consecutive seeds, or one set."""
    if len(label) > LONGEST_LABEL:
        raise ValueError(f"a label has at most {LONGEST_LABEL} characters: {label}")
    fields = {"label": label, "points": points}
    if seeds is not None:
        fields["seeds"] = seeds
    return fields


def comparison(groups, measures):
    if not 1 <= len(groups) <= MOST_GROUPS:
        raise ValueError(f"1 to {MOST_GROUPS} groups can be compared, not {len(groups)}")
    return {"compare": groups, "measures": measures}


def picture_query(name, kind, parameters):
    """format=svg&picture=voronoi&picture.size_px=240"""
    pairs = [("format", kind), ("picture", name)]
    pairs += [(f"picture.{key}", value) for key, value in parameters.items()]
    return "&".join(f"{key}={value}" for key, value in pairs)


def curl(path, body, respond_async=False):
    """The request as a command for a shell, to the address where ./dev serve listens."""
    prefer = "-H 'Prefer: respond-async' " if respond_async else ""
    data = shlex.quote(json.dumps(body))
    return f"curl -s localhost:8080{path} {prefer}-H 'Content-Type: application/json' -d {data}"

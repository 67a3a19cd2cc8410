"""Meshes as SVG: planar ones as they are, others in parallel projection with what is in front on top."""

import html
import math

from reproduce.client import Picture

SIDE, GAP, TITLE = 340, 14, 22
LIGHT = (-0.4, -0.5, 0.77)  # from where it comes, as the drawing has it: right, down, towards us
FILLS = {4: (232, 150, 110), 5: (246, 200, 160), 6: (236, 240, 245), 7: (168, 200, 232), 8: (110, 155, 205)}
OTHER_FILL = (150, 120, 170)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def normalized(a):
    length = math.sqrt(dot(a, a)) or 1.0
    return tuple(x / length for x in a)


def view(vertices, azimuth_deg=0.0, tilt_deg=0.0, up=2):
    """Right, down and towards the eye of each vertex. Planar ones are seen from above."""
    if len(vertices[0]) == 2:
        return [(x, -y, 0.0) for x, y in vertices]
    a, t = math.radians(azimuth_deg), math.radians(tilt_deg)
    seen = []
    for vertex in vertices:
        height = vertex[up]
        east, north = vertex[(up + 1) % 3], vertex[(up + 2) % 3]
        right, deep = east * math.cos(a) + north * math.sin(a), north * math.cos(a) - east * math.sin(a)
        seen.append((right, -(height * math.cos(t) + deep * math.sin(t)), height * math.sin(t) - deep * math.cos(t)))
    return seen


def panel(mesh, title, left, **how):
    seen = view(mesh["vertices"], **how)
    flat = len(mesh["vertices"][0]) == 2
    low = [min(p[k] for p in seen) for k in range(2)]
    size = max(max(p[k] for p in seen) - low[k] for k in range(2))
    scale = SIDE / size
    middle = [(SIDE - scale * (max(p[k] for p in seen) - low[k])) / 2 for k in range(2)]
    at = [(left + middle[0] + scale * (x - low[0]), TITLE + middle[1] + scale * (y - low[1]), z) for x, y, z in seen]
    cells = "face_points" in mesh
    drawn = []
    for face in mesh["faces"]:
        corners = [seen[v] for v in face]
        normal = [0.0, 0.0, 0.0]
        for b, c in zip(corners[1:], corners[2:]):
            part = cross([x - y for x, y in zip(b, corners[0])], [x - y for x, y in zip(c, corners[0])])
            normal = [x + y for x, y in zip(normal, part)]
        towards = -normal[2]  # the y axis points down, which turns faces over
        if not flat and towards <= 0:
            continue
        shade = 1.0 if flat else 0.55 + 0.45 * max(0.0, dot(normalized([-x for x in normal]), LIGHT))
        fill = FILLS.get(len(face), OTHER_FILL) if cells else FILLS[6]
        depth = sum(p[2] for p in corners) / len(corners)
        path = " ".join(f"{at[v][0]:.1f},{at[v][1]:.1f}" for v in face)
        color = "#" + "".join(f"{int(shade * channel):02x}" for channel in fill)
        drawn.append((depth, f'<polygon points="{path}" fill="{color}"/>'))
    drawn.sort(key=lambda item: item[0])
    text = (f'<text x="{left + SIDE / 2:.0f}" y="15" text-anchor="middle" font-size="13" '
            f'font-family="DejaVu Sans, Verdana, sans-serif" fill="#1c1e21" stroke="none">{html.escape(title)}</text>')
    return text + "".join(item[1] for item in drawn)


def draw(panels, **how):
    """Panels are (title, mesh as the service answers)."""
    width, height = len(panels) * (SIDE + GAP) - GAP, SIDE + TITLE + 4
    body = "".join(panel(mesh, title, k * (SIDE + GAP), **how) for k, (title, mesh) in enumerate(panels))
    return Picture("svg", (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
                           f'viewBox="-2 0 {width + 4} {height}" stroke="#3b4350" stroke-width="0.5" '
                           f'stroke-linejoin="round">{body}</svg>').encode())

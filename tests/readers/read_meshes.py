#!/usr/bin/env python3
"""Reads the meshes that wellspaced writes with programs that it knows nothing of, meshio and VTK, and compares what they
find with the JSON result.

usage: read_meshes.py PROGRAM
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

import meshio
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

L_WITH_HOLE = {"type": "polygon", "rings": [[[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]],
                                            [[0.2, 0.2], [0.4, 0.2], [0.3, 0.4]]]}
TETRAHEDRON = {"type": "mesh", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
               "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}
DOMAINS = {"torus": {"type": "torus", "width": 2}, "strip": {"type": "box", "periodic": [True, False]},
           "box": {"type": "box"}, "polygon": L_WITH_HOLE, "sphere": {"type": "sphere"}, "mesh": TETRAHEDRON}


def polygon_area(corners):
    """Of a polygon in space, by the sum of cross products."""
    total = numpy.zeros(3)
    for a, b in zip(corners[1:], corners[2:]):
        total += numpy.cross(a - corners[0], b - corners[0])
    return float(numpy.linalg.norm(total)) / 2


def canonical(face):
    """A face from its lowest vertex on."""
    face = [int(v) for v in face]
    at = face.index(min(face))
    return tuple(face[at:] + face[:at])


def read_by_meshio(path):
    mesh = meshio.read(path)
    return mesh.points, [face for block in mesh.cells for face in block.data]


def read_by_vtk(path):
    readers = {".ply": vtk.vtkPLYReader, ".obj": vtk.vtkOBJReader, ".vtu": vtk.vtkXMLUnstructuredGridReader}
    reader = readers[path.suffix]()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    faces = []
    for k in range(data.GetNumberOfCells()):
        ids = data.GetCell(k).GetPointIds()
        faces.append([ids.GetId(m) for m in range(ids.GetNumberOfIds())])
    if path.suffix == ".vtu":
        attributes = data.GetPointData() if data.GetPointData().HasArray("point") else data.GetCellData()
        assert attributes.HasArray("point"), "which point is which is missing"
    return vtk_to_numpy(data.GetPoints().GetData()), faces


def check(name, told, places, faces, tolerance):
    wanted = numpy.array([row + [0.0] * (3 - len(row)) for row in told["vertices"]])
    places = numpy.array(places, dtype=float)
    if places.shape[1] == 2:
        places = numpy.column_stack([places, numpy.zeros(len(places))])
    assert places.shape == wanted.shape, f"{name}: {places.shape} vertices, not {wanted.shape}"
    off = float(numpy.abs(places - wanted).max())
    assert off <= tolerance, f"{name}: vertices are off by {off}"
    found, expected = sorted(map(canonical, faces)), sorted(map(canonical, told["faces"]))
    assert found == expected, f"{name}: other faces"
    area = math.fsum(polygon_area(wanted[numpy.array(face)]) for face in faces)
    assert abs(area - told["quality"]["area"]) <= 1e-9 * area, f"{name}: area {area}"


def main():
    program = sys.argv[1]
    folder = pathlib.Path(tempfile.mkdtemp())
    read = 0
    for kind, domain in DOMAINS.items():
        for method in ("delaunay", "voronoi"):
            request = folder / f"{kind}-{method}.json"
            request.write_text(json.dumps(
                {"points": {"generate": {"count": 400, "seed": 3, "domain": domain}}, "method": method}))
            files = {}
            for ending in ("result.json", "ply", "obj", "vtu"):
                files[ending] = folder / f"{kind}-{method}.{ending}"
                subprocess.run([program, "run", "mesh", str(request), "-o", str(files[ending])], check=True)
            told = json.loads(files["result.json"].read_text())
            for ending in ("ply", "obj", "vtu"):
                for reader, single in ((read_by_meshio, False), (read_by_vtk, True)):
                    # VTK keeps the places of PLY and OBJ files in single precision.
                    tolerance = 1e-6 if single and ending != "vtu" else 0.0
                    places, faces = reader(files[ending])
                    check(f"{files[ending].name} by {reader.__name__}", told, places, faces, tolerance)
                    read += 1
    print(f"{read} readings, all as they were written")


if __name__ == "__main__":
    main()

#pragma once

#include <string>

#include "core/mesh/mesh.h"

namespace wellspaced {

// Meshes as files that other programs open. Numbers are exact: doubles in binary, or the shortest text that
// reads back as the same. All are little-endian. Errors: none. Cost: linear, about 50 ns a number of text.

/// PLY, binary: double x, y, z; faces as vertex_indices of int, counted by uchar where all have at most 255
/// corners, else by int; "point" (int, -1: none) of each vertex of a Delaunay mesh. Not of the faces of a
/// Voronoi mesh: meshio can't read faces with anything else in them.
std::string write_ply(const Mesh& mesh);

/// Wavefront OBJ: lines v and f, numbered from 1. It has no place for which point is which.
std::string write_obj(const Mesh& mesh);

/// VTK XML unstructured grid, with base64 data: triangles and polygons, and the array "point" (Int64, -1:
/// none), of points or of cells.
std::string write_vtu(const Mesh& mesh);

}  // namespace wellspaced

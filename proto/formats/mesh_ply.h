#pragma once

#include <string_view>

#include "proto/formats/mesh.h"

namespace wellspaced {

/// Reads a mesh in the Stanford format, version 1.0: ascii, binary_little_endian or binary_big_endian.
///
/// Of the element "vertex" the scalar properties x, y and z are read, of the element "face" the list
/// "vertex_indices" or "vertex_index" of integers; other properties and elements, of all eight types and
/// their newer names, are skipped. Errors: see read_mesh; also malformed_request for bytes after the last
/// element, and invalid_parameters for a file without vertices or faces of this kind (point clouds, triangle
/// strips).
Triangles read_ply(std::string_view bytes, const MeshLimits& limits);

}  // namespace wellspaced

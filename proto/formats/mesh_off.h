#pragma once

#include <string_view>

#include "proto/formats/mesh.h"

namespace wellspaced {

/// Reads a mesh in Geomview's text format: the word OFF, the counts of vertices, faces and edges (that one
/// may be missing and isn't looked at), then a vertex a line, then a face a line as its number of corners and
/// their vertices, from 0.
///
/// What follows on a line, such as colors, is skipped; so are normals, colors and texture coordinates of
/// STOFF, COFF, NOFF and their combinations. '#' begins a comment; blank lines and CRLF are fine. Errors: see
/// read_mesh; also invalid_parameters for binary, 4-dimensional and n-dimensional OFF, and malformed_request
/// for what follows the last face.
Triangles read_off(std::string_view bytes, const MeshLimits& limits);

}  // namespace wellspaced

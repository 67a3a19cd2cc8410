#pragma once

#include <string_view>

#include "proto/formats/mesh.h"

namespace wellspaced {

/// Reads a mesh from Wavefront's text format: "v x y z" and "f a b c ...", where a is a vertex from 1 on, or
/// from -1 on backwards from the last one so far; after it may stand a texture coordinate and a normal
/// (a/t/n, a//n), which are skipped, as are vt, vn, groups, materials, lines and points. A '\' at the end of
/// a line goes on on the next.
///
/// Errors: see read_mesh; also malformed_request for statements of free-form curves and surfaces and for
/// unknown ones.
Triangles read_obj(std::string_view bytes, const MeshLimits& limits);

/// Whether a line of OBJ may begin with this word.
bool is_obj_statement(std::string_view word);

}  // namespace wellspaced

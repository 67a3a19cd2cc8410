#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/domain/triangle_mesh.h"

namespace wellspaced {

enum class MeshFormat { off, obj, ply };

struct MeshLimits {
  std::size_t vertices = 2'000'000, faces = 4'000'000;
};

/// "off", "obj", "ply": as in file extensions.
std::string_view name_of(MeshFormat format);
std::optional<MeshFormat> mesh_format_named(std::string_view name);
/// "model/obj", "model/ply", "text/prs.wavefront-obj" and the like; nothing for general ones such as
/// text/plain.
std::optional<MeshFormat> mesh_format_of_media_type(std::string_view media_type);
/// By what the bytes begin with. Errors: malformed_request naming what is taken.
MeshFormat detect_mesh_format(std::string_view bytes);

/// Reads a mesh: see read_off, read_obj and read_ply for what is taken. Whether it is a surface is for
/// TriangleMesh to say; so are NaN and infinity.
///
/// Polygons of up to 64 corners are cut into triangles, a fan from the first of their corners from which none
/// of these turns over; so they need be neither planar nor convex. Faces are numbered after that.
///
/// Errors: malformed_request for bytes that can't be read; invalid_parameters (with "/faces/k" of the file)
/// for an index out of range and a polygon that no fan fills; too_large above a limit. Each names the line,
/// or the byte in binary files. Nothing is allocated before what a header announces is held against the bytes
/// that are there. Cost: linear, about 50 ns a number.
Triangles read_mesh(std::string_view bytes, MeshFormat format, const MeshLimits& limits = {});

}  // namespace wellspaced

#include "proto/formats/polygon_mesh.h"

#include <utility>

#include "core/error.h"

namespace wellspaced {
namespace {

void check_limit(std::uint64_t count, std::size_t limit, const std::string& what) {
  if (count > limit)
    throw Error(ErrorCode::too_large, "the mesh has more than " + std::to_string(limit) + " " + what +
                                          ", which is the limit; simplify it");
}

}  // namespace

void PolygonMesh::expect_vertices(std::uint64_t count) {
  check_limit(count, limits_.vertices, "vertices");
  vertices_.reserve(count);
}

void PolygonMesh::expect_faces(std::uint64_t count) {
  check_limit(count, limits_.faces, "faces");
  faces_.reserve(count);
  corners_.reserve(3 * count);
}

void PolygonMesh::add_vertex(Vec3 p) {
  check_limit(vertices_.size() + 1, limits_.vertices, "vertices");
  vertices_.push_back(p);
}

void PolygonMesh::close_face(std::size_t place) {
  const std::size_t size = corners_.size() - (faces_.empty() ? 0 : faces_.back().end);
  faces_.push_back({corners_.size(), place});
  check_limit(faces_.size(), limits_.faces, "faces");
  if (size < 3)
    throw Error(ErrorCode::malformed_request, name_of_face(faces_.size() - 1) + " has only " +
                                                  std::to_string(size) + " corners; remove it");
  if (size > most_corners)
    throw Error(ErrorCode::invalid_parameters,
                name_of_face(faces_.size() - 1) + " has " + std::to_string(size) +
                    " corners; cut faces of more than 64 into smaller ones",
                "/faces/" + std::to_string(faces_.size() - 1));
}

std::string PolygonMesh::name_of_face(std::size_t face) const {
  return "face " + std::to_string(face) + " (" + unit_ + " " + std::to_string(faces_[face].place) +
         " of the " + what_ + ")";
}

std::size_t PolygonMesh::read_corners(std::size_t face, Corners& corners) const {
  const std::size_t begin = face == 0 ? 0 : faces_[face - 1].end, size = faces_[face].end - begin;
  for (std::size_t k = 0; k < size; ++k) {
    const std::int64_t index = corners_[begin + k];
    if (index < 0 || index >= static_cast<std::int64_t>(vertices_.size()))
      throw Error(ErrorCode::invalid_parameters,
                  name_of_face(face) + " uses vertex " + std::to_string(index + first_vertex_) +
                      " (counted from " + std::to_string(first_vertex_) + "), but there are " +
                      std::to_string(vertices_.size()),
                  "/faces/" + std::to_string(face));
    corners[k] = static_cast<std::uint32_t>(index);
  }
  return size;
}

/// Whether all triangles of the fan look to the side to which the polygon does.
bool PolygonMesh::fan_fills(const Corners& corners, std::size_t size, std::size_t first) const {
  const auto at = [&](std::size_t k) {
    return vertices_[corners[(first + k) % size]] - vertices_[corners[first]];
  };
  Vec3 normal;
  for (std::size_t k = 1; k + 1 < size; ++k) normal = normal + cross(at(k), at(k + 1));
  for (std::size_t k = 1; k + 1 < size; ++k)
    if (!(dot(cross(at(k), at(k + 1)), normal) > 0)) return false;
  return true;
}

void PolygonMesh::cut(std::size_t face, const Corners& corners, std::size_t size, Triangles& out) const {
  std::size_t first = 0;
  while (first < size && !fan_fills(corners, size, first)) ++first;
  if (first == size)
    throw Error(ErrorCode::invalid_parameters,
                name_of_face(face) + " is a polygon of " + std::to_string(size) +
                    " corners from none of which it is a fan of triangles; cut it into triangles",
                "/faces/" + std::to_string(face));
  for (std::size_t k = 1; k + 1 < size; ++k)
    out.faces.push_back({corners[first], corners[(first + k) % size], corners[(first + k + 1) % size]});
}

Triangles PolygonMesh::triangles() && {
  Triangles out;
  check_limit(corners_.size() - 2 * faces_.size(), limits_.faces, "triangles");
  out.faces.reserve(corners_.size() - 2 * faces_.size());
  Corners corners;
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    const std::size_t size = read_corners(face, corners);
    // What is wrong with a triangle is for TriangleMesh to say.
    if (size == 3)
      out.faces.push_back({corners[0], corners[1], corners[2]});
    else
      cut(face, corners, size, out);
  }
  out.vertices = std::move(vertices_);
  return out;
}

}  // namespace wellspaced

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/domain/triangle_mesh.h"
#include "proto/formats/mesh.h"

namespace wellspaced {

/// Faces of any number of corners as a mesh file brings them, on their way to triangles.
class PolygonMesh {
 public:
  static constexpr std::size_t most_corners = 64;

  /// `what` the file is, what its places are counted in, and the number of its first vertex, for messages:
  /// "OFF file", "line", 0.
  PolygonMesh(const MeshLimits& limits, std::string what, std::string unit, std::int64_t first_vertex = 0)
      : limits_(limits), what_(std::move(what)), unit_(std::move(unit)), first_vertex_(first_vertex) {}

  /// So many are announced, and fit into the bytes that are there. Errors: too_large.
  void expect_vertices(std::uint64_t count);
  void expect_faces(std::uint64_t count);

  std::size_t vertices() const { return vertices_.size(); }
  std::size_t faces() const { return faces_.size(); }
  /// Errors: too_large.
  void add_vertex(Vec3 p);
  /// A corner of the next face: index of a vertex, from 0, that may still be to come.
  void add_corner(std::int64_t vertex) { corners_.push_back(vertex); }
  /// The corners since the last one are a face, of that line or byte of the file. Errors: too_large;
  /// malformed_request for fewer than 3 corners; invalid_parameters for more than 64.
  void close_face(std::size_t place);

  /// Errors: invalid_parameters: see read_mesh.
  Triangles triangles() &&;

 private:
  struct Face {
    std::size_t end, place;
  };
  using Corners = std::array<std::uint32_t, most_corners>;

  std::string name_of_face(std::size_t face) const;
  std::size_t read_corners(std::size_t face, Corners& corners) const;
  bool fan_fills(const Corners& corners, std::size_t size, std::size_t first) const;
  void cut(std::size_t face, const Corners& corners, std::size_t size, Triangles& out) const;

  MeshLimits limits_;
  std::string what_, unit_;
  std::int64_t first_vertex_;
  std::vector<Vec3> vertices_;
  std::vector<std::int64_t> corners_;
  std::vector<Face> faces_;
};

}  // namespace wellspaced

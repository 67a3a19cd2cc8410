#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/vec.h"

namespace wellspaced {

/// Triangles as files and requests bring them, before anything has looked at them.
struct Triangles {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< indices into `vertices`
};

/// What a mesh is, for people.
struct MeshFacts {
  std::size_t vertices = 0;  ///< that some face uses
  std::size_t unused_vertices = 0;
  std::size_t faces = 0, edges = 0;
  std::size_t components = 0;
  std::size_t boundaries = 0;  ///< closed loops of border edges
  int euler_characteristic = 0;
  std::size_t genus = 0;  ///< handles, of all components together
  bool closed = false;
  double area = 0;
  std::optional<double> volume;  ///< of closed meshes; negative where the faces look inward
};

/// A triangulated surface that geometry can rely on: an oriented manifold, with or without border.
///
/// Half-edge 3 f + k leads along face f from its corner k to the next one; the face is on its left. Vertices
/// that no face uses are kept, so that data a vertex stays in its place; nothing else looks at them. Several
/// components are taken, and counted in `facts`.
///
/// Guarantees: every edge has one face or two, which run through it in opposite directions; the faces at each
/// vertex are one fan; every face has an area beyond rounding; and, unless that was allowed, faces meet in
/// common edges and vertices only.
/// Errors of the constructor: invalid_parameters that name the culprits and the way out, at "/vertices/k" for
/// coordinates that are not finite or above 1e60, and for a vertex with several fans of faces; at "/faces/k"
/// for an index out of range or twice in a face, a face without area (lower than 1e-9 of its longest edge,
/// or than 1e-13 of its coordinates), a face that an earlier one repeats, an edge of three faces or more, two
/// neighbors of opposite orientation (nothing is turned over silently), and two faces that cross; at "/faces"
/// for no face at all or more than 2^30.
/// too_large at "/faces": see first_crossing.
/// Cost: O(n log n), about 2 us a face; the search for faces that cross is half of it.
/// Thread safety: immutable after construction.
class TriangleMesh {
 public:
  enum class Crossings { refuse, allow };
  static constexpr std::uint32_t none = ~0u;

  explicit TriangleMesh(Triangles triangles, Crossings crossings = Crossings::refuse);

  const std::vector<Vec3>& vertices() const { return triangles_.vertices; }
  const std::vector<std::array<std::uint32_t, 3>>& faces() const { return triangles_.faces; }
  std::size_t half_edges() const { return twins_.size(); }

  static std::uint32_t face_of(std::uint32_t h) { return h / 3; }
  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  /// The same edge in the other face; none at the border.
  std::uint32_t twin(std::uint32_t h) const { return twins_[h]; }
  std::uint32_t origin(std::uint32_t h) const { return triangles_.faces[h / 3][h % 3]; }
  std::uint32_t target(std::uint32_t h) const { return origin(next(h)); }
  /// A half-edge out of the vertex, from which `turn_left` goes through all others; at the border the border
  /// edge. none: no face uses it.
  std::uint32_t first_out(std::uint32_t vertex) const { return first_out_[vertex]; }
  /// The next half-edge out of the same vertex, counter-clockwise; none at the border.
  std::uint32_t turn_left(std::uint32_t h) const { return twins_[previous(h)]; }
  bool at_border(std::uint32_t vertex) const { return twins_[first_out_[vertex]] == none; }

  Vec3 corner(std::uint32_t face, int k) const {
    return triangles_.vertices[triangles_.faces[face][static_cast<std::size_t>(k)]];
  }
  /// Component of each face, numbered in the order of their first faces.
  const std::vector<std::uint32_t>& component_of_face() const { return component_of_face_; }
  /// Half-edges without twin, loop after loop, each as its faces lead through it.
  const std::vector<std::vector<std::uint32_t>>& borders() const { return borders_; }
  const MeshFacts& facts() const { return facts_; }
  /// As given to the constructor: whether faces that cross were looked for.
  Crossings crossings() const { return crossings_; }

 private:
  void find_twins();
  void find_fans();
  void find_components();
  void find_borders();
  void measure();

  Triangles triangles_;
  Crossings crossings_;
  std::vector<std::uint32_t> twins_, first_out_, component_of_face_;
  std::vector<std::vector<std::uint32_t>> borders_;
  MeshFacts facts_;
};

}  // namespace wellspaced

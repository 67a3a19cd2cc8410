#include "core/domain/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "core/domain/mesh_crossings.h"
#include "core/error.h"

namespace wellspaced {
namespace {

constexpr double largest_coordinate = 1e60;               ///< so that volumes and their squares are finite
constexpr double flattest = 1e-9;                         ///< height of a face over its longest edge
constexpr double coordinate_rounding = 1e-13;             ///< height of a face over its coordinates
constexpr std::size_t most_faces = std::size_t{1} << 30;  ///< so that half-edges fit 32 bits

[[noreturn]] void refuse_face(std::size_t face, const std::string& problem) {
  throw Error(ErrorCode::invalid_parameters, problem, "/faces/" + std::to_string(face));
}

[[noreturn]] void refuse_vertex(std::size_t vertex, const std::string& problem) {
  throw Error(ErrorCode::invalid_parameters, problem, "/vertices/" + std::to_string(vertex));
}

std::string numbers(std::span<const std::uint32_t> list) {
  constexpr std::size_t most = 6;
  std::string text;
  for (std::size_t k = 0; k < std::min(list.size(), most); ++k) {
    const bool last = k + 1 == list.size();
    text += (k == 0 ? "" : last ? " and " : ", ") + std::to_string(list[k]);
  }
  return list.size() > most ? text + " and others" : text;
}

void check_vertices(const Triangles& mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    for (const double c : {mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z}) {
      if (!std::isfinite(c))
        refuse_vertex(v, "vertex " + std::to_string(v) + " has a coordinate that is not a finite number");
      if (std::fabs(c) > largest_coordinate)
        refuse_vertex(v, "vertex " + std::to_string(v) + " has a coordinate beyond 1e60; scale the mesh");
    }
}

void check_indices(const Triangles& mesh, std::size_t face) {
  const auto& corners = mesh.faces[face];
  for (const std::uint32_t v : corners)
    if (v >= mesh.vertices.size())
      refuse_face(face, "face " + std::to_string(face) + " uses vertex " + std::to_string(v) +
                            ", but there are only " + std::to_string(mesh.vertices.size()) +
                            ", counted from 0");
  for (std::size_t k = 0; k < 3; ++k)
    if (corners[k] == corners[(k + 1) % 3])
      refuse_face(face, "face " + std::to_string(face) + " uses vertex " + std::to_string(corners[k]) +
                            " twice, so it is no triangle; remove it");
}

void check_area(const Triangles& mesh, std::size_t face) {
  const auto& [i, j, k] = mesh.faces[face];
  const Vec3 a = mesh.vertices[i], b = mesh.vertices[j], c = mesh.vertices[k];
  const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
  double largest = 0;
  for (const Vec3 p : {a, b, c})
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  const double height = norm(cross(b - a, c - a)) / longest;
  if (height > flattest * longest && height > coordinate_rounding * largest) return;
  refuse_face(
      face, "face " + std::to_string(face) + " (vertices " + numbers(mesh.faces[face]) +
                ") has no area, to rounding: it is lower than 1e-9 of its longest edge, or than 1e-13 of its "
                "coordinates; merge vertices that coincide and remove the face, or flip "
                "its longest edge");
}

/// One side of an edge, by the edge's ends.
struct Side {
  std::uint32_t low, high, half_edge;
  friend bool operator<(const Side& a, const Side& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
  }
  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

std::uint32_t third_vertex(const TriangleMesh& mesh, const Side& side) {
  return mesh.origin(TriangleMesh::previous(side.half_edge));
}

/// Which fault an edge has whose sides are not two that run in opposite directions.
[[noreturn]] void refuse_edge(std::span<const Side> sides) {
  const std::string edge =
      "the edge of vertices " + std::to_string(sides[0].low) + " and " + std::to_string(sides[0].high);
  std::vector<std::uint32_t> faces;
  for (const Side& side : sides) faces.push_back(TriangleMesh::face_of(side.half_edge));
  if (faces.size() > 2)
    refuse_face(faces[2], edge + " belongs to " + std::to_string(faces.size()) + " faces (" + numbers(faces) +
                              "), and a surface has at most two there; remove faces, or give each sheet "
                              "vertices of its own");
  refuse_face(faces[1], "faces " + numbers(faces) + " both run through " + edge +
                            " in the same direction, so one of them looks the other way; orient all faces "
                            "alike (in MeshLab: Re-Orient all faces coherently)");
}

void check_edge(const TriangleMesh& mesh, std::span<const Side> sides) {
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = 0; j < i && i < 8; ++j)
      if (third_vertex(mesh, sides[i]) == third_vertex(mesh, sides[j])) {
        const std::uint32_t face = TriangleMesh::face_of(sides[i].half_edge);
        refuse_face(face, "face " + std::to_string(face) + " has the same vertices as face " +
                              std::to_string(TriangleMesh::face_of(sides[j].half_edge)) + "; remove one");
      }
  const bool fits = sides.size() == 1 ||
                    (sides.size() == 2 && mesh.origin(sides[0].half_edge) != mesh.origin(sides[1].half_edge));
  if (!fits) refuse_edge(sides);
}

}  // namespace

TriangleMesh::TriangleMesh(Triangles triangles, Crossings crossings)
    : triangles_(std::move(triangles)), crossings_(crossings) {
  if (faces().empty() || faces().size() > most_faces)
    throw Error(ErrorCode::invalid_parameters,
                faces().empty() ? "the mesh has no faces; a surface needs at least one"
                                : "the mesh has more than 2^30 faces; simplify it",
                "/faces");
  check_vertices(triangles_);
  for (std::size_t f = 0; f < faces().size(); ++f) {
    check_indices(triangles_, f);
    check_area(triangles_, f);
  }
  find_twins();
  find_fans();
  if (crossings == Crossings::refuse) {
    if (const auto pair = first_crossing(triangles_))
      refuse_face((*pair)[1], "faces " + numbers(*pair) +
                                  " cross; mend the mesh, or set allow_self_intersections: distances then go "
                                  "as if the sheets didn't meet");
  }
  find_components();
  find_borders();
  measure();
}

void TriangleMesh::find_twins() {
  std::vector<Side> sides;
  sides.reserve(3 * faces().size());
  twins_.assign(3 * faces().size(), none);
  for (std::uint32_t h = 0; h < twins_.size(); ++h) {
    const std::uint32_t a = origin(h), b = target(h);
    sides.push_back({std::min(a, b), std::max(a, b), h});
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t begin = 0, end; begin < sides.size(); begin = end) {
    for (end = begin + 1; end < sides.size() && sides[end].same_edge(sides[begin]);) ++end;
    check_edge(*this, {&sides[begin], end - begin});
    ++facts_.edges;
    if (end - begin < 2) continue;
    twins_[sides[begin].half_edge] = sides[begin + 1].half_edge;
    twins_[sides[begin + 1].half_edge] = sides[begin].half_edge;
  }
}

void TriangleMesh::find_fans() {
  std::vector<std::uint32_t> corners(vertices().size(), 0);
  first_out_.assign(vertices().size(), none);
  for (std::uint32_t h = 0; h < twins_.size(); ++h) {
    ++corners[origin(h)];
    std::uint32_t& first = first_out_[origin(h)];
    if (first == none || (twins_[h] == none && twins_[first] != none)) first = h;
  }
  for (std::uint32_t h = 0; h < twins_.size(); ++h) {
    const std::uint32_t v = origin(h);
    if (first_out_[v] != h) continue;
    std::uint32_t turned = 0, last = h;
    for (std::uint32_t at = h; at != none && (turned == 0 || at != h); at = turn_left(at)) {
      ++turned;
      last = at;
    }
    if (turned == corners[v]) continue;
    // Any face outside the fan tells where the other one is.
    std::vector<bool> in_fan(faces().size(), false);
    for (std::uint32_t at = h; turned > 0; at = turn_left(at), --turned) in_fan[face_of(at)] = true;
    std::uint32_t other = 0;
    while (origin(other) != v || in_fan[face_of(other)]) ++other;
    refuse_vertex(v, "vertex " + std::to_string(v) + " joins fans of faces that share no edge there (faces " +
                         std::to_string(face_of(last)) + " and " + std::to_string(face_of(other)) +
                         " are in different ones); give each fan a vertex of its own");
  }
}

void TriangleMesh::find_components() {
  component_of_face_.assign(faces().size(), none);
  std::vector<std::uint32_t> open;
  for (std::uint32_t seed = 0; seed < faces().size(); ++seed) {
    if (component_of_face_[seed] != none) continue;
    const auto component = static_cast<std::uint32_t>(facts_.components++);
    component_of_face_[seed] = component;
    open.push_back(seed);
    while (!open.empty()) {
      const std::uint32_t face = open.back();
      open.pop_back();
      for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
        if (twins_[h] == none || component_of_face_[face_of(twins_[h])] != none) continue;
        component_of_face_[face_of(twins_[h])] = component;
        open.push_back(face_of(twins_[h]));
      }
    }
  }
}

void TriangleMesh::find_borders() {
  std::vector<bool> seen(twins_.size(), false);
  for (std::uint32_t h = 0; h < twins_.size(); ++h) {
    if (twins_[h] != none || seen[h]) continue;
    std::vector<std::uint32_t> loop;
    for (std::uint32_t at = h; !seen[at]; at = first_out_[target(at)]) {
      seen[at] = true;
      loop.push_back(at);
    }
    borders_.push_back(std::move(loop));
  }
}

void TriangleMesh::measure() {
  const auto used =
      std::count_if(first_out_.begin(), first_out_.end(), [](std::uint32_t h) { return h != none; });
  facts_.vertices = static_cast<std::size_t>(used);
  facts_.unused_vertices = vertices().size() - facts_.vertices;
  facts_.faces = faces().size();
  facts_.boundaries = borders_.size();
  facts_.closed = borders_.empty();
  const auto signed_of = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  const std::int64_t euler = signed_of(facts_.vertices) - signed_of(facts_.edges) + signed_of(facts_.faces);
  facts_.euler_characteristic = static_cast<int>(euler);
  facts_.genus =
      static_cast<std::size_t>(signed_of(facts_.components) - (signed_of(facts_.boundaries) + euler) / 2);
  // Relative to one of its vertices, so that a mesh far from the origin loses no digits.
  const Vec3 middle = corner(0, 0);
  double volume = 0;
  for (std::uint32_t f = 0; f < faces().size(); ++f) {
    const Vec3 a = corner(f, 0) - middle, b = corner(f, 1) - middle, c = corner(f, 2) - middle;
    facts_.area += 0.5 * norm(cross(b - a, c - a));
    volume += dot(a, cross(b, c)) / 6;
  }
  if (facts_.closed) facts_.volume = volume;
}

}  // namespace wellspaced

#include "core/domain/unfolding.h"

#include <algorithm>

#include "core/domain/barycentric.h"
#include "core/math.h"

namespace wellspaced {
namespace {

constexpr double flat = 1e-11;  ///< radians of a turn that rounding makes of nothing

}  // namespace

Unfolding::Unfolding(const TriangleMesh& mesh) : mesh_(&mesh) {
  const std::size_t half_edges = mesh.half_edges(), vertices = mesh.vertices().size();
  shapes_.resize(half_edges);
  angle_at_.resize(half_edges);
  angle_to_.resize(half_edges);
  angle_around_.assign(vertices, 0);
  bends_ways_.assign(vertices, false);
  for (std::uint32_t h = 0; h < half_edges; ++h) {
    const Vec3 a = mesh.vertices()[mesh.origin(h)];
    const Vec3 edge = mesh.vertices()[mesh.target(h)] - a;
    const Vec3 side = mesh.vertices()[mesh.origin(TriangleMesh::previous(h))] - a;
    const double along = dot(edge, side), across = norm(cross(edge, side));
    shapes_[h] = (1 / norm2(edge)) * Vec2{along, across};
    angle_at_[h] = portable_atan2(across, along);
  }
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const std::uint32_t first = mesh.first_out(v);
    if (first == TriangleMesh::none) continue;
    std::uint32_t h = first;
    do {
      angle_to_[h] = angle_around_[v];
      angle_around_[v] += angle_at_[h];
      h = mesh.turn_left(h);
    } while (h != TriangleMesh::none && h != first);
    bends_ways_[v] = angle_around_[v] > (mesh.at_border(v) ? pi : 2 * pi) + flat;
  }
}

double Unfolding::missing_angle(std::uint32_t vertex) const {
  const bool has_faces = mesh_->first_out(vertex) != TriangleMesh::none;
  return !has_faces || mesh_->at_border(vertex) ? 0 : std::max(0.0, 2 * pi - angle_around_[vertex]);
}

std::array<Vec2, 3> Unfolding::corners_around(const MeshPlace& origin) const {
  const double length = norm(mesh_->corner(origin.face, 1) - mesh_->corner(origin.face, 0));
  const Vec2 b{length, 0}, c = length * shapes_[3 * origin.face];
  const Vec2 at = origin.weights[1] * b + origin.weights[2] * c;
  return {Vec2{} - at, b - at, c - at};
}

Frame Unfolding::frame(std::uint32_t face) const {
  const Vec3 a = mesh_->corner(face, 0);
  const Vec3 edge = mesh_->corner(face, 1) - a, side = mesh_->corner(face, 2) - a;
  const Vec3 x = (1 / norm(edge)) * edge;
  const Vec3 normal = cross(edge, side);
  return {x, cross((1 / norm(normal)) * normal, x)};
}

Vec3 Unfolding::position(const MeshPlace& place) const {
  const auto& [a, b, c] = place.weights;
  return a * mesh_->corner(place.face, 0) + b * mesh_->corner(place.face, 1) +
         c * mesh_->corner(place.face, 2);
}

std::array<double, 3> Unfolding::weights(const std::array<Vec2, 3>& corners, Vec2 p) const {
  std::array<double, 3> w = Barycentric<Vec2>(corners)(p);
  for (double& weight : w) weight = std::max(0.0, weight);
  const double sum = w[0] + w[1] + w[2];
  for (double& weight : w) weight /= sum;
  return w;
}

}  // namespace wellspaced

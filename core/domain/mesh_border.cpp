#include "core/domain/mesh_border.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/domain/straight_way.h"
#include "core/math.h"

namespace wellspaced {
namespace {

constexpr double sharpest_turn = pi / 4;  ///< sharper ones are corners
constexpr double most = 0.75;             ///< of the way to a corner in one move

}  // namespace

MeshBorder::MeshBorder(const Unfolding& unfolding, double tolerance)
    : unfolding_(&unfolding), mesh_(&unfolding.mesh()), tolerance_(tolerance) {
  for (const auto& loop : mesh_->borders()) cut(loop);
  if (!curves_.empty()) measure_distances();
}

double MeshBorder::length_of(std::uint32_t h) const {
  return norm(mesh_->vertices()[mesh_->target(h)] - mesh_->vertices()[mesh_->origin(h)]);
}

bool MeshBorder::is_corner(std::uint32_t vertex) const {
  return std::fabs(unfolding_->angle_around(vertex) - pi) > sharpest_turn;
}

void MeshBorder::cut(const std::vector<std::uint32_t>& loop) {
  std::size_t first = 0;
  while (first < loop.size() && !is_corner(mesh_->origin(loop[first]))) ++first;
  if (first == loop.size()) {
    add(loop, true);
    return;
  }
  std::vector<std::uint32_t> half_edges;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::uint32_t h = loop[(first + k) % loop.size()];
    half_edges.push_back(h);
    if (is_corner(mesh_->target(h))) add(std::exchange(half_edges, {}), false);
  }
}

void MeshBorder::add(std::vector<std::uint32_t> half_edges, bool closed) {
  Curve curve{std::move(half_edges), {0}};
  for (std::uint32_t k = 0; k < curve.half_edges.size(); ++k) {
    position_of_[curve.half_edges[k]] = {static_cast<std::uint32_t>(lines_.size()), k};
    curve.starts.push_back(curve.starts.back() + length_of(curve.half_edges[k]));
  }
  curves_.push_back({curve.starts.back(), closed});
  length_ += curve.starts.back();
  lines_.push_back(std::move(curve));
}

void MeshBorder::measure_distances() {
  std::vector<std::array<Vec3, 3>> edges;
  for (const auto& loop : mesh_->borders())
    for (const std::uint32_t h : loop) {
      const Vec3 end = mesh_->vertices()[mesh_->target(h)];
      edges.push_back({mesh_->vertices()[mesh_->origin(h)], end, end});
    }
  tree_ = std::make_unique<FaceTree>(edges);
  for (const Vec3 p : mesh_->vertices()) vertex_distance_.push_back(std::sqrt(tree_->nearest(p).distance2));
}

Vec3 MeshBorder::point(std::size_t curve, double along) const {
  const Curve& line = lines_[curve];
  const double length = curves_[curve].length;
  if (curves_[curve].closed) {
    along = std::fmod(along, length);  // exact
    if (along < 0) along = std::min(along + length, std::nextafter(length, 0));
  } else {
    if (along <= 0) return mesh_->vertices()[mesh_->origin(line.half_edges.front())];
    if (along >= length) return mesh_->vertices()[mesh_->target(line.half_edges.back())];
    const double margin = std::min(4 * tolerance_, length / 4);
    along = std::clamp(along, margin, length - margin);
  }
  const auto after = std::upper_bound(line.starts.begin() + 1, line.starts.end() - 1, along);
  const auto k = static_cast<std::size_t>(after - line.starts.begin()) - 1;
  const std::uint32_t h = line.half_edges[k];
  const double t = std::min(1.0, (along - line.starts[k]) / (line.starts[k + 1] - line.starts[k]));
  return (1 - t) * mesh_->vertices()[mesh_->origin(h)] + t * mesh_->vertices()[mesh_->target(h)];
}

std::optional<MeshBorder::Spot> MeshBorder::spot(Vec3 p, std::uint32_t face) const {
  for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
    const std::uint32_t v = mesh_->origin(h);
    if (mesh_->at_border(v) && norm(p - mesh_->vertices()[v]) <= tolerance_)
      return Spot{mesh_->first_out(v), 0, is_corner(v)};
  }
  for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
    if (mesh_->twin(h) != TriangleMesh::none) continue;
    const Vec3 a = mesh_->vertices()[mesh_->origin(h)], edge = mesh_->vertices()[mesh_->target(h)] - a;
    const double length = norm(edge), along = dot(p - a, edge) / length;
    if (norm(p - a - (along / length) * edge) <= tolerance_)
      return Spot{h, std::clamp(along, 0.0, length), false};
  }
  return {};
}

/// The half-edge out of a border vertex in whose face the middle between its border edges is.
std::uint32_t MeshBorder::middle_of_fan(std::uint32_t vertex) const {
  const double middle = unfolding_->angle_around(vertex) / 2;
  std::uint32_t h = mesh_->first_out(vertex);
  while (unfolding_->angle_to(h) + unfolding_->angle_at(h) < middle) h = mesh_->turn_left(h);
  return h;
}

MeshPlace MeshBorder::place(const Spot& spot) const {
  const bool at_vertex = spot.along == 0;
  const std::uint32_t h = at_vertex ? middle_of_fan(mesh_->origin(spot.half_edge)) : spot.half_edge;
  const double t = at_vertex ? 0 : std::min(1.0, spot.along / length_of(h));
  MeshPlace place{TriangleMesh::face_of(h), {}};
  place.weights[h % 3] = 1 - t;
  place.weights[TriangleMesh::next(h) % 3] = t;
  return place;
}

Vec2 MeshBorder::tangent(const Spot& spot) const {
  const bool at_vertex = spot.along == 0;
  const std::uint32_t vertex = mesh_->origin(spot.half_edge);
  const std::uint32_t h = at_vertex ? middle_of_fan(vertex) : spot.half_edge;
  const auto corners = unfolding_->corners_around({TriangleMesh::face_of(h), {1, 0, 0}});
  const Vec2 edge = corners[TriangleMesh::next(h) % 3] - corners[h % 3];
  const Vec2 unit = (1 / norm(edge)) * edge;
  if (!at_vertex) return unit;
  // The middle of the fan, turned right by a quarter: towards the edge that leads on.
  const double angle = unfolding_->angle_around(vertex) / 2 - unfolding_->angle_to(h) - pi / 2;
  const CosSin turn = portable_cos_sin(angle / (2 * pi));
  return {unit.x * turn.cos - unit.y * turn.sin, unit.x * turn.sin + unit.y * turn.cos};
}

BoundarySpot MeshBorder::on_curve(const Spot& spot) const {
  const auto [curve, index] = position_of_.at(spot.half_edge);
  return {curve, lines_[curve].starts[index] + spot.along};
}

double MeshBorder::possible(const Spot& spot, double s) const {
  const auto [curve, index] = position_of_.at(spot.half_edge);
  const double at = lines_[curve].starts[index] + spot.along, length = curves_[curve].length;
  if (curves_[curve].closed) return std::clamp(s, -most * length / 2, most * length / 2);
  return std::clamp(s, -most * at, most * (length - at));
}

Vec3 MeshBorder::step(const Spot& spot, double s) const {
  const auto [curve, index] = position_of_.at(spot.half_edge);
  const double at = lines_[curve].starts[index] + spot.along, length = curves_[curve].length;
  if (curves_[curve].closed) return point(curve, at + s);
  return point(curve, std::clamp(at + s, std::nextafter(0.0, 1.0), std::nextafter(length, 0.0)));
}

bool MeshBorder::may_be_near(const MeshPlace& place, Vec3 p, double reach) const {
  if (curves_.empty()) return false;
  for (int k = 0; k < 3; ++k) {
    const double known = vertex_distance_[mesh_->faces()[place.face][static_cast<std::size_t>(k)]];
    if (known - norm(p - mesh_->corner(place.face, k)) > reach) return false;
  }
  return tree_->find(p, reach).has_value();
}

}  // namespace wellspaced

#include "core/domain/smallest_feature.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wellspaced {
namespace {

constexpr double sharp_cosine = 0.5;  ///< of 60 degrees
constexpr double flat = 1e-9;         ///< of the diagonal: what rounding bends
constexpr double not_itself = 1e-9;   ///< of the diagonal: how near a vertex its own faces are hit

Vec3 unit(Vec3 v) { return (1 / norm(v)) * v; }

class FeatureSearch {
 public:
  FeatureSearch(const TriangleMesh& mesh, const FaceTree& tree) : mesh_(mesh), tree_(tree) {
    for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
      const Vec3 a = mesh.corner(f, 0);
      normals_.push_back(unit(cross(mesh.corner(f, 1) - a, mesh.corner(f, 2) - a)));
    }
    Vec3 low = mesh.corner(0, 0), high = low;
    for (std::uint32_t v = 0; v < mesh.vertices().size(); ++v) {
      if (mesh.first_out(v) == TriangleMesh::none) continue;
      const Vec3 p = mesh.vertices()[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    diagonal_ = norm(high - low);
    smallest_ = {diagonal_, "the diagonal of the box around it"};
  }

  SmallestFeature find() {
    for (std::uint32_t v = 0; v < mesh_.vertices().size(); ++v)
      if (mesh_.first_out(v) != TriangleMesh::none) look_at_vertex(v);
    for (const auto& border : mesh_.borders()) look_at_border(border);
    return smallest_;
  }

 private:
  void offer(double length, const std::string& what, std::uint32_t vertex) {
    if (length < smallest_.length) smallest_ = {length, what + " at vertex " + std::to_string(vertex)};
  }

  template <class Use>
  void for_each_out(std::uint32_t v, const Use& use) const {
    const std::uint32_t first = mesh_.first_out(v);
    std::uint32_t h = first;
    do {
      use(h);
      h = mesh_.turn_left(h);
    } while (h != TriangleMesh::none && h != first);
  }

  void look_at_vertex(std::uint32_t v) {
    const Vec3 p = mesh_.vertices()[v];
    Vec3 normal;
    bool sharp = false;
    for_each_out(v, [&](std::uint32_t h) {
      const Vec3 here = normals_[TriangleMesh::face_of(h)];
      const Vec3 ahead = mesh_.vertices()[mesh_.target(h)] - p;
      const Vec3 side = mesh_.vertices()[mesh_.origin(TriangleMesh::previous(h))] - p;
      normal =
          normal + (1 / (norm2(ahead) * norm2(side))) * cross(ahead, side);  // Max 1999: exact on spheres
      if (mesh_.twin(h) != TriangleMesh::none)
        sharp = sharp || dot(here, normals_[TriangleMesh::face_of(mesh_.twin(h))]) < sharp_cosine;
    });
    if (norm(normal) == 0) return;
    normal = unit(normal);
    if (!sharp && !mesh_.at_border(v)) look_at_curvature(v, normal);
    for (const Vec3 direction : {normal, -1.0 * normal}) {
      const double most = std::min(diagonal_, 2 * smallest_.length);
      if (const auto hit = tree_.hit(p, direction, not_itself * diagonal_, most))
        offer(hit->distance / 2, "half the distance to face " + std::to_string(hit->face), v);
    }
  }

  void look_at_curvature(std::uint32_t v, Vec3 normal) {
    for_each_out(v, [&](std::uint32_t h) {
      const Vec3 edge = mesh_.vertices()[mesh_.target(h)] - mesh_.vertices()[v];
      const double bend = std::fabs(dot(edge, normal));
      // A circle through both ends, tangent at this one.
      if (bend > flat * diagonal_) offer(norm2(edge) / (2 * bend), "the radius of curvature", v);
    });
  }

  void look_at_border(const std::vector<std::uint32_t>& loop) {
    const Vec3 start = mesh_.vertices()[mesh_.origin(loop.front())];
    Vec3 low = start, high = start;
    for (const std::uint32_t h : loop) {
      const Vec3 p = mesh_.vertices()[mesh_.origin(h)];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    offer(std::max({high.x - low.x, high.y - low.y, high.z - low.z}),
          "the extent of the border of " + std::to_string(loop.size()) + " edges",
          mesh_.origin(loop.front()));
  }

  const TriangleMesh& mesh_;
  const FaceTree& tree_;
  std::vector<Vec3> normals_;
  double diagonal_ = 0;
  SmallestFeature smallest_;
};

}  // namespace

SmallestFeature smallest_feature(const TriangleMesh& mesh, const FaceTree& tree) {
  return FeatureSearch(mesh, tree).find();
}

}  // namespace wellspaced

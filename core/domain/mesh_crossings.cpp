#include "core/domain/mesh_crossings.h"

#include <algorithm>
#include <string>
#include <vector>

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include "core/error.h"

namespace wellspaced {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using FaceBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

constexpr std::uint64_t most_pairs_a_face = 60, most_pairs_at_all = 2'000'000;

/// Is told of each pair of faces whose boxes meet, in no order, and keeps the first that cross.
class Crossings {
 public:
  explicit Crossings(const Triangles& mesh) : mesh_(mesh) {}

  void operator()(const FaceBox& a, const FaceBox& b) {
    if (++tested_ > most_pairs_at_all && tested_ > most_pairs_a_face * mesh_.faces.size())
      throw Error(
          ErrorCode::too_large,
          "too many faces are so long, or in fans so wide, that most are in the others' boxes, to look for "
          "pairs that cross; remesh the surface, or set allow_self_intersections",
          "/faces");
    const std::array<std::uint32_t, 2> pair{std::min(a.info(), b.info()), std::max(a.info(), b.info())};
    if ((!first || pair < *first) && cross(mesh_.faces[pair[0]], mesh_.faces[pair[1]])) first = pair;
  }

  std::optional<std::array<std::uint32_t, 2>> first;

 private:
  using Face = std::array<std::uint32_t, 3>;

  Point at(std::uint32_t v) const { return {mesh_.vertices[v].x, mesh_.vertices[v].y, mesh_.vertices[v].z}; }
  Kernel::Triangle_3 triangle(const Face& f) const { return {at(f[0]), at(f[1]), at(f[2])}; }

  /// Turned so that the corners come first that the other face has too; how many these are.
  static std::size_t turn(Face& f, const Face& other) {
    const auto shared = [&](std::uint32_t v) {
      return std::find(other.begin(), other.end(), v) != other.end();
    };
    const auto count = static_cast<std::size_t>(std::count_if(f.begin(), f.end(), shared));
    while (count > 0 && count < 3 && !(shared(f[0]) && shared(f[count - 1])))
      std::rotate(f.begin(), f.begin() + 1, f.end());
    return count;
  }

  bool cross(Face f, Face g) const {
    const std::size_t shared = turn(f, g);
    turn(g, f);
    if (shared == 0) return CGAL::do_intersect(triangle(f), triangle(g));
    if (shared == 1)
      return CGAL::do_intersect(triangle(f), Kernel::Segment_3(at(g[1]), at(g[2]))) ||
             CGAL::do_intersect(triangle(g), Kernel::Segment_3(at(f[1]), at(f[2])));
    // Over a common edge one may only be folded onto the other.
    const Point a = at(f[0]), b = at(f[1]), c = at(f[2]), d = at(g[2]);
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }

  const Triangles& mesh_;
  std::uint64_t tested_ = 0;
};

}  // namespace

std::optional<std::array<std::uint32_t, 2>> first_crossing(const Triangles& mesh) {
  std::vector<FaceBox> boxes;
  boxes.reserve(mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    CGAL::Bbox_3 box;
    for (const std::uint32_t v : mesh.faces[f]) {
      const Vec3 p = mesh.vertices[v];
      box += CGAL::Bbox_3(p.x, p.y, p.z, p.x, p.y, p.z);
    }
    boxes.emplace_back(box, f);
  }
  Crossings crossings(mesh);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                [&](const FaceBox& a, const FaceBox& b) { crossings(a, b); });
  return crossings.first;
}

}  // namespace wellspaced

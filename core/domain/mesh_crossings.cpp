#include "core/domain/mesh_crossings.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

namespace wellspaced {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr int enough = 100000;  ///< pairs: some meshes have n^2 of them
struct Enough {};

/// Takes the pairs as CGAL finds them, in no order, and keeps the first of them all.
struct FirstPair {
  using iterator_category = std::output_iterator_tag;
  using value_type = void;
  using difference_type = std::ptrdiff_t;
  using pointer = void;
  using reference = void;

  FirstPair& operator*() { return *this; }
  FirstPair& operator++() { return *this; }
  FirstPair operator++(int) { return *this; }
  FirstPair& operator=(const std::pair<Surface::Face_index, Surface::Face_index>& found) {
    const std::uint32_t f = found.first, g = found.second;
    const std::array<std::uint32_t, 2> pair{std::min(f, g), std::max(f, g)};
    if (!*first || pair < **first) *first = pair;
    if (++*count == enough) throw Enough{};
    return *this;
  }

  std::optional<std::array<std::uint32_t, 2>>* first;
  int* count;
};

}  // namespace

std::optional<std::array<std::uint32_t, 2>> first_crossing(const Triangles& mesh) {
  Surface surface;
  for (const Vec3 p : mesh.vertices) surface.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : mesh.faces)
    surface.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c));
  std::optional<std::array<std::uint32_t, 2>> first;
  int count = 0;
  try {
    CGAL::Polygon_mesh_processing::self_intersections(surface, FirstPair{&first, &count});
  } catch (const Enough&) {
  }
  return first;
}

}  // namespace wellspaced

#pragma once

// What files that use CGAL's triangulations share.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include "core/control.h"
#include "core/vec.h"

namespace wellspaced {

using InexactKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Vertices know a number, faces whether they are inside.
using ConstrainedTriangulation = CGAL::Constrained_Delaunay_triangulation_2<
    InexactKernel,
    CGAL::Triangulation_data_structure_2<
        CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, InexactKernel>,
        CGAL::Triangulation_face_base_with_info_2<
            signed char, InexactKernel, CGAL::Constrained_triangulation_face_base_2<InexactKernel>>>,
    CGAL::No_constraint_intersection_tag>;

/// Inserts all places, near ones after each other, and gives their vertices in the order of the places; each
/// vertex gets its place's number as info. Errors: cancelled, deadline_exceeded.
template <class Triangulation>
std::vector<typename Triangulation::Vertex_handle> insert_places(Triangulation& triangulation,
                                                                 const std::vector<Vec2>& places,
                                                                 const Control& control) {
  using Site = std::pair<InexactKernel::Point_2, std::uint32_t>;
  constexpr std::size_t between_checks = 4096;
  std::vector<Site> sites;
  for (std::uint32_t k = 0; k < places.size(); ++k)
    sites.push_back({InexactKernel::Point_2(places[k].x, places[k].y), k});
  CGAL::spatial_sort(
      sites.begin(), sites.end(),
      CGAL::Spatial_sort_traits_adapter_2<InexactKernel, CGAL::First_of_pair_property_map<Site>>());
  std::vector<typename Triangulation::Vertex_handle> vertices(sites.size());
  typename Triangulation::Face_handle near;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    if (k % between_checks == 0) control.check();
    const auto vertex = triangulation.insert(sites[k].first, near);
    vertex->info() = sites[k].second;
    vertices[sites[k].second] = vertex;
    near = vertex->face();
  }
  return vertices;
}

constexpr signed char is_unknown = -1, is_outside = 0, is_inside = 1;

/// Sets each face's info to is_inside or is_outside: from the infinite face on, every constraint leads in or
/// out.
template <class Triangulation>
void tell_inside(Triangulation& triangulation) {
  for (const auto face : triangulation.all_face_handles()) face->info() = is_unknown;
  std::vector<typename Triangulation::Face_handle> open{triangulation.infinite_face()};
  open.back()->info() = is_outside;
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const auto next = face->neighbor(k);
      if (next->info() != is_unknown) continue;
      next->info() =
          face->is_constrained(k) ? static_cast<signed char>(is_inside - face->info()) : face->info();
      open.push_back(next);
    }
  }
}

}  // namespace wellspaced

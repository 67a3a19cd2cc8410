#include "core/mesh/meshing.h"
#include "core/registry.h"

namespace wellspaced {

std::span<const Mesher> meshers() {
  static const std::vector<Mesher> rows = [] {
    std::vector<Mesher> all;
    Mesher row;
    row.name = "delaunay";
    row.title = "Delaunay triangulation";
    row.description =
        "Triangles with the points as vertices and no point in a circumcircle. On bounded domains "
        "constrained: edges cover the boundary, and corners of the domain become vertices. On surfaces, of "
        "the surface's topology, or refused.";
    row.reference = "Shewchuk, Delaunay refinement algorithms for triangular mesh generation, 2002";
    row.run = delaunay_mesh;
    row.cost_a_point = {5e-6, 1000};
    row.cost_elsewhere = {2e-5, 1500};
    all.push_back(row);
    row = {};
    row.name = "voronoi";
    row.title = "Voronoi diagram";
    row.description =
        "For each point the polygon of all places nearest to it, clipped to the domain; where the domain "
        "isn't convex, a cell may have several parts.";
    row.reference =
        "Aurenhammer, Voronoi diagrams - a survey of a fundamental geometric data structure, 1991";
    row.run = voronoi_mesh;
    row.cost_a_point = {3e-6, 1000};
    row.cost_elsewhere = {4e-5, 2000};
    all.push_back(row);
    return all;
  }();
  return rows;
}

}  // namespace wellspaced

#pragma once

#include <vector>

#include "core/voronoi/star_mesh.h"
#include "core/voronoi/stars.h"

namespace wellspaced::testing {

/// The mesh's stars by the points' own numbers and in domain lengths, as the oracle wants them.
inline std::vector<std::vector<Spoke>> stars_of(const StarMesh& mesh) {
  std::vector<std::vector<Spoke>> stars(mesh.size());
  for (std::size_t i = 0; i < mesh.size(); ++i)
    for (int k = 0; k < mesh.star(i).degree; ++k) {
      const std::uint32_t j = mesh.star(i).neighbor[k];
      stars[mesh.original(i)].push_back({mesh.spacing() * mesh.offset(i, j), mesh.original(j)});
    }
  return stars;
}

/// The places themselves, also of points that did not move.
inline PointSet places(const StarMesh& mesh, const PointSet& input) {
  PointSet out = input;
  const Box box = input.domain->box();
  for (std::size_t i = 0; i < mesh.size(); ++i)
    out.set(mesh.original(i), {mesh.at(i).x * 0x1p-32 * box.size.x, mesh.at(i).y * 0x1p-32 * box.size.y, 0});
  return out;
}

}  // namespace wellspaced::testing

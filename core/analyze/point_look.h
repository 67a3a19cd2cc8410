#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/control.h"
#include "core/parallel.h"
#include "core/voronoi/domain_star.h"
#include "core/voronoi/moving_set.h"

namespace wellspaced {

/// What one point's clipped cell and star say, on any domain. Units: as said; else those of the point.
struct PointLook {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double nearest = infinity;  ///< distance to the nearest sample in domain lengths
  double outradius = 0;       ///< of its cell, in domain lengths
  double r_f = infinity,
         r_f_free = infinity;  ///< that distance in the smaller of both units; not of two corners
  double area = 0;             ///< of its cell
  double edge_max = 0;
  double cotangent_max = -infinity, cotangent_min = infinity;  ///< of all angles of its triangles
  double own_cotangent_max = -infinity;                        ///< of those at the point
  int valence = 0;
};

/// Requires: a finder of the set. The star is then that of i.
PointLook look_at_point(const MovingSet& set, std::size_t i, CellFinder& cells, DomainStar& star);

/// Calls use(i, look, star) for every point, on all threads. Errors: cancelled, deadline_exceeded, those of
/// the finder.
template <class Use>
void for_each_look(const MovingSet& set, const Control& control, const Use& use) {
  constexpr std::size_t block = 256;
  parallel_blocks(set.size(), block, control, [&](std::size_t begin, std::size_t end) {
    CellFinder cells = set.finder(control);
    DomainStar star;
    for (std::size_t i = begin; i < end; ++i) {
      if (i % 64 == 0) control.check();
      const PointLook look = look_at_point(set, i, cells, star);
      use(i, look, star);
    }
  });
}

}  // namespace wellspaced

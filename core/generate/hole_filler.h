#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/control.h"
#include "core/generate/disk_rule.h"
#include "core/point_set.h"
#include "core/voronoi/cell_finder.h"
#include "core/voronoi/corner_settler.h"
#include "core/voronoi/far_places.h"
#include "core/voronoi/neighbors.h"

namespace wellspaced {

/// Farthest-point insertion on any domain: the corners of all cells, deepest first. The depth of a place is
/// its distance to the nearest point, divided by what the rule's radii say of the two; where r(x) varies that
/// is the deepest place of a cell only about.
///
/// Corners on the boundary are filled with points that slide along it. Requires: at least one point; the grid
/// is that of the points; domain, rule and control outlive it.
/// Errors of all calls: cancelled, deadline_exceeded. Cost: 1.5 us a point at first, 10 us an insertion.
class HoleFiller {
 public:
  /// `Search::wide` where holes may be large: corners are then looked at that claim to be shallow by up to an
  /// eighth, as on curved surfaces they may be deeper than their cells say.
  enum class Search { narrow, wide };
  HoleFiller(PointSet& points, NeighborGrid& grid, const DiskRule& rule, Control& control,
             Search search = Search::narrow);

  /// Until no corner is deeper than rule.coverage (1 + 1e-9).
  void fill();
  /// Until there are `count` points. Returns the depth that was filled last.
  double fill_to(std::size_t count);

 private:
  struct Hole {
    double depth;
    Vec3 at;
  };
  struct ComesLater {
    bool operator()(const Hole& a, const Hole& b) const;
  };

  void collect(double deeper_than);
  void look(std::uint32_t i, double deeper_than);
  void look_at_corner(CornerSettler::Corner corner, bool is_outer, double r, double deeper_than);
  double depth_of(const Hole& hole);
  void look_at_places(double deeper_than);
  void look_at_place(Vec3 place, double depth);
  bool take_deepest(double deeper_than, Hole& deepest);
  void insert(const Hole& hole, double deeper_than);

  PointSet& points_;
  NeighborGrid& grid_;
  const DiskRule& rule_;
  Control& control_;
  double deepened_;  ///< how much deeper than it claims a corner may be
  double far_as_;    ///< reaches that far places are looked at within
  bool has_many_faces_, looks_at_cells_ = true;
  std::optional<FarPlaces> far_;
  std::vector<double> depths_;  ///< of the far places
  std::size_t seen_ = 0;        ///< points from which they were looked at
  CellFinder finder_;
  CornerSettler settler_;
  std::vector<Hole> heap_;
  std::vector<Neighbor> neighbors_;
};

}  // namespace wellspaced

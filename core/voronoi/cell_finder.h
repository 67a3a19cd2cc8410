#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/control.h"
#include "core/domain/domain.h"
#include "core/point_set.h"
#include "core/voronoi/candidate_star.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/corner_settler.h"
#include "core/voronoi/neighbors.h"

namespace wellspaced {

/// Answers the one local question of every optimizer: if sample i stood at step(x_i, u), what would its
/// Voronoi cell be?
///
/// Guarantees: distances are the domain's; on a bounded one, r_c is that of the part of the cell inside. The
/// cell is that of the candidate's own Delaunay neighbors, found again for each candidate:
/// samples are gathered until everything within twice the cell's outradius is in hand. Images of the
/// candidate itself move along with it. Radii are right to 1e-12 where samples are spread out; what was asked
/// before changes them by rounding only.
/// Cost: 250 ns to turn to a sample, then about 60 ns for radii and 300 ns for a cell. Thread safety: one
/// finder a thread; the grid is only read.
class CellFinder {
 public:
  /// `reach`: how far to look at first; about 2 times the spacing is cheapest. Requires: points and grid
  /// outlive it, as does the control, which is asked now and then in crowds. Errors of every other call:
  /// cancelled, deadline_exceeded.
  CellFinder(const PointSet& points, const NeighborGrid& grid, double reach, const Control& control);

  /// Turns to sample i at its present position; `reach` where more is known than in general.
  void load(std::uint32_t i) { load(i, first_reach_); }
  void load(std::uint32_t i, double reach);

  struct Radii {
    double r_f = 0;  ///< distance to the nearest other sample
    double r_c = 0;  ///< distance to the farthest point of the cell
  };
  Radii radii_at(Vec2 u);

  /// The cell itself, as if the domain went on all around; labels are indices into neighbors(). Valid until
  /// the next call.
  const Cell& cell_at(Vec2 u);
  /// What of the cell lies in the domain, as of cell_at, once each: convex parts, some of them empty, whose
  /// edges with negative labels are the domain's boundary or a seam, or lie between two parts; the cell where
  /// there are none.
  std::span<const Cell> parts() const {
    return clipped_ ? std::span<const Cell>(parts_) : std::span(&cell_, 1);
  }
  /// Of what parts() are together: farthest corner's distance in the chart, squared; integrals.
  double outradius2() const;
  PolygonMoments moments();
  /// Of all of the cell, past a sphere's horizon, too, to 1e-9 of it then.
  double area();
  /// Distance of the farthest place of the cell from the loaded sample where it is. Where the domain's
  /// charts are not exact, corners that say more than `at_least` are looked for on the domain itself.
  double outradius(double at_least = 0);
  /// The same of the corner number k of a part.
  double distance_of_corner(const Cell& part, std::size_t k);
  /// Samples around the loaded one, nearest first, as of cell_at.
  std::span<const Neighbor> neighbors() const { return neighbors_; }

 private:
  enum class StarUse { not_loaded, loaded, unsuitable };

  void gather(double reach);
  void leave_the_farthest();
  void sort_neighbors();
  void cut(Vec2 u);
  void find_cell(Vec2 u);
  void clip_to_domain(Vec2 u);
  void leave_out_seams(Vec2 u);
  void clip_to_side(const Seam& seam, double side, Vec2 u, Cell& half) const;
  bool is_complete(double moved) const;
  void load_star();
  std::optional<Radii> radii_by_star(Vec2 u);
  Radii radii_by_clipping(Vec2 u);
  double distance_of_farthest();
  double distance_beyond_horizon();
  double area_within(double reach, double side);

  const PointSet* points_;
  const NeighborGrid* grid_;
  const Control* control_;
  double first_reach_, reach_ = 0, farthest_reach_;
  std::size_t most_ = 0;  ///< neighbors
  std::uint32_t self_ = 0;
  Vec3 base_;
  std::vector<Neighbor> neighbors_;
  std::vector<HalfPlane> half_planes_;
  Cell cell_;
  ChartPieces pieces_;
  std::vector<Cell> parts_, halves_;
  std::vector<Seam> seams_;
  std::vector<Vec2> polygon_;
  bool clipped_ = false;
  CandidateStar star_;
  CornerSettler settler_;
  StarUse star_use_ = StarUse::not_loaded;
  bool is_flat_, has_boundary_, sorted_ = false, has_own_images_ = false;
};

}  // namespace wellspaced

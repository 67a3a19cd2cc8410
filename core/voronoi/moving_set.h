#pragma once

#include <cstdint>
#include <vector>

#include "core/control.h"
#include "core/parallel.h"
#include "core/point_set.h"
#include "core/voronoi/cell_finder.h"
#include "core/voronoi/marks.h"
#include "core/voronoi/mesh_radii.h"
#include "core/voronoi/neighbors.h"

namespace wellspaced {

/// A point set on any domain, with or without a sizing function, whose points an optimizer moves, and whose
/// cells it asks for. No triangulation is kept: each cell is cut anew from the neighbors that are found. What
/// StarMesh is for the torus.
///
/// Lengths inside are in units of the spacing that the triangular lattice would have there: d_hex, or with a
/// sizing function c r(x), taken at the sample, with the c that gives as many points. Two points are as far
/// apart as the smaller of their units says.
///
/// Errors of the constructor: those of require_usable; degenerate_input for points so clustered that their
/// neighborhoods can't be searched locally; cancelled, deadline_exceeded. Cost: O(n); 80 bytes a point.
/// Determinism: a function of the points alone. Thread safety: const calls from many threads.
class MovingSet {
 public:
  MovingSet(const PointSet& points, const Control& control);
  MovingSet(const MovingSet&) = delete;
  MovingSet& operator=(const MovingSet&) = delete;

  std::size_t size() const { return points_.size(); }
  const Domain& domain() const { return *points_.domain; }
  Vec3 operator[](std::size_t i) const { return points_[i]; }
  double spacing() const { return spacing_; }  ///< d_hex or c: the length of a unit where r(x) is 1
  double unit(std::size_t i) const { return units_[i]; }
  const Freedom& freedom(std::size_t i) const { return freedoms_[i]; }
  /// Neither of the two can be moved.
  bool both_fixed(std::size_t i, std::size_t j) const {
    return freedoms_[i].dimensions == 0 && freedoms_[j].dimensions == 0;
  }

  /// One that sees the points as they are whenever it is asked. Requires: the set and control outlive it.
  CellFinder finder(const Control& control) const { return {points_, grid_, 0, control}; }
  /// How far a finder best looks at first around point i.
  double reach(std::size_t i) const { return 2.0 * units_[i]; }
  /// Turns a finder to the cell of point i, where that is now.
  void find_cell(std::size_t i, CellFinder& cells) const {
    cells.load(static_cast<std::uint32_t>(i), reach(i));
    cells.cell_at({});
  }
  /// Calls use(i, cells) for every point, with its cell found, on all threads. Errors: cancelled,
  /// deadline_exceeded, what use throws.
  template <class Use>
  void for_each_cell(const Control& control, const Use& use) const {
    parallel_blocks(size(), cells_in_block, control, [&](std::size_t begin, std::size_t end) {
      CellFinder cells = finder(control);
      for (std::size_t i = begin; i < end; ++i) {
        if (i % 64 == 0) control.check();
        find_cell(i, cells);
        use(i, cells);
      }
    });
  }

  void move_to(std::size_t i, Vec3 to);
  /// Takes point i out, so that cells are those of the others, and puts it back where it now is.
  void take_out(std::size_t i) { grid_.take_out(static_cast<std::uint32_t>(i), points_[i]); }
  void put_back(std::size_t i, Vec3 to);
  /// The part of a move that point i is free to make, but for the boundary in front of it.
  Vec2 free_part(std::size_t i, Vec2 move) const;
  /// The ways to the points that share an edge of their cells with i, in units of i, once each. Requires: the
  /// finder is at i's cell.
  std::vector<Vec2> spokes(std::size_t i, const CellFinder& cells) const;

  void mark(std::size_t i) { marks_.set(i); }
  void mark_all() { marks_.set_all(); }
  bool any_marked() const { return marks_.count() != 0; }
  std::size_t marked() const { return marks_.count(); }
  std::size_t take_marked(std::size_t from, std::size_t end) { return marks_.take(from, end); }

  /// Of a cell, in the units of its point. With a sizing function mass is denser where points are: r(x)^-4
  /// times as dense, which leaves cells of as many units.
  struct CellIntegrals {
    double mass = 0;
    Vec2 to_centroid;
    double energy = 0;  ///< integral of mass times squared distance
  };
  /// Requires: the finder is at i's cell.
  CellIntegrals integrals(std::size_t i, CellFinder& cells) const;

  /// Radii of a set of n, block by block, so that many threads can gather them.
  class BlockRadii {
   public:
    explicit BlockRadii(std::size_t n) : blocks_((n + cells_in_block - 1) / cells_in_block, no_radii) {}
    MeshRadii& of(std::size_t i) { return blocks_[i / cells_in_block]; }
    MeshRadii total() const {
      MeshRadii all = no_radii;
      for (const MeshRadii& block : blocks_) all.include(block);
      return all;
    }

   private:
    std::vector<MeshRadii> blocks_;
  };
  /// Includes those of i's cell. Requires: the finder is at it, in for_each_cell.
  void include_radii(std::size_t i, CellFinder& cells, BlockRadii& blocks) const;

  /// Smallest distance of two points that are not both fixed, and largest distance in a cell, each in its
  /// units. Errors: cancelled, deadline_exceeded. Cost: about 0.8 us a point and thread.
  MeshRadii measure(const Control& control) const;

  /// Coordinates, to come back to.
  using Places = std::vector<double>;
  const Places& places() const { return points_.coordinates; }
  void put(const Places& places);
  using Snapshot = Places;
  Snapshot snapshot() const { return places(); }
  void restore(const Snapshot& snapshot) { put(snapshot); }

  /// There is no triangulation to be kept.
  std::size_t legalize_all(const Control&) { return 0; }

  const PointSet& points() const { return points_; }
  const PointSet& points(const PointSet&, const Control&) const { return points_; }  ///< as of a StarMesh

 private:
  static constexpr std::size_t cells_in_block = 256;

  void set_units(const Control& control);
  PolygonMoments weighted_moments(std::size_t i, CellFinder& cells) const;
  void renew(std::size_t i);

  PointSet points_;
  NeighborGrid grid_;
  double spacing_ = 0;
  std::vector<double> units_;
  std::vector<Freedom> freedoms_;
  Marks marks_;
};

}  // namespace wellspaced

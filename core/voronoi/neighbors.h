#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/domain/domain.h"
#include "core/point_set.h"

namespace wellspaced {

/// A uniform grid over a point set that answers "who is within this distance", periodic images included,
/// while points move and are added.
///
/// Guarantees: `gather` finds every image of every sample whose offset is at most `reach` long, whatever the
/// ratio of reach to period; ghost images are offsets, never rounded copies of coordinates. Cost: built in
/// O(n); gather in O(cells + points within reach). Thread safety: const calls from many threads; `move`
/// and `add` exclude everything else.
class NeighborGrid {
 public:
  /// Cells of about `cell` on a side. Requires: points are in their domain; cell > 0; points outlives the
  /// grid.
  NeighborGrid(const PointSet& points, double cell) : NeighborGrid(points, cell, points.size()) {}
  /// The same for as many points as will have been added in the end, about.
  NeighborGrid(const PointSet& points, double cell, std::size_t expected);

  /// Appends all images within `reach` of `base`, but not sample `self` itself (its images count: they bound
  /// its cell).
  void gather(Vec3 base, std::uint32_t self, double reach, std::vector<Neighbor>& out) const;

  /// Tells the grid that sample i, last known at `from`, is now at `to`.
  void move(std::uint32_t i, Vec3 from, Vec3 to);

  /// Tells the grid of sample i, the next one after those it knows, just appended to the points.
  void add(std::uint32_t i);

  /// Tells the grid that sample i, at `at`, is not to be found any more, or again.
  void take_out(std::uint32_t i, Vec3 at);
  void put_back(std::uint32_t i, Vec3 at);

  /// Number of samples in the fullest cell.
  std::size_t fullest_cell() const;
  /// Number of cells that hold nothing.
  std::size_t empty_cells() const;

 private:
  static constexpr std::uint32_t none = ~0u;
  struct Axis {
    double low = 0, size = 0, per_length = 0;  // per_length: cells a unit of length
    std::int64_t cells = 1;
    bool periodic = false;
  };
  struct Window;

  std::size_t cell_of(Vec3 p) const;
  void gather_cell(std::size_t cell, const Window& window, Vec3 shift, std::vector<Neighbor>& out) const;

  const PointSet* points_;
  bool has_hints_;
  std::array<Axis, 3> axes_;
  std::vector<std::uint32_t> first_, next_;
  std::vector<std::uint32_t> hints_;  ///< of each sample, where the domain has them
};

}  // namespace wellspaced

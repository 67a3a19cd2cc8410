#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/point_set.h"

namespace wellspaced {

/// The parts of a surface's border between points that follow each other along it.
class BorderSides {
 public:
  struct Side {
    Vec3 from, to;
    bool is_straight = true;  ///< else it is a part of a curve, from `begin` to `end` along it
    std::size_t curve = 0;
    double begin = 0, end = 0, length = 0;
  };

  /// Requires: the points outlive it.
  explicit BorderSides(const PointSet& points);

  /// From p to q; a straight line where they don't follow each other.
  Side between(std::uint32_t p, std::uint32_t q) const;
  /// That part of the way along it, from 0 to 1.
  Vec3 place(const Side& side, double part) const;
  /// The part of the way where it is as far to a as to b. Requires: b is nearer to its beginning, a to its
  /// end. Cost: a few searches for shortest ways.
  double meeting(const Side& side, std::uint32_t a, std::uint32_t b) const;

 private:
  const PointSet* points_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Side> sides_;
};

/// From a place of the domain to some of the points.
std::vector<double> distances_from(Vec3 place, const PointSet& points, std::span<const std::uint32_t> ids);

}  // namespace wellspaced

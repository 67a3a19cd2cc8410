#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/point_set.h"

namespace wellspaced {

/// Where the points of a planar set are for a triangulation: on a strip with an image one period away on
/// either side, which is enough: circles that hold no images reach half a period along the strip.
///
/// On a strip, coordinates along it are rounded to multiples of 2^-49 of the period or so, which makes
/// translations by the period exact: what is a tie in one place is the same tie in all.
struct PlanarSites {
  explicit PlanarSites(const PointSet& points);

  /// Adds a place that is no point, with its images.
  void add_place(Vec2 at);

  std::vector<Vec2> at;               ///< the points, then images
  std::vector<std::uint32_t> number;  ///< of the point, or past the last one of the place, that it is
  std::vector<int> turn;              ///< periods from there
  std::size_t axis = 0;               ///< along which it is periodic
  double period = 0;                  ///< 0: it isn't
  std::uint32_t places = 0;           ///< points and others

 private:
  void add(Vec2 at, std::uint32_t number, int turn);
};

}  // namespace wellspaced

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/control.h"
#include "core/domain/domain.h"
#include "core/point_set.h"

namespace wellspaced {

/// Places that lie all over a curved domain: corners of its triangles, halved until they are many. From those
/// that are farthest from all points it is not far to the corners of cells; what charts get wrong where few
/// points share a domain is found that way.
class FarPlaces {
 public:
  /// At least about so many places: as many as there are corners, or more. Cost: O(places).
  FarPlaces(const Domain& domain, std::size_t at_least);

  std::span<const Vec3> places() const { return places_; }
  /// Two places with less between them may lie around one corner of a cell.
  double gap() const { return gap_; }

  /// Calls see(k, distance) with the way from p to each place within reach. Cost: one search as far as that.
  template <class See>
  void see_from(Vec3 p, double reach, const See& see) {
    neighbors_.clear();
    seen_.clear();
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Vec3 offset = places_[k] - p;
      if (!(norm(offset) <= reach)) continue;
      neighbors_.push_back({offset, 0});
      seen_.push_back(k);
    }
    domain_.distances(p, reach, neighbors_, distances_);
    for (std::size_t k = 0; k < seen_.size(); ++k) see(seen_[k], distances_[k]);
  }

  /// The deepest places, two dozen at most, each the deepest around it; the deepest of all first.
  std::vector<std::size_t> summits(std::span<const double> depths) const;

 private:
  const Domain& domain_;
  std::vector<Vec3> places_;
  double gap_ = 0;
  std::vector<Neighbor> neighbors_;
  std::vector<std::size_t> seen_;
  std::vector<double> distances_;
};

}  // namespace wellspaced

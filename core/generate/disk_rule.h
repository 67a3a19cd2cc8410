#pragma once

#include "core/domain/domain.h"
#include "core/domain/sizing.h"

namespace wellspaced {

/// Whose radius counts when two points want different ones. Reference: Mitchell, Rand, Ebeida, Bajaj,
/// "Variable Radii Poisson Disk Sampling", 2012.
enum class Criterion {
  smaller,  ///< the smaller one: no disk holds a center whose own disk holds its center
  bigger,   ///< the bigger one
  prior,    ///< that of the point that was there first
  current   ///< that of the one that comes later
};

/// When a point has no room, and when a place is covered. r(x) = scale times what the sizing function says,
/// or scale alone without one.
struct DiskRule {
  double scale = 1;
  const Sizing* sizing = nullptr;
  Criterion criterion = Criterion::smaller;
  double coverage = 1;  ///< a place is covered that is nearer than so many radii to a point

  double radius(Vec3 p) const { return sizing == nullptr ? scale : scale * sizing->at(p); }
  double least() const { return sizing == nullptr ? scale : scale * sizing->least(); }
  double most() const { return sizing == nullptr ? scale : scale * sizing->most(); }
  /// No radius within `distance` of p is below this.
  double least_near(Vec3 p, double distance) const {
    return sizing == nullptr ? scale : scale * sizing->least_near(p, distance);
  }
  double lipschitz() const { return sizing == nullptr ? 0 : scale * sizing->lipschitz(); }

  /// Of a point that comes later than one whose radius is `earlier`.
  double distance(double later, double earlier) const {
    switch (criterion) {
      case Criterion::bigger:
        return later > earlier ? later : earlier;
      case Criterion::prior:
        return earlier;
      case Criterion::current:
        return later;
      case Criterion::smaller:
        break;
    }
    return later < earlier ? later : earlier;
  }

  /// How far from a place with radius r others may matter, in its coverage at most.
  double reach(double r) const {
    if (criterion == Criterion::smaller || criterion == Criterion::current) return coverage * r;
    const double slope = lipschitz() * coverage;
    return coverage * (slope < 1 ? std::min(most(), r / (1 - slope)) : most());
  }
};

}  // namespace wellspaced

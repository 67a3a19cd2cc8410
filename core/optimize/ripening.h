#pragma once

#include "core/optimize/push_pull_sweep.h"

namespace wellspaced {

/// When and how to ripen a set that can't satisfy its targets: by sweeps at targets next to the triangular
/// lattice's, which it can't satisfy either. They never come to rest, and weights near 1 keep that motion
/// slow: points with other than six neighbors meet and vanish, grain boundaries straighten, and fewer places
/// are left that stand in a lower beta's way. Randomness is what it costs.
///
/// The first portions are short and gentle; as long as targets still fail after them they become longer, and
/// stronger from the tenth on. A pure schedule: it knows no mesh.
class Ripening {
 public:
  struct Portion {
    PushPull targets;
    double visits;  ///< a point
  };

  /// The portion to go on with after targets have failed.
  Portion next();

  /// After targets have been satisfied: short portions again.
  void restart() { since_success_ = 0; }

  /// Visits a point after which targets have failed: many for a set that hasn't ripened, which creeps to
  /// them; few for one that has, since it satisfies them at once or not at all.
  double patience() const { return began_ ? 60 : 500; }

 private:
  bool began_ = false;
  int since_success_ = 0;  // portions
};

}  // namespace wellspaced

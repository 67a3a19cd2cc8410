#include "core/optimize/ripening.h"

#include <algorithm>

#include "core/optimize/opt_beta_targets.h"

namespace wellspaced {

Ripening::Portion Ripening::next() {
  constexpr int gentle_portions = 9;
  constexpr double first = 20, growth = 1.2, longest = 1200;  // visits a point
  double visits = first;
  for (int k = 0; k < since_success_ && visits < longest; ++k) visits *= growth;
  PushPull targets =
      since_success_ < gentle_portions ? opt_beta_targets(.62, .9, 1.2) : opt_beta_targets(.60, 1.0, .9);
  targets.look_across = true;
  began_ = true;
  ++since_success_;
  return {targets, std::min(visits, longest)};
}

}  // namespace wellspaced

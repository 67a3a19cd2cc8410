#include "core/analyze/discrepancy.h"

#include <algorithm>
#include <cmath>

#include "core/analyze/l2_discrepancy.h"
#include "core/analyze/ranked_points.h"
#include "core/analyze/star_discrepancy.h"
#include "core/error.h"
#include "core/parallel.h"

namespace wellspaced {

Discrepancy discrepancy(const PointSet& points, const Control& control) {
  if (points.size() == 0) throw Error(ErrorCode::degenerate_input, "no points have no discrepancy");
  const RankedPoints ranked = rank_points(points, control);
  double open = 0, closed = 0;
  L2Discrepancies l2;
  parallel_blocks(3, 1, control, [&](std::size_t task, std::size_t) {
    if (task == 0) l2 = l2_discrepancies(ranked, control);
    if (task == 1) open = star_discrepancy(ranked, BoxSides::open, control);
    if (task == 2) closed = star_discrepancy(ranked, BoxSides::closed, control);
  });
  return {std::max(open, closed), std::sqrt(l2.star2), std::sqrt(l2.periodic2)};
}

}  // namespace wellspaced

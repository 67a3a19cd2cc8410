#pragma once

#include <string>

#include "core/domain/domain.h"

namespace wellspaced {

/// Refuses points whose distance, at least `radius` everywhere, is larger than the smallest feature of a
/// polygon or mesh: they can't follow it.
///
/// Errors: infeasible at `where`, naming the feature and its size. Cost: that of smallest_feature, once a
/// domain.
void require_no_smaller_feature(const Domain& domain, double radius, const std::string& where);

}  // namespace wellspaced

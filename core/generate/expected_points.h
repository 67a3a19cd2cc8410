#pragma once

#include "core/domain/domain.h"
#include "core/generate/disk_rule.h"

namespace wellspaced {

/// About how many points a disk rule of any scale gives that covers each place once.
///
/// n = C integral of r^-2 over the domain, and D of r^-1 over the boundary, which has half a cell inside.
struct CountFormula {
  double inside = 0, rim = 0;

  CountFormula(const Domain& domain, const Sizing* sizing);

  double count(double scale) const;
  double scale(double count) const;
};

/// How many points the rule will give, about; at least 16.
double expected_points(const Domain& domain, const DiskRule& rule);

/// The scale of the rule that gives about so many.
double scale_for_count(const Domain& domain, const DiskRule& rule, double count);

}  // namespace wellspaced

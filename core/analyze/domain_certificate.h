#pragma once

#include <optional>

#include "core/analyze/certificate.h"

namespace wellspaced {

/// Whether bounds can be proven: on planar domains and spheres, without a sizing function. Surface meshes are
/// measured only.
bool can_be_certified(const PointSet& points);

/// certify on bounded planar domains and spheres. No cells are used:
///
/// 1. r_c: the domain's triangles are halved until each is within one disk of a radius around some sample;
/// the radius is tried a little above what was measured. What rounding may hide, of corners and of distances,
/// is added to it.
/// 2. r_f: all pairs that are near enough, but those of two corners of the domain; distances rounded down.
///
/// Guarantees: as of certify; the bounds are those of measure_spacing to 1e-9 relative. Nothing if none of
/// the radii that are tried, up to 1e-6 above what was measured, could be proven. Errors: cancelled,
/// deadline_exceeded. Cost: O(n), about 10 us a point.
std::optional<Certificate> certify_domain(const PointSet& points, const Control& control);

}  // namespace wellspaced

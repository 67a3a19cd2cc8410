#pragma once

#include <cstddef>
#include <cstdint>

#include "core/point_set.h"

namespace wellspaced::bench {

/// Maximal Poisson-disk points on the unit torus; made once a process.
const PointSet& mps(std::uint64_t count, std::uint64_t seed = 1);

/// The process's peak memory since the last call of `forget_peak`, in MiB; 0 where /proc can't tell.
double peak_mib();
void forget_peak();

}  // namespace wellspaced::bench

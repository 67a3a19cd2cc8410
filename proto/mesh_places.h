#pragma once

#include <string>

#include "core/point_set.h"

namespace wellspaced {

/// Where points of a surface mesh are on it, as members of a JSON object: ',"face":[f, ...]', numbers of
/// faces counted from 0, and ',"barycentric":[[a, b, c], ...]', the weights of their corners. Requires: the
/// domain is a mesh.
std::string place_members(const PointSet& points);

}  // namespace wellspaced

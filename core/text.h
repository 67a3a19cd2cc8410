#pragma once

#include <string>

#include "core/vec.h"

namespace wellspaced {

/// To three significant digits, for messages: "0.0314", "1.73e-09".
std::string short_number(double x);
/// "(0.5, 1, -0.333)"
std::string short_text(Vec3 p);

}  // namespace wellspaced

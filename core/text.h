#pragma once

#include <string>

namespace wellspaced {

/// To three significant digits, for messages: "0.0314", "1.73e-09".
std::string short_number(double x);

}  // namespace wellspaced

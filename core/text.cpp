#include "core/text.h"

#include <charconv>

namespace wellspaced {

std::string short_number(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x, std::chars_format::general, 3).ptr};
}

std::string short_text(Vec3 p) {
  return "(" + short_number(p.x) + ", " + short_number(p.y) + ", " + short_number(p.z) + ")";
}

}  // namespace wellspaced

#pragma once

#include <span>

#include "proto/picture.h"

namespace wellspaced {

/// Before the work: that a PNG of these groups has not too many pixels. Errors: too_large with what would do,
/// at /picture/scale or /picture/size_px, whichever makes it too large; at /picture if only both together or
/// the number of panels can be blamed.
void require_pixels(const PictureCall& call, std::span<const SetsSize> groups);

}  // namespace wellspaced

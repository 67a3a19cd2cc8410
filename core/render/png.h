#pragma once

#include <string>

#include "core/control.h"
#include "core/render/canvas.h"

namespace wellspaced {

/// The image as PNG: eight bits a channel, as gray where all of it is. `pixels_per_inch` says how large it is
/// meant to be; 0: nothing said. Errors: internal if libpng fails; cancelled, deadline_exceeded. Determinism:
/// the same bytes with the same version of zlib.
std::string write_png(const Image& image, double pixels_per_inch, const Control& control);

}  // namespace wellspaced

#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace wellspaced {

/// Brightness of each pixel in [0, 1], from the top row down.
struct GrayImage {
  std::size_t columns = 0, rows = 0;
  std::vector<double> brightness;
};

/// Reads a PNG of any kind: colors become gray (their sRGB luminance, as libpng has it), eight bits deep;
/// what is transparent shows white. Errors: malformed_request for bytes that are no PNG or end early;
/// payload_too_large for more than `most_pixels`, before any is read. Memory: 9 bytes a pixel.
GrayImage read_png_gray(std::string_view bytes, std::size_t most_pixels);

}  // namespace wellspaced

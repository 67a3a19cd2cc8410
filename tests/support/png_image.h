#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

namespace wellspaced::testing {

/// A PNG read back by libpng.
struct PngImage {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  std::array<int, 3> at(std::size_t x, std::size_t y) const {
    const std::uint8_t* p = &rgb[3 * (y * width + x)];
    return {p[0], p[1], p[2]};
  }
};

inline PngImage read_png(const std::string& bytes) {
  PngImage result;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    ADD_FAILURE() << image.message;
    return result;
  }
  image.format = PNG_FORMAT_RGB;
  result.width = image.width;
  result.height = image.height;
  result.rgb.resize(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, result.rgb.data(), 0, nullptr), 0) << image.message;
  return result;
}

}  // namespace wellspaced::testing

#include "core/render/png.h"

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include <png.h>

#include "core/error.h"

namespace wellspaced {
namespace {

/// An exception must not pass through libpng, which is C.
bool try_append(std::string& to, const char* bytes, std::size_t size) noexcept {
  try {
    to.append(bytes, size);
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

void append(png_structp png, png_bytep bytes, png_size_t size) {
  if (!try_append(*static_cast<std::string*>(png_get_io_ptr(png)), reinterpret_cast<const char*>(bytes),
                  size))
    png_error(png, "out of memory");
}

bool is_gray(const Image& image) {
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
    if (image.rgb[i] != image.rgb[i + 1] || image.rgb[i] != image.rgb[i + 2]) return false;
  return true;
}

/// One byte a pixel.
std::vector<std::uint8_t> grays(const Image& image) {
  std::vector<std::uint8_t> gray(image.rgb.size() / 3);
  for (std::size_t i = 0; i < gray.size(); ++i) gray[i] = image.rgb[3 * i];
  return gray;
}

/// libpng ends what it can't do by a jump, across which nothing may need a destructor.
bool write_rows(png_structp png, png_infop info, const std::uint8_t* bytes, const Image& image, bool gray,
                double pixels_per_inch) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  const std::size_t row = image.columns * (gray ? 1 : 3);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.columns), static_cast<png_uint_32>(image.rows), 8,
               gray ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (pixels_per_inch > 0) {
    const auto per_meter = static_cast<png_uint_32>(pixels_per_inch / 0.0254 + 0.5);
    png_set_pHYs(png, info, per_meter, per_meter, PNG_RESOLUTION_METER);
  }
  png_write_info(png, info);
  for (std::size_t y = 0; y < image.rows; ++y) png_write_row(png, bytes + y * row);
  png_write_end(png, info);
  return true;
}

}  // namespace

std::string write_png(const Image& image, double pixels_per_inch) {
  std::string out;
  const bool gray = is_gray(image);
  const std::vector<std::uint8_t> converted = gray ? grays(image) : std::vector<std::uint8_t>();
  const std::uint8_t* bytes = gray ? converted.data() : image.rgb.data();
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  bool written = false;
  if (info != nullptr) {
    png_set_write_fn(png, &out, append, nullptr);
    written = write_rows(png, info, bytes, image, gray, pixels_per_inch);
  }
  png_destroy_write_struct(&png, &info);
  if (!written) throw Error(ErrorCode::internal, "libpng failed");
  return out;
}

}  // namespace wellspaced

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

bool is_gray(const std::uint8_t* rgb, std::size_t bytes) {
  for (std::size_t i = 0; i + 2 < bytes; i += 3)
    if (rgb[i] != rgb[i + 1] || rgb[i] != rgb[i + 2]) return false;
  return true;
}

/// libpng's objects, given back however the writing ends.
class Writer {
 public:
  Writer(const Image& image, const Control& control) : image_(image), control_(control) {
    for (std::size_t y = 0; gray_ && y < image.rows; ++y) {
      control.check();
      gray_ = is_gray(row(y), 3 * image.columns);
    }
    if (gray_) grays_.resize(image.columns);
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~Writer() { png_destroy_write_struct(&png_, &info_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// libpng ends what it can't do by a jump to here, across which nothing may need a destructor. What is
  /// thrown between its calls passes none of its frames.
  bool write(std::string& to, double pixels_per_inch) {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_write_fn(png_, &to, append, nullptr);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(image_.columns), static_cast<png_uint_32>(image_.rows),
                 8, gray_ ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (pixels_per_inch > 0) {
      const auto per_meter = static_cast<png_uint_32>(pixels_per_inch / 0.0254 + 0.5);
      png_set_pHYs(png_, info_, per_meter, per_meter, PNG_RESOLUTION_METER);
    }
    png_write_info(png_, info_);
    for (std::size_t y = 0; y < image_.rows; ++y) {
      control_.check();
      png_write_row(png_, gray_ ? grays(y) : row(y));
    }
    png_write_end(png_, info_);
    return true;
  }

 private:
  const std::uint8_t* row(std::size_t y) const { return image_.rgb.data() + 3 * y * image_.columns; }

  /// One byte a pixel.
  const std::uint8_t* grays(std::size_t y) {
    for (std::size_t x = 0; x < image_.columns; ++x) grays_[x] = row(y)[3 * x];
    return grays_.data();
  }

  const Image& image_;
  const Control& control_;
  bool gray_ = true;
  std::vector<std::uint8_t> grays_;  ///< scratch
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

std::string write_png(const Image& image, double pixels_per_inch, const Control& control) {
  std::string out;
  if (!Writer(image, control).write(out, pixels_per_inch)) throw Error(ErrorCode::internal, "libpng failed");
  return out;
}

}  // namespace wellspaced

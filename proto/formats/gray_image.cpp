#include "proto/formats/gray_image.h"

#include <cstdint>
#include <string>

#include <png.h>

#include "core/error.h"

namespace wellspaced {
namespace {

/// libpng's simple interface, given back however the reading ends.
struct Reader {
  png_image image{};

  Reader() { image.version = PNG_IMAGE_VERSION; }
  ~Reader() { png_image_free(&image); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

Error not_readable(const Reader& reader) {
  return {ErrorCode::malformed_request, "this is no PNG that can be read (" +
                                            std::string(reader.image.message) + "); send a whole PNG file"};
}

}  // namespace

GrayImage read_png_gray(std::string_view bytes, std::size_t most_pixels) {
  Reader reader;
  if (png_image_begin_read_from_memory(&reader.image, bytes.data(), bytes.size()) == 0)
    throw not_readable(reader);
  const std::size_t columns = reader.image.width, rows = reader.image.height;
  if (columns > most_pixels / rows)
    throw Error(ErrorCode::payload_too_large, "the image has " + std::to_string(columns) + " x " +
                                                  std::to_string(rows) + " pixels, but the limit is " +
                                                  std::to_string(most_pixels) + "; send a smaller one");
  reader.image.format = PNG_FORMAT_GRAY;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(reader.image));
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&reader.image, &white, pixels.data(), 0, nullptr) == 0)
    throw not_readable(reader);
  GrayImage gray{columns, rows, std::vector<double>(pixels.size())};
  for (std::size_t k = 0; k < pixels.size(); ++k) gray.brightness[k] = pixels[k] / 255.0;
  return gray;
}

}  // namespace wellspaced

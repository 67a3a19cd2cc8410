#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "proto/formats/mesh_text.h"

namespace wellspaced {

struct PlyType {
  char kind = 'f';  ///< 'f', 'i' or 'u'
  std::size_t bytes = 4;
};

struct PlyProperty {
  std::string_view name;
  PlyType type;
  std::optional<PlyType> count;  ///< of a list
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The property of this name; nothing if there is none.
  std::optional<std::size_t> find(std::string_view property) const;
  /// What a row takes at least.
  std::uint64_t least_bytes(bool ascii) const;
};

struct PlyHeader {
  enum class Encoding { ascii, little_endian, big_endian };
  Encoding encoding = Encoding::ascii;
  std::vector<PlyElement> elements;  ///< names are parts of the text
};

/// Reads the header, up to and with the line end_header.
///
/// Errors: malformed_request naming the line, also where the elements announced are more than the bytes after
/// the header can hold.
PlyHeader read_ply_header(MeshText& text);

}  // namespace wellspaced

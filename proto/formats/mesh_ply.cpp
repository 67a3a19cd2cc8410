#include "proto/formats/mesh_ply.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "core/error.h"
#include "proto/formats/mesh_text.h"
#include "proto/formats/ply_header.h"
#include "proto/formats/polygon_mesh.h"

namespace wellspaced {
namespace {

/// The values of an ASCII file: words, line ends are not looked at.
class AsciiValues {
 public:
  explicit AsciiValues(MeshText& text) : text_(&text) {}

  double read(PlyType type) {
    const std::string_view word = text_->next_word_anywhere();
    if (type.kind == 'f') return text_->number(word, "a number");
    return static_cast<double>(text_->integer(word, "a whole number"));
  }
  void skip(PlyType) {
    if (text_->next_word_anywhere().empty())
      text_->malformed("is the last, but there is more to come; the file is truncated");
  }
  /// Of the next value.
  std::size_t place() const {
    text_->skip_to_word();
    return text_->line_number();
  }
  [[noreturn]] void malformed(const std::string& problem) const { text_->malformed(problem); }
  void finish() {
    if (!text_->next_word_anywhere().empty()) text_->malformed("has more than the header announces");
  }

 private:
  MeshText* text_;
};

/// Those of a binary file.
class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, std::size_t header_bytes, bool big_endian)
      : bytes_(bytes), at_(header_bytes), big_endian_(big_endian) {}

  double read(PlyType type) {
    const char* from = take(type);
    std::uint64_t bits = 0;
    static_assert(std::endian::native == std::endian::little, "values are copied as they are");
    std::memcpy(&bits, from, type.bytes);
    if (big_endian_) bits = __builtin_bswap64(bits) >> (64 - 8 * type.bytes);
    if (type.kind == 'f')
      return type.bytes == 8 ? std::bit_cast<double>(bits)
                             : double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
    if (type.kind == 'u') return static_cast<double>(bits);
    const std::size_t unused = 64 - 8 * type.bytes;
    return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
  }
  void skip(PlyType type) { take(type); }
  std::size_t place() const { return at_; }
  [[noreturn]] void malformed(const std::string& problem) const {
    throw Error(ErrorCode::malformed_request, "byte " + std::to_string(at_) + " of the PLY file " + problem);
  }
  void finish() const {
    if (at_ < bytes_.size())
      malformed("should be the end, but " + std::to_string(bytes_.size() - at_) + " more follow");
  }

 private:
  const char* take(PlyType type) {
    if (type.bytes > bytes_.size() - at_) malformed("is in the last value; the file is truncated");
    const char* from = bytes_.data() + at_;
    at_ += type.bytes;
    return from;
  }

  std::string_view bytes_;
  std::size_t at_;
  bool big_endian_;
};

template <class Values>
std::uint64_t read_length(Values& values, PlyType type) {
  const double length = values.read(type);
  if (length < 0) values.malformed("has a list of negative length");
  return static_cast<std::uint64_t>(length);
}

template <class Values>
void skip_property(Values& values, const PlyProperty& property) {
  const std::uint64_t length = property.count ? read_length(values, *property.count) : 1;
  for (std::uint64_t k = 0; k < length; ++k) values.skip(property.type);
}

template <class Values>
void read_vertices(Values& values, const PlyElement& element, PolygonMesh& mesh) {
  const auto x = element.find("x"), y = element.find("y"), z = element.find("z");
  for (const auto& axis : {x, y, z})
    if (!axis || element.properties[*axis].count)
      throw Error(ErrorCode::invalid_parameters,
                  "the element vertex of the PLY file lacks one of the properties x, y and z");
  mesh.expect_vertices(element.count);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    Vec3 p;
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      if (k == *x)
        p.x = values.read(element.properties[k].type);
      else if (k == *y)
        p.y = values.read(element.properties[k].type);
      else if (k == *z)
        p.z = values.read(element.properties[k].type);
      else
        skip_property(values, element.properties[k]);
    }
    mesh.add_vertex(p);
  }
}

template <class Values>
void read_faces(Values& values, const PlyElement& element, PolygonMesh& mesh) {
  const auto list =
      element.find("vertex_indices") ? element.find("vertex_indices") : element.find("vertex_index");
  if (!list || !element.properties[*list].count || element.properties[*list].type.kind == 'f')
    throw Error(ErrorCode::invalid_parameters,
                "the element face of the PLY file lacks the list vertex_indices of integers");
  mesh.expect_faces(element.count);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    const std::size_t place = values.place();
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (k != *list) {
        skip_property(values, property);
        continue;
      }
      const std::uint64_t length = read_length(values, *property.count);
      for (std::uint64_t i = 0; i < length; ++i) {
        if (i <= PolygonMesh::most_corners)
          mesh.add_corner(static_cast<std::int64_t>(values.read(property.type)));
        else
          values.skip(property.type);
      }
    }
    mesh.close_face(place);
  }
}

template <class Values>
Triangles read_elements(Values values, const PlyHeader& header, PolygonMesh mesh) {
  bool has_vertices = false, has_faces = false;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex" && !std::exchange(has_vertices, true)) {
      read_vertices(values, element, mesh);
    } else if (element.name == "face" && !std::exchange(has_faces, true)) {
      read_faces(values, element, mesh);
    } else if (!element.properties.empty()) {
      for (std::uint64_t row = 0; row < element.count; ++row)
        for (const PlyProperty& property : element.properties) skip_property(values, property);
    }
  }
  if (!has_vertices || !has_faces)
    throw Error(ErrorCode::invalid_parameters,
                std::string("the PLY file has no element ") +
                    (has_vertices ? "face; a surface needs faces (triangle strips aren't read)" : "vertex"));
  values.finish();
  return std::move(mesh).triangles();
}

}  // namespace

Triangles read_ply(std::string_view bytes, const MeshLimits& limits) {
  MeshText text(bytes, "PLY file", MeshText::Comments::none);
  const PlyHeader header = read_ply_header(text);
  if (header.encoding == PlyHeader::Encoding::ascii)
    return read_elements(AsciiValues(text), header, PolygonMesh(limits, "PLY file", "line"));
  return read_elements(BinaryValues(bytes, bytes.size() - text.rest().size(),
                                    header.encoding == PlyHeader::Encoding::big_endian),
                       header, PolygonMesh(limits, "PLY file", "byte"));
}

}  // namespace wellspaced

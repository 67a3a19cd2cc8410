#include "proto/formats/ply_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "proto/formats/excerpt.h"

namespace wellspaced {
namespace {

constexpr std::size_t most_header_lines = 1000;

struct NamedType {
  std::string_view name;
  PlyType type;
};

constexpr std::array types = {
    NamedType{"char", {'i', 1}},   NamedType{"int8", {'i', 1}},    NamedType{"uchar", {'u', 1}},
    NamedType{"uint8", {'u', 1}},  NamedType{"short", {'i', 2}},   NamedType{"int16", {'i', 2}},
    NamedType{"ushort", {'u', 2}}, NamedType{"uint16", {'u', 2}},  NamedType{"int", {'i', 4}},
    NamedType{"int32", {'i', 4}},  NamedType{"uint", {'u', 4}},    NamedType{"uint32", {'u', 4}},
    NamedType{"float", {'f', 4}},  NamedType{"float32", {'f', 4}}, NamedType{"double", {'f', 8}},
    NamedType{"float64", {'f', 8}}};

PlyType read_type(MeshText& text) {
  const std::string_view word = text.next_word();
  for (const NamedType& type : types)
    if (type.name == word) return type.type;
  text.malformed("has the unknown type " + excerpt(word));
}

PlyHeader::Encoding read_encoding(MeshText& text) {
  const std::string_view encoding = text.next_word(), version = text.next_word();
  if (version != "1.0") text.malformed("has version " + excerpt(version) + "; only 1.0 is read");
  if (encoding == "ascii") return PlyHeader::Encoding::ascii;
  if (encoding == "binary_little_endian") return PlyHeader::Encoding::little_endian;
  if (encoding == "binary_big_endian") return PlyHeader::Encoding::big_endian;
  text.malformed("has the unknown encoding " + excerpt(encoding));
}

PlyElement read_element(MeshText& text) {
  PlyElement element;
  element.name = text.next_word();
  const std::int64_t count = text.integer(text.next_word(), "the number of rows");
  if (count < 0) text.malformed("has a negative number of rows");
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

PlyProperty read_property(MeshText& text) {
  PlyProperty property;
  MeshText ahead = text;
  if (ahead.next_word() == "list") {
    text.next_word();
    property.count = read_type(text);
    if (property.count->kind == 'f') text.malformed("has a list whose length is of a floating type");
  }
  property.type = read_type(text);
  property.name = text.next_word();
  if (property.name.empty()) text.malformed("has a property without a name");
  return property;
}

void check_size(const MeshText& text, const PlyHeader& header) {
  const std::uint64_t there = text.rest().size() + 1;  // the last line of a text may lack its end
  for (const PlyElement& element : header.elements) {
    const std::uint64_t each = element.least_bytes(header.encoding == PlyHeader::Encoding::ascii);
    if (each > 0 && element.count > there / each)
      text.malformed("ends a header with " + std::to_string(element.count) + " rows of the element " +
                     excerpt(element.name) + ", more than the " + std::to_string(there - 1) +
                     " bytes after it can hold; the file is truncated");
  }
}

}  // namespace

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  for (std::size_t k = 0; k < properties.size(); ++k)
    if (properties[k].name == property) return k;
  return {};
}

std::uint64_t PlyElement::least_bytes(bool ascii) const {
  std::uint64_t sum = 0;
  for (const PlyProperty& property : properties)
    sum += ascii ? 2 : property.count ? property.count->bytes : property.type.bytes;
  return sum;
}

PlyHeader read_ply_header(MeshText& text) {
  PlyHeader header;
  bool has_format = false;
  if (!text.next_line() || text.next_word() != "ply")
    text.malformed("is not \"ply\", with which PLY files begin");
  while (text.next_line()) {
    const std::string_view word = text.next_word();
    if (word == "end_header") {
      if (!has_format) text.malformed("ends a header without the line \"format\"");
      check_size(text, header);
      return header;
    }
    if (word == "format") {
      header.encoding = read_encoding(text);
      has_format = true;
    } else if (word == "element") {
      header.elements.push_back(read_element(text));
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(text));
    } else if (word != "comment" && word != "obj_info") {
      text.malformed("begins with " + excerpt(word) + ", which has no place in the header");
    }
    if (text.line_number() > most_header_lines) break;
  }
  text.malformed("is reached without the header's end, \"end_header\"");
}

}  // namespace wellspaced

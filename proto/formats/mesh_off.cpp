#include "proto/formats/mesh_off.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "core/error.h"
#include "proto/formats/excerpt.h"
#include "proto/formats/mesh_text.h"
#include "proto/formats/polygon_mesh.h"

namespace wellspaced {
namespace {

constexpr std::uint64_t vertex_bytes = 6, face_bytes = 8;  ///< "0 0 0" and "3 0 1 2", with the line's end

/// Returns the word after it on the line.
std::string_view read_keyword(MeshText& text) {
  if (!text.next_line()) text.malformed("is all there is; an OFF file begins with OFF");
  const std::string_view word = text.next_word();
  std::string_view prefix = word.substr(0, word.size() - std::min<std::size_t>(3, word.size()));
  if (!word.ends_with("OFF")) text.malformed("has " + excerpt(word) + ", but an OFF file begins with OFF");
  for (const std::string_view skipped : {"ST", "C", "N"})
    if (prefix.starts_with(skipped)) prefix.remove_prefix(skipped.size());
  const std::string_view next = text.next_word();
  if (!prefix.empty() || next == "BINARY")
    throw Error(ErrorCode::invalid_parameters,
                "the OFF file is " + excerpt(prefix.empty() ? "OFF BINARY" : word) +
                    "; of this family the text formats in three dimensions are read: OFF, COFF, NOFF, STOFF");
  return next;
}

std::uint64_t read_count(MeshText& text, std::string_view word, std::string_view what,
                         std::uint64_t bytes_each) {
  const std::int64_t count = text.integer(word, "the number of " + std::string(what));
  if (count < 0) text.malformed("has a negative number of " + std::string(what));
  if (static_cast<std::uint64_t>(count) > text.bytes_left() / bytes_each + 1)
    text.malformed("announces " + std::to_string(count) + " " + std::string(what) + ", more than the " +
                   std::to_string(text.bytes_left()) + " bytes after it can hold");
  return static_cast<std::uint64_t>(count);
}

/// Which nobody looks at, and some don't write. A vertex is more than one word.
void skip_count_of_edges(MeshText& text) {
  if (!text.next_word().empty()) return;
  MeshText ahead = text;
  if (ahead.next_line() && !ahead.next_word().empty() && ahead.next_word().empty()) text = ahead;
}

}  // namespace

Triangles read_off(std::string_view bytes, const MeshLimits& limits) {
  MeshText text(bytes, "OFF file");
  PolygonMesh mesh(limits, "OFF file", "line");
  std::string_view word = read_keyword(text);
  if (word.empty()) word = text.next_word_anywhere();
  const std::uint64_t vertices = read_count(text, word, "vertices", vertex_bytes);
  const std::uint64_t faces = read_count(text, text.next_word_anywhere(), "faces", face_bytes);
  skip_count_of_edges(text);
  mesh.expect_vertices(vertices);
  mesh.expect_faces(faces);
  for (std::uint64_t v = 0; v < vertices; ++v) {
    if (!text.next_line())
      text.malformed("is the last, but vertex " + std::to_string(v) +
                     " is still to come; the file is truncated, or its counts are too high");
    const double x = text.number(text.next_word(), "x"), y = text.number(text.next_word(), "y");
    mesh.add_vertex({x, y, text.number(text.next_word(), "z")});
  }
  for (std::uint64_t f = 0; f < faces; ++f) {
    if (!text.next_line())
      text.malformed("is the last, but face " + std::to_string(f) +
                     " is still to come; the file is truncated, or its counts are too high");
    const std::int64_t corners = text.integer(text.next_word(), "a number of corners");
    for (std::int64_t k = 0; k < corners; ++k) mesh.add_corner(text.integer(text.next_word(), "a vertex"));
    mesh.close_face(text.line_number());
  }
  if (text.next_line())
    text.malformed("follows the last face; the header's counts are too low, or it is not OFF");
  return std::move(mesh).triangles();
}

}  // namespace wellspaced

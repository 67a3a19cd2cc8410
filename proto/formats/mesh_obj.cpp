#include "proto/formats/mesh_obj.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "core/error.h"
#include "proto/formats/excerpt.h"
#include "proto/formats/mesh_text.h"
#include "proto/formats/polygon_mesh.h"

namespace wellspaced {
namespace {

constexpr std::array<std::string_view, 19> skipped = {
    "vt", "vn",  "vp",    "o",        "g",        "s",      "mg",     "usemtl",     "mtllib",   "l",
    "p",  "lod", "bevel", "c_interp", "d_interp", "usemap", "maplib", "shadow_obj", "trace_obj"};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const MeshLimits& limits)
      : text_(bytes, "OBJ file"), mesh_(limits, "OBJ file", "line", 1) {}

  Triangles read() {
    while (text_.next_line()) {
      const std::string_view statement = text_.next_word();
      if (statement == "v")
        read_vertex();
      else if (statement == "f")
        read_face();
      else if (std::find(skipped.begin(), skipped.end(), statement) != skipped.end())
        while (!next_word().empty()) continue;
      else
        text_.malformed("begins with " + excerpt(statement) +
                        ", which is not read; send vertices (v) and faces (f)");
    }
    return std::move(mesh_).triangles();
  }

 private:
  /// Across a '\' at the end of a line.
  std::string_view next_word() {
    std::string_view word = text_.next_word();
    while (word == "\\") word = text_.next_line() ? text_.next_word() : std::string_view();
    return word;
  }

  void read_vertex() {
    const double x = text_.number(next_word(), "x"), y = text_.number(next_word(), "y");
    mesh_.add_vertex({x, y, text_.number(next_word(), "z")});
    while (!next_word().empty()) continue;  // a weight or a color
  }

  void read_face() {
    const std::size_t line = text_.line_number();
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
      const std::string_view rest = word.substr(std::min(word.find('/'), word.size()));
      if (rest.find_first_not_of("/-+0123456789") != std::string_view::npos)
        text_.malformed("has " + excerpt(word) + " for a corner; write a, a/t, a/t/n or a//n");
      const std::int64_t index = text_.integer(word.substr(0, word.size() - rest.size()), "a vertex");
      mesh_.add_corner(index > 0 ? index - 1 : counted_back(index));
    }
    mesh_.close_face(line);
  }

  /// -1 is the last vertex so far.
  std::int64_t counted_back(std::int64_t index) const {
    if (index == 0) text_.malformed("uses vertex 0; vertices of an OBJ file are counted from 1");
    const auto so_far = static_cast<std::int64_t>(mesh_.vertices());
    if (index < -so_far)
      throw Error(ErrorCode::invalid_parameters,
                  "face " + std::to_string(mesh_.faces()) + " (" + text_.place() + ") uses vertex " +
                      std::to_string(index) + " (counted back from the last one above it), but there are " +
                      std::to_string(so_far) + " above it",
                  "/faces/" + std::to_string(mesh_.faces()));
    return so_far + index;
  }

  MeshText text_;
  PolygonMesh mesh_;
};

}  // namespace

bool is_obj_statement(std::string_view word) {
  return word == "v" || word == "f" || std::find(skipped.begin(), skipped.end(), word) != skipped.end();
}

Triangles read_obj(std::string_view bytes, const MeshLimits& limits) {
  return ObjReader(bytes, limits).read();
}

}  // namespace wellspaced

#include "proto/formats/mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "core/error.h"
#include "proto/formats/excerpt.h"
#include "proto/formats/mesh_obj.h"
#include "proto/formats/mesh_off.h"
#include "proto/formats/mesh_ply.h"
#include "proto/formats/mesh_text.h"

namespace wellspaced {
namespace {

struct MediaType {
  std::string_view name;
  MeshFormat format;
};

constexpr std::array media_types = {
    MediaType{"model/obj", MeshFormat::obj},       MediaType{"text/prs.wavefront-obj", MeshFormat::obj},
    MediaType{"application/obj", MeshFormat::obj}, MediaType{"model/ply", MeshFormat::ply},
    MediaType{"application/ply", MeshFormat::ply}, MediaType{"text/ply", MeshFormat::ply},
    MediaType{"model/x-ply", MeshFormat::ply},     MediaType{"model/off", MeshFormat::off},
    MediaType{"model/x-off", MeshFormat::off},     MediaType{"application/off", MeshFormat::off},
    MediaType{"model/vnd.off", MeshFormat::off},
};

}  // namespace

std::string_view name_of(MeshFormat format) {
  switch (format) {
    case MeshFormat::off:
      return "off";
    case MeshFormat::obj:
      return "obj";
    case MeshFormat::ply:
      return "ply";
  }
  return "";
}

std::optional<MeshFormat> mesh_format_named(std::string_view name) {
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply})
    if (name_of(format) == name) return format;
  return {};
}

std::optional<MeshFormat> mesh_format_of_media_type(std::string_view media_type) {
  std::string name(media_type.substr(0, media_type.find(';')));
  while (!name.empty() && name.back() == ' ') name.pop_back();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const MediaType& type : media_types)
    if (type.name == name) return type.format;
  return {};
}

MeshFormat detect_mesh_format(std::string_view bytes) {
  MeshText text(bytes, "mesh file");
  if (!text.next_line())
    throw Error(ErrorCode::malformed_request, "the mesh file is empty; send OFF, OBJ or PLY");
  const std::string_view word = text.next_word();
  if (word == "ply") return MeshFormat::ply;
  if (word.ends_with("OFF")) return MeshFormat::off;
  if (is_obj_statement(word)) return MeshFormat::obj;
  throw Error(
      ErrorCode::malformed_request,
      "the mesh file begins with " + excerpt(word) +
          ", which is neither OFF (\"OFF\"), PLY (\"ply\") nor OBJ (\"v\", \"f\", ...); send one of these");
}

Triangles read_mesh(std::string_view bytes, MeshFormat format, const MeshLimits& limits) {
  switch (format) {
    case MeshFormat::off:
      return read_off(bytes, limits);
    case MeshFormat::obj:
      return read_obj(bytes, limits);
    case MeshFormat::ply:
      return read_ply(bytes, limits);
  }
  return {};
}

}  // namespace wellspaced

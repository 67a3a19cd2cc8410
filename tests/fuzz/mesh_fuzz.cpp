#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/error.h"
#include "proto/formats/mesh.h"

/// Whatever the bytes are: in each format a mesh whose faces use its vertices, or an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  using wellspaced::MeshFormat;
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply}) {
    try {
      const wellspaced::Triangles mesh = wellspaced::read_mesh(bytes, format, {1000, 1000});
      if (mesh.vertices.size() > 1000 || mesh.faces.size() > 1000) std::abort();
      for (const auto& face : mesh.faces)
        for (const std::uint32_t v : face)
          if (v >= mesh.vertices.size()) std::abort();
    } catch (const wellspaced::Error&) {
    }
  }
  return 0;
}

#include "proto/formats/mesh_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "proto/formats/base64.h"
#include "proto/json_writer.h"

namespace wellspaced {
namespace {

static_assert(std::endian::native == std::endian::little, "meshes are written as they are in memory");

template <class Number>
void append(std::string& out, Number number) {
  std::array<char, sizeof number> bytes;
  std::memcpy(bytes.data(), &number, sizeof number);
  out.append(bytes.data(), bytes.size());
}

std::int32_t signed_number(std::uint32_t number) {
  return number == Mesh::no_point ? -1 : static_cast<std::int32_t>(number);
}

std::size_t most_corners(const Mesh& mesh) {
  std::size_t most = 0;
  for (std::size_t f = 0; f < mesh.faces(); ++f) most = std::max(most, mesh[f].size());
  return most;
}

template <class Number>
std::string data_array(const char* type, const std::string& attributes, const std::vector<Number>& numbers) {
  std::string bytes;
  append(bytes, std::uint64_t{numbers.size() * sizeof(Number)});
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
  return std::string("<DataArray type=\"") + type + "\" " + attributes + " format=\"binary\">\n" +
         encode_base64(bytes) + "\n</DataArray>\n";
}

std::string points_array(const std::vector<std::uint32_t>& points) {
  std::vector<std::int64_t> numbers;
  for (const std::uint32_t point : points) numbers.push_back(signed_number(point));
  return data_array("Int64", "Name=\"point\"", numbers);
}

}  // namespace

std::string write_ply(const Mesh& mesh) {
  const bool is_small = most_corners(mesh) <= 255;
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment wellspaced\nelement vertex " +
                    std::to_string(mesh.vertices.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\n" +
                    (mesh.vertex_points.empty() ? "" : "property int point\n") + "element face " +
                    std::to_string(mesh.faces()) + "\nproperty list " + (is_small ? "uchar" : "int") +
                    " int vertex_indices\nend_header\n";
  out.reserve(out.size() + mesh.vertices.size() * 28 + mesh.corners.size() * 4 + mesh.faces() * 8);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 at = mesh.vertices[v];
    for (const double coordinate : {at.x, at.y, at.z}) append(out, coordinate);
    if (!mesh.vertex_points.empty()) append(out, signed_number(mesh.vertex_points[v]));
  }
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    if (is_small)
      append(out, static_cast<std::uint8_t>(mesh[f].size()));
    else
      append(out, static_cast<std::int32_t>(mesh[f].size()));
    for (const std::uint32_t v : mesh[f]) append(out, v);
  }
  return out;
}

std::string write_obj(const Mesh& mesh) {
  std::string out = "# wellspaced\n";
  for (const Vec3 at : mesh.vertices) {
    out += 'v';
    for (const double coordinate : {at.x, at.y, at.z}) {
      out += ' ';
      append_number(out, coordinate);
    }
    out += '\n';
  }
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    out += 'f';
    for (const std::uint32_t v : mesh[f]) out += ' ' + std::to_string(v + 1);
    out += '\n';
  }
  return out;
}

std::string write_vtu(const Mesh& mesh) {
  constexpr std::uint8_t triangle = 5, polygon = 7;
  std::vector<double> places;
  for (const Vec3 at : mesh.vertices) places.insert(places.end(), {at.x, at.y, at.z});
  const std::vector<std::int64_t> corners(mesh.corners.begin(), mesh.corners.end()),
      ends(mesh.ends.begin(), mesh.ends.end());
  std::vector<std::uint8_t> types;
  for (std::size_t f = 0; f < mesh.faces(); ++f) types.push_back(mesh[f].size() == 3 ? triangle : polygon);
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
      std::to_string(mesh.vertices.size()) + "\" NumberOfCells=\"" + std::to_string(mesh.faces()) + "\">\n";
  if (!mesh.vertex_points.empty())
    out += "<PointData>\n" + points_array(mesh.vertex_points) + "</PointData>\n";
  if (!mesh.face_points.empty()) out += "<CellData>\n" + points_array(mesh.face_points) + "</CellData>\n";
  out += "<Points>\n" + data_array("Float64", "Name=\"Points\" NumberOfComponents=\"3\"", places) +
         "</Points>\n";
  out += "<Cells>\n" + data_array("Int64", "Name=\"connectivity\"", corners) +
         data_array("Int64", "Name=\"offsets\"", ends) + data_array("UInt8", "Name=\"types\"", types) +
         "</Cells>\n";
  return out + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace wellspaced

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/rng.h"
#include "proto/formats/mesh.h"

namespace wellspaced {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Face = std::array<std::uint32_t, 3>;

constexpr ErrorCode malformed = ErrorCode::malformed_request, invalid = ErrorCode::invalid_parameters;

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_refusal(MeshFormat format, const std::string& bytes, ErrorCode code, const std::string& part,
                    const std::string& where = "") {
  SCOPED_TRACE(bytes.substr(0, 300));
  try {
    read_mesh(bytes, format, {100, 100});
    ADD_FAILURE() << "taken, not refused with: " << part;
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(part));
    EXPECT_EQ(error.where(), where);
    for (const char c : std::string(error.what())) EXPECT_TRUE(c >= ' ' && c <= '~');
  }
}

const std::string tetrahedron_off =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

TEST(ReadOff, ReadsEveryWayOfWritingIt) {
  const Triangles mesh = read_mesh(tetrahedron_off, MeshFormat::off);
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[3], (Vec3{0, 0, 1}));
  EXPECT_THAT(mesh.faces, ElementsAre(Face{0, 2, 1}, Face{0, 1, 3}, Face{1, 2, 3}, Face{2, 0, 3}));
  for (const char* other :
       {"OFF 4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3",
        "\xef\xbb\xbfOFF # tetrahedron\r\n#\r\n\r\n4 4\r\n0 0 0\r\n+1 0 0\r\n0 1. 0\r\n0 0 10e-1\r\n# "
        "faces\r\n3  0 2 1\r\n"
        "3 0\t1 3\r\n3 1 2 3\r\n3 2 0 3 \r\n\r\n",
        "COFF\n4 4 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n0 1 0 0 0 0 0\n0 0 1 0 0 0 0\n3 0 2 1 0.5 0.5 0.5\n3 "
        "0 1 3\n"
        "3 1 2 3\n3 2 0 3\n",
        "STCNOFF\n4\n4\n0\n0 0 0 1 1 1\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"}) {
    const Triangles same = read_mesh(other, MeshFormat::off);
    EXPECT_EQ(same.vertices, mesh.vertices) << other;
    EXPECT_EQ(same.faces, mesh.faces) << other;
  }
}

TEST(ReadOff, RefusesWhatItIsNot) {
  const auto refuse = [](const std::string& text, ErrorCode code, const std::string& part) {
    expect_refusal(MeshFormat::off, text, code, part);
  };
  refuse("", malformed, "begins with OFF");
  refuse("ply\n", malformed, "line 1 of the OFF file has 'ply'");
  refuse("OF", malformed, "'OF'");
  refuse("4OFF\n1 1 1\n", invalid, "'4OFF'");
  refuse("OFF BINARY\n", invalid, "OFF BINARY");
  refuse("OFF\n", malformed, "the number of vertices");
  refuse("OFF\n1.5 2 3\n", malformed, "'1.5' for the number of vertices, which is not a whole number");
  refuse("OFF\n-1 2 3\n", malformed, "negative number of vertices");
  refuse("OFF\n3 -2 3\n0 0 0\n0 0 1\n0 1 0\n", malformed, "negative number of faces");
  refuse("OFF\n1000000000 1 0\n", malformed, "announces 1000000000 vertices, more than the");
  refuse("OFF\n99999999999999999999 1 0\n", malformed, "not a whole number below 2^63");
  refuse("OFF\n1 1000000000 0\n0 0 0\n", malformed, "announces 1000000000 faces");
  refuse("OFF\n2 0 0\n0 0 0\n0 0 x\n", malformed, "line 4 of the OFF file has 'x' for z");
  refuse("OFF\n2 0 0\n0 0 0\n0 1e999 0\n", malformed, "'1e999' for y, which is outside the range");
  refuse("OFF\n2 0 0\n0 0 0\n0 1\n", malformed, "line 4 of the OFF file ends where z should be");
  refuse("OFF\n3 1 0\n0 0 0\n0 1 0\n", malformed,
         "line 4 of the OFF file is the last, but vertex 2 is still to come");
  refuse("OFF\n3 1 0\n0 0 0\n0 1 0\n0 0 1\n", malformed, "face 0 is still to come");
  refuse("OFF\n3 1 0\n0 0 0\n0 1 0\n0 0 1\n3 0 1\n", malformed, "ends where a vertex should be");
  refuse("OFF\n3 1 0\n0 0 0\n0 1 0\n0 0 1\n2 0 1\n", malformed,
         "face 0 (line 6 of the OFF file) has only 2 corners");
  refuse("OFF\n3 1 0\n0 0 0\n0 1 0\n0 0 1\n-3 0 1 2\n", malformed, "only 0 corners");
  refuse("OFF\n3 1 0\n0 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 2\n", malformed,
         "line 7 of the OFF file follows the last face");
  expect_refusal(MeshFormat::off, "OFF\n3 1 0\n0 0 0\n0 1 0\n0 0 1\n3 0 1 3\n", invalid,
                 "face 0 (line 6 of the OFF file) uses vertex 3 (counted from 0), but there are 3",
                 "/faces/0");
  expect_refusal(MeshFormat::off, "OFF\n3 1 0\n0 0 0\n0 1 0\n0 0 1\n3 0 1 -3\n", invalid, "uses vertex -3",
                 "/faces/0");
  std::string many = "OFF\n101 0 0\n";
  for (int k = 0; k < 101; ++k) many += "0 0 0\n";
  refuse(many, ErrorCode::too_large, "more than 100 vertices");
  refuse("\xff\xfeO\0", malformed, "UTF-16");
}

TEST(ReadOff, LeavesNanToThoseWhoKnowTheFace) {
  const Triangles mesh = read_mesh("OFF\n3 1 0\nnan 0 inf\n0 1 0\n0 0 1\n3 0 1 2\n", MeshFormat::off);
  EXPECT_TRUE(std::isnan(mesh.vertices[0].x));
}

TEST(ReadMesh, CutsPolygonsIntoFans) {
  const auto faces = [](const std::string& corners, const std::string& face) {
    return read_mesh("OFF\n5 1 0\n" + corners + face, MeshFormat::off).faces;
  };
  const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n9 9 9\n";
  EXPECT_THAT(faces(square, "4 0 1 2 3\n"), ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}));
  EXPECT_THAT(faces(square, "4 3 2 1 0\n"), ElementsAre(Face{3, 2, 1}, Face{3, 1, 0}));
  // A dart, with its notch at corner 2: only from there and from the corner across it.
  const std::string dart = "1 -1 0\n0 3 0\n0 0 0\n-1 -1 0\n9 9 9\n";
  EXPECT_THAT(faces(dart, "4 0 1 3 2\n"), ElementsAre(Face{1, 3, 2}, Face{1, 2, 0}));
  // Not planar.
  EXPECT_THAT(faces("0 0 0\n1 0 0\n1 1 1\n0 1 0\n9 9 9\n", "4 0 1 2 3\n"),
              ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}));
  // A bow tie is no polygon, and one without area has no inside.
  expect_refusal(MeshFormat::off, "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n", invalid,
                 "a polygon of 4 corners from none of which", "/faces/0");
  expect_refusal(MeshFormat::off, "OFF\n4 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 1 2 3\n", invalid,
                 "from none of which", "/faces/0");
  std::string large = "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n65";
  for (int k = 0; k < 65; ++k) large += " 0";
  expect_refusal(MeshFormat::off, large, invalid, "65 corners; cut faces of more than 64", "/faces/0");
}

TEST(ReadObj, ReadsEveryWayOfWritingIt) {
  const Triangles mesh = read_mesh(
      "# made by hand\r\nmtllib a.mtl\r\no thing\r\nv 0 0 0\r\nv 1 0 0 1.0\r\nvt 0 0\r\nvn 0 0 1\r\nv 0 1 0 "
      "0.5 0.5 0.5\r\n"
      "g one two\r\nusemtl red\r\ns off\r\nf 1 2 3 # comment\r\nf 1/1 2/1 3/1\r\nf 1/1/1 2/1/1 3/1/1\r\nf "
      "1//1 2//1 3//1\r\n"
      "f -3 -2 -1\r\nv 0 0 1\r\nf -4/-1 -3/-1 -2/-1\r\nf 1 2 \\\r\n 3\r\nf 1 2 5\r\nl 1 2\r\np 1\r\nv 2 2 "
      "2\r\n",
      MeshFormat::obj);
  EXPECT_EQ(mesh.vertices.size(), 5u);
  ASSERT_EQ(mesh.faces.size(), 8u);
  for (std::size_t f = 0; f < 7; ++f) EXPECT_EQ(mesh.faces[f], (Face{0, 1, 2})) << f;
  EXPECT_EQ(mesh.faces[7], (Face{0, 1, 4}));
}

TEST(ReadObj, RefusesWhatItIsNot) {
  const auto refuse = [](const std::string& text, ErrorCode code, const std::string& part,
                         const std::string& where = "") {
    expect_refusal(MeshFormat::obj, text, code, part, where);
  };
  refuse("v 0 0\n", malformed, "line 1 of the OBJ file ends where z should be");
  refuse("\n\nv 0 0 q\n", malformed, "line 3 of the OBJ file has 'q' for z");
  refuse("v 0 0 0\nf 1 1 0\n", malformed, "uses vertex 0; vertices of an OBJ file are counted from 1");
  refuse("v 0 0 0\nf 1 1 2\n", invalid,
         "face 0 (line 2 of the OBJ file) uses vertex 2 (counted from 1), but there are 1", "/faces/0");
  refuse(
      "v 0 0 0\nf 1 1 -2\nv 0 0 1\n", invalid,
      "face 0 (line 2 of the OBJ file) uses vertex -2 (counted back from the last one above it), but there "
      "are 1 above it",
      "/faces/0");
  refuse("v 0 0 0\nf 1 1 -9223372036854775808\n", invalid, "uses vertex -922", "/faces/0");
  refuse("v 0 0 0\nf 1 1 9223372036854775808\n", malformed, "not a whole number below 2^63");
  refuse("v 0 0 0\nf 1 1 1/x\n", malformed, "'1/x' for a corner");
  refuse("v 0 0 0\nf 1 1 /1\n", malformed, "a vertex");
  refuse("v 0 0 0\nf 1 1\n", malformed, "has only 2 corners");
  refuse("v 0 0 0\nf\n", malformed, "has only 0 corners");
  refuse("v 0 0 0\ncurv 0 1 1 2\n", malformed, "begins with 'curv', which is not read");
  refuse("hello\n", malformed, "'hello'");
  std::string many = "v 0 0 0\n";
  for (int k = 0; k < 101; ++k) many += "f 1 1 1\n";
  refuse(many, ErrorCode::too_large, "more than 100 faces");
}

/// A value as a binary file holds it.
template <class Value>
std::string raw(Value value, bool big_endian) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

const std::string ply_elements =
    "comment a tetrahedron\nobj_info none\nelement camera 2\nproperty double f\nproperty list ushort short "
    "tags\n"
    "element vertex 4\nproperty uchar red\nproperty float x\nproperty double y\nproperty int z\n"
    "element face 4\nproperty list uchar int vertex_indices\nproperty list int float uv\nend_header\n";

std::string binary_ply(bool big) {
  std::string out =
      std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + ply_elements;
  for (int k = 0; k < 2; ++k)
    out +=
        raw(0.5, big) + raw<std::uint16_t>(2, big) + raw<std::int16_t>(-1, big) + raw<std::int16_t>(7, big);
  const double points[4][3] = {{0.5, 0.1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -3}};
  for (const auto& [x, y, z] : points)
    out += raw<std::uint8_t>(200, big) + raw(static_cast<float>(x), big) + raw(y, big) +
           raw(static_cast<std::int32_t>(z), big);
  const std::int32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (const auto& [a, b, c] : faces)
    out += raw<std::uint8_t>(3, big) + raw(a, big) + raw(b, big) + raw(c, big) + raw<std::int32_t>(1, big) +
           raw(0.5f, big);
  return out;
}

const std::string ascii_ply =
    "ply\nformat ascii 1.0\n" + ply_elements +
    "0.5 2 -1 7\n0.5 0\n200 0.5 0.1 0\n1 1 0 0\n2 0 1 0\n3 0 0 -3\n3 0 2 1 1 0.5\n3 0 1 3 0\n"
    "3 1 2 3 0\n3 2 0 3 2 1 1\n";

TEST(ReadPly, ReadsEveryEncoding) {
  for (const std::string& bytes : {ascii_ply, binary_ply(false), binary_ply(true)}) {
    const Triangles mesh = read_mesh(bytes, MeshFormat::ply);
    ASSERT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.vertices[0], (Vec3{0.5, 0.1, 0}));
    EXPECT_EQ(mesh.vertices[3], (Vec3{0, 0, -3}));
    EXPECT_THAT(mesh.faces, ElementsAre(Face{0, 2, 1}, Face{0, 1, 3}, Face{1, 2, 3}, Face{2, 0, 3}));
  }
  std::string crlf;
  for (const char c : ascii_ply) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(read_mesh(crlf, MeshFormat::ply).faces.size(), 4u);
}

TEST(ReadPly, RefusesEveryTruncation) {
  for (const std::string& bytes : {ascii_ply, binary_ply(false), binary_ply(true)})
    for (std::size_t size = 0; size + 3 < bytes.size(); ++size) {
      try {
        read_mesh(std::string_view(bytes).substr(0, size), MeshFormat::ply);
        ADD_FAILURE() << size;
      } catch (const Error& error) {
        EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(malformed))
            << size << ": " << error.what();
      }
    }
  expect_refusal(MeshFormat::ply, binary_ply(false) + "x", malformed, "should be the end, but 1 more follow");
  expect_refusal(MeshFormat::ply, ascii_ply + "1\n", malformed, "has more than the header announces");
}

TEST(ReadPly, RefusesWhatItIsNot) {
  const auto refuse = [](const std::string& text, ErrorCode code, const std::string& part,
                         const std::string& where = "") {
    expect_refusal(MeshFormat::ply, text, code, part, where);
  };
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string list = "property list uchar int vertex_index\n";
  const std::string ascii = "ply\nformat ascii 1.0\n", binary = "ply\nformat binary_little_endian 1.0\n";
  refuse("", malformed, "\"ply\"");
  refuse("OFF\n", malformed, "\"ply\"");
  refuse("ply\nend_header\n", malformed, "without the line \"format\"");
  refuse("ply\nformat ascii 2.0\n", malformed, "version '2.0'");
  refuse("ply\nformat binary 1.0\n", malformed, "encoding 'binary'");
  refuse(ascii + "element vertex x\n", malformed, "'x' for the number of rows");
  refuse(ascii + "element vertex -4\n", malformed, "negative number of rows");
  refuse(ascii + "element vertex 4\nproperty half x\n", malformed, "unknown type 'half'");
  refuse(ascii + "element vertex 4\nproperty list float int x\n", malformed, "floating type");
  refuse(ascii + "property float x\n", malformed, "'property', which has no place");
  refuse(ascii + "element vertex 1000000000\n" + xyz + "end_header\n0 0 0\n", malformed,
         "1000000000 rows of the element 'vertex', more than the 6 bytes");
  refuse(binary + "element vertex 9223372036854775807\n" + xyz + "end_header\n", malformed,
         "more than the 0 bytes");
  refuse(binary + "element face 9223372036854775807\nend_header\n", invalid, "vertex_indices");
  refuse(binary + "element x 9223372036854775807\nend_header\n", invalid, "no element vertex");
  refuse(ascii + "element vertex 1\n" + xyz + "end_header\n0 0 0\n", invalid, "no element face");
  refuse(ascii + "element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n", invalid,
         "lacks one of");
  refuse(ascii + "element face 1\nproperty int vertex_index\nend_header\n0\n", invalid, "lacks the list");
  const std::string one = "element vertex 1\n" + xyz + "element face 1\n" + list + "end_header\n";
  refuse(ascii + one + "0 0 0\n3 0 0 1\n", invalid, "face 0 (line 11 of the PLY file) uses vertex 1",
         "/faces/0");
  refuse(ascii + one + "0 0 0\n3 0 0 0.5\n", malformed, "'0.5' for a whole number");
  refuse(ascii + one + "0 zero 0\n3 0 0 0\n", malformed, "'zero'");
  refuse(ascii + one + "0 0 0\n-3 0 0 0\n", malformed, "list of negative length");
  refuse(ascii + one + "0 0 0\n1000000000 0 0\n", malformed, "ends where a whole number should be");
  refuse(binary + one + std::string(12, '\0') + "\xff", malformed, "the file is truncated");
  refuse(binary + one + std::string(12, '\0') + std::string("\x02\0\0\0\0\0\0\0\0", 9), malformed,
         "face 0 (byte 179 of the PLY file) has only 2 corners");
}

TEST(ReadMesh, KnowsFormatsByNameTypeAndContent) {
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply})
    EXPECT_EQ(mesh_format_named(name_of(format)), format);
  EXPECT_FALSE(mesh_format_named("stl").has_value());
  EXPECT_EQ(mesh_format_of_media_type("Model/OBJ; charset=utf-8"), MeshFormat::obj);
  EXPECT_FALSE(mesh_format_of_media_type("text/plain").has_value());
  EXPECT_EQ(detect_mesh_format(tetrahedron_off), MeshFormat::off);
  EXPECT_EQ(detect_mesh_format(binary_ply(true)), MeshFormat::ply);
  EXPECT_EQ(detect_mesh_format("# Blender\n\no cube\nv 0 0 0\n"), MeshFormat::obj);
  EXPECT_THROW(detect_mesh_format(""), Error);
  try {
    detect_mesh_format("solid cube\n");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("begins with 'solid'"));
  }
}

TEST(ReadMesh, ReadsARealFileAsCgalDid) {
  const std::string bytes = read_file(std::string(WELLSPACED_TEST_DATA) + "/meshes/bob_small.ply");
  ASSERT_EQ(detect_mesh_format(bytes), MeshFormat::ply);
  const MeshFacts facts = TriangleMesh(read_mesh(bytes, MeshFormat::ply)).facts();
  EXPECT_EQ(facts.vertices, 250u);
  EXPECT_EQ(facts.faces, 500u);
  EXPECT_EQ(facts.genus, 1u);
  EXPECT_TRUE(facts.closed);
  EXPECT_NEAR(facts.area, 5.7405957648570691, 1e-12);
  EXPECT_NEAR(facts.volume.value(), 0.67914823472227703, 1e-12);
}

TEST(ReadMesh, ReadsTheSharedFiles) {
  const char* folder = std::getenv("WELLSPACED_DATA_DIR");
  if (folder == nullptr) GTEST_SKIP() << "WELLSPACED_DATA_DIR is not set";
  std::ifstream expected(std::string(folder) + "/expected/meshes.csv");
  int meshes = 0;
  for (std::string name; std::getline(expected, name, ','); ++meshes) {
    SCOPED_TRACE(name);
    std::string vertices, faces, rest;
    std::getline(expected, vertices, ',');
    std::getline(expected, faces, ',');
    std::getline(expected, rest);
    const std::string bytes = read_file(std::string(folder) + "/meshes/" + name);
    const Triangles mesh = read_mesh(bytes, detect_mesh_format(bytes));
    EXPECT_EQ(mesh.vertices.size(), std::stoul(vertices));
    EXPECT_EQ(mesh.faces.size(), std::stoul(faces));
    const double area = std::stod(rest.substr(rest.find(",area=") + 6));
    EXPECT_NEAR(TriangleMesh(mesh).facts().area, area, 1e-12 * area);
  }
  EXPECT_EQ(meshes, 7);
}

/// Whatever the bytes are: a mesh or an Error, and soon.
TEST(ReadMesh, SurvivesDamagedFiles) {
  Rng rng(1);
  for (const std::string& whole : {tetrahedron_off, ascii_ply, binary_ply(false)})
    for (int k = 0; k < 3000; ++k) {
      std::string bytes = whole;
      for (int flips = 0; flips < 3; ++flips) {
        const char* odd = "0123456789-+.eE/\n\r \t#\xff\x80";
        bytes[rng.below(bytes.size())] =
            rng.below(2) == 0 ? odd[rng.below(23)] : static_cast<char>(rng.below(256));
      }
      for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply}) {
        try {
          const Triangles mesh = read_mesh(bytes, format);
          for (const Face& face : mesh.faces)
            for (const std::uint32_t v : face) ASSERT_LT(v, mesh.vertices.size());
        } catch (const Error&) {
        }
      }
    }
}

}  // namespace
}  // namespace wellspaced

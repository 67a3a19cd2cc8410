#pragma once

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "core/domain/triangle_mesh.h"
#include "core/math.h"

namespace wellspaced::testing {

/// The shared data that WELLSPACED_DATA_DIR names; empty if it isn't set: skip then.
inline std::string shared_data() {
  const char* folder = std::getenv("WELLSPACED_DATA_DIR");
  return folder == nullptr ? "" : folder;
}

/// Reads OFF and OBJ files of triangles that are known to be sound.
inline Triangles read_triangles(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  Triangles mesh;
  std::string line, word;
  if (path.ends_with(".obj")) {
    while (std::getline(file, line)) {
      std::istringstream words(line);
      words >> word;
      if (word == "v") {
        Vec3& v = mesh.vertices.emplace_back();
        words >> v.x >> v.y >> v.z;
      } else if (word == "f") {
        auto& face = mesh.faces.emplace_back();
        for (std::uint32_t& corner : face) {
          words >> word;
          corner = static_cast<std::uint32_t>(std::stoul(word) - 1);
        }
      }
      word.clear();
    }
    return mesh;
  }
  std::stringstream rest;
  while (std::getline(file, line)) rest << line.substr(0, line.find('#')) << '\n';
  std::size_t vertices = 0, faces = 0, edges = 0, corners = 0;
  rest >> word >> vertices >> faces >> edges;
  mesh.vertices.resize(vertices);
  mesh.faces.resize(faces);
  for (Vec3& v : mesh.vertices) rest >> v.x >> v.y >> v.z;
  for (auto& [a, b, c] : mesh.faces) {
    rest >> corners >> a >> b >> c;
    EXPECT_EQ(corners, 3u) << path;
  }
  EXPECT_TRUE(rest) << path;
  return mesh;
}

inline Triangles tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

/// Radius 1.
inline Triangles icosahedron() {
  const double s = 1 / std::sqrt(1 + 2.618033988749895), t = 1.618033988749895 * s;
  return {{{-s, t, 0},
           {s, t, 0},
           {-s, -t, 0},
           {s, -t, 0},
           {0, -s, t},
           {0, s, t},
           {0, -s, -t},
           {0, s, -t},
           {t, 0, -s},
           {t, 0, s},
           {-t, 0, -s},
           {-t, 0, s}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

/// Each face cut into four, with the new vertices moved to the unit sphere.
inline Triangles refined_sphere(Triangles mesh, int times) {
  for (; times > 0; --times) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    Triangles finer{mesh.vertices, {}};
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), finer.vertices.size());
      if (is_new) {
        const Vec3 m = mesh.vertices[a] + mesh.vertices[b];
        finer.vertices.push_back((1 / norm(m)) * m);
      }
      return at->second;
    };
    for (const auto& [a, b, c] : mesh.faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.faces.insert(finer.faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh = std::move(finer);
  }
  return mesh;
}

/// [0, size]^2 at height z(x, y), as n x n squares of two faces each.
template <class Height>
Triangles height_field(std::uint32_t n, double size, const Height& z) {
  Triangles mesh;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = size * i / n, y = size * j / n;
      mesh.vertices.push_back({x, y, z(x, y)});
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = c - 1;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  return mesh;
}

inline Triangles flat_square(std::uint32_t n) {
  return height_field(n, 1, [](double, double) { return 0.0; });
}

/// The band around the z axis of radius 1 and height 1 that has two borders.
inline Triangles open_cylinder(std::uint32_t n) {
  Triangles mesh;
  for (std::uint32_t level = 0; level < 2; ++level)
    for (std::uint32_t k = 0; k < n; ++k) {
      const CosSin turn = portable_cos_sin(k, n);
      mesh.vertices.push_back({turn.cos, turn.sin, static_cast<double>(level)});
    }
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    mesh.faces.push_back({k, next, n + next});
    mesh.faces.push_back({k, n + next, n + k});
  }
  return mesh;
}

}  // namespace wellspaced::testing

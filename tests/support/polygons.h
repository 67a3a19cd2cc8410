#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/domain/domain.h"
#include "core/rng.h"
#include "core/vec.h"

namespace wellspaced::testing {

using Ring = std::vector<Vec2>;
using Rings = std::vector<Ring>;

inline Ring rectangle(Vec2 low, Vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

inline Rings square_with_hole() { return {rectangle({0, 0}, {1, 1}), rectangle({0.25, 0.25}, {0.75, 0.5})}; }

inline Rings l_shape() { return {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}; }

inline Vec2 on_circle(Vec2 center, double radius, double angle_rad) {
  return center + radius * Vec2{std::cos(angle_rad), std::sin(angle_rad)};
}

inline Ring circle(Vec2 center, double radius, std::size_t n) {
  Ring ring;
  for (std::size_t i = 0; i < n; ++i)
    ring.push_back(
        on_circle(center, radius, 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n)));
  return ring;
}

/// Seen whole from its center; radii at random from `least` to 1.
inline Ring star(std::size_t n, std::uint64_t seed, double least = 0.2) {
  Rng rng(seed);
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle =
        2 * std::numbers::pi * (static_cast<double>(i) + 0.9 * rng.uniform()) / static_cast<double>(n);
    ring.push_back(on_circle({0, 0}, least + (1 - least) * rng.uniform(), angle));
  }
  return ring;
}

/// Teeth that are 1 long, on a back that is .1 thick; n of them and n - 1 gaps, all equally wide.
inline Ring comb(std::size_t n) {
  Ring ring;
  const double width = 1.0 / static_cast<double>(2 * n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double left = 2 * static_cast<double>(i) * width;
    if (i > 0) ring.push_back({left, 0.1});
    ring.insert(ring.end(), {{left, 1.1}, {left + width, 1.1}});
    if (i + 1 < n) ring.push_back({left + width, 0.1});
  }
  ring.insert(ring.end(), {{1, 0}, {0, 0}});
  return ring;
}

inline Rings moved(Rings rings, double scale, Vec2 by) {
  for (Ring& ring : rings)
    for (Vec2& p : ring) p = scale * p + by;
  return rings;
}

inline Rings turned(Rings rings, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  for (Ring& ring : rings)
    for (Vec2& p : ring) p = {c * p.x - s * p.y, s * p.x + c * p.y};
  return rings;
}

/// Twice the signed area.
inline long double shoelace(const Ring& ring) {
  long double sum = 0;
  const auto local = [&](std::size_t i) {
    return std::pair{static_cast<long double>(ring[i].x) - ring[0].x,
                     static_cast<long double>(ring[i].y) - ring[0].y};
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto [ax, ay] = local(i);
    const auto [bx, by] = local((i + 1) % ring.size());
    sum += ax * by - ay * bx;
  }
  return sum;
}

inline double area_of(const Rings& rings) {
  long double area = 0;
  for (std::size_t k = 0; k < rings.size(); ++k)
    area += (k == 0 ? 0.5L : -0.5L) * std::abs(shoelace(rings[k]));
  return static_cast<double>(area);
}

inline double area_of_pieces(const ChartPieces& pieces) {
  double twice = 0;
  for (std::size_t k = 0; k < pieces.ends.size(); ++k)
    for (std::size_t i = 2; i < pieces[k].size(); ++i)
      twice += cross(pieces[k][i - 1] - pieces[k][0], pieces[k][i] - pieces[k][0]);
  return twice / 2;
}

/// Polygons of many kinds: round, jagged, thin, with holes, far from the origin, tiny and large.
inline std::vector<std::pair<std::string, Rings>> many_polygons() {
  std::vector<std::pair<std::string, Rings>> all = {
      {"square", {rectangle({0, 0}, {1, 1})}},
      {"square with hole", square_with_hole()},
      {"l", l_shape()},
      {"triangle", {{{0.1, 0.2}, {0.1 + 0.2, 0.7}, {1.3, 0.3}}}},
      {"star 7", {star(7, 1)}},
      {"star 100", {star(100, 2)}},
      {"star 1000", {star(1000, 3, 0.7)}},
      {"circle", {circle({0, 0}, 1, 300)}},
      {"ring", {circle({0, 0}, 1, 100), circle({0.05, 0}, 0.9, 77)}},
      {"comb", {comb(12)}},
      {"needle", {{{0, 0}, {1, 0.1}, {1, 0.1 + 1e-9}}}},
      {"long", {rectangle({-500, 0}, {499, 1})}},
      {"sharp corners", {{{0, 0}, {1, 1e-6}, {2, 0}, {1, 1}}}},
  };
  all.push_back({"turned l", turned(l_shape(), 0.3)});
  all.push_back({"turned comb", turned({comb(12)}, 1)});
  all.push_back({"far", moved({star(50, 4), circle({0, 0}, 0.1, 20)}, 1, {1e6, -1e6})});
  all.push_back({"tiny and far", moved({star(50, 5), circle({0, 0}, 0.1, 20)}, 1e-5, {3, 1e4})});
  all.push_back({"large", moved({star(50, 6), circle({0, 0}, 0.1, 20)}, 4e5, {0, 0})});
  all.push_back({"tiny", moved({star(50, 7)}, 1e-6, {0, 0})});
  Rings holes = {rectangle({0, 0}, {1, 1})};
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j)
      holes.push_back(moved({star(9, 100 + i * 9 + j)}, 0.045, {0.1 + i * 0.1, 0.1 + j * 0.1})[0]);
  all.push_back({"81 holes", holes});
  return all;
}

}  // namespace wellspaced::testing

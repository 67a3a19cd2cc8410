// StarMesh: points taken out and put in.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/voronoi/star_mesh.h"

namespace wellspaced {
namespace {

/// The hole that a point leaves: its neighbors counter-clockwise, as seen from it.
struct Hole {
  struct Corner {
    std::uint32_t id = 0;
    Vec2 at;
    int degree = 0;
  };
  std::array<Corner, Star::most> corner;
  int size = 0;

  int after(int k) const { return k + 1 == size ? 0 : k + 1; }
  int before(int k) const { return k == 0 ? size - 1 : k - 1; }
  void erase(int k) {
    --size;
    for (int j = k; j < size; ++j)
      corner[static_cast<std::size_t>(j)] = corner[static_cast<std::size_t>(j + 1)];
  }
  const Corner& operator[](int k) const { return corner[static_cast<std::size_t>(k)]; }
  Corner& operator[](int k) { return corner[static_cast<std::size_t>(k)]; }
};

/// Positive if d is outside the circle through a, b, c (counter-clockwise), negative inside.
double out_of_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Vec2 u = b - a, v = c - a, w = d - a;
  const double u2 = norm2(u), v2 = norm2(v);
  return norm2(w) * cross(u, v) - w.x * (v.y * u2 - u.y * v2) - w.y * (u.x * v2 - v.x * u2);
}

/// How far the other corners are out of the circle around ear k; nothing if k is no ear.
std::optional<double> clearance(const Hole& hole, int k) {
  const int before = hole.before(k), after = hole.after(k);
  const Vec2 a = hole[before].at, b = hole[k].at, c = hole[after].at;
  if (!(cross(b - a, c - a) > 0)) return {};
  double least = std::numeric_limits<double>::infinity();
  for (int j = hole.after(after); j != before; j = hole.after(j))
    least = std::min(least, out_of_circle(a, b, c, hole[j].at));
  return least;
}

/// The ear that belongs to the Delaunay triangulation, or comes nearest to it; the hole's size if none.
int best_ear(const Hole& hole) {
  int best = hole.size;
  double most = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < hole.size; ++k) {
    const std::optional<double> clear = clearance(hole, k);
    if (!clear || !(*clear > most)) continue;
    most = *clear;
    best = k;
  }
  return best;
}

}  // namespace

bool StarMesh::remove(std::size_t i) {
  Hole hole;
  hole.size = stars_[i].degree;
  for (int k = 0; k < hole.size; ++k) {
    const std::uint32_t j = stars_[i].neighbor[k];
    hole[k] = {j, offset(i, j), stars_[j].degree};
  }
  std::array<std::uint32_t, Star::most> ears;  // first all of them, since a half-filled hole is hard to undo
  std::size_t count = 0;
  while (hole.size > 3) {
    const int k = best_ear(hole);
    if (k == hole.size) return false;
    Hole::Corner &before = hole[hole.before(k)], &after = hole[hole.after(k)];
    if (!is_short_way(after.at - before.at)) return false;
    if (stars_[before.id].find(after.id) < stars_[before.id].degree) return false;
    if (++before.degree > Star::most || ++after.degree > Star::most) return false;
    ears[count++] = hole[k].id;
    hole.erase(k);
  }
  if (!(cross(hole[1].at - hole[0].at, hole[2].at - hole[0].at) > 0)) return false;
  for (int k = 0; k < 3; ++k)
    if (hole[k].degree <= 3) return false;
  Suspects suspects{everywhere()};
  for (std::size_t e = 0; e < count; ++e)
    flip(static_cast<std::uint32_t>(i), stars_[i].find(ears[e]), suspects);
  for (int k = 0; k < 3; ++k)
    stars_[hole[k].id].erase(stars_[hole[k].id].find(static_cast<std::uint32_t>(i)));
  stars_[i].degree = 0;
  legalize(suspects);
  return true;
}

/// The point nearest to a place: always on to the nearest of a point's neighbors, which in a Delaunay
/// triangulation never ends elsewhere.
std::size_t StarMesh::nearest(FixedPoint place, std::size_t from) const {
  double best = norm2(way(at_[from], place));
  for (std::size_t here = from;; here = from) {
    const Star& star = stars_[here];
    for (int k = 0; k < star.degree; ++k) {
      const double distance2 = norm2(way(at_[star.neighbor[k]], place));
      if (!(distance2 < best)) continue;
      best = distance2;
      from = star.neighbor[k];
    }
    if (from == here) return here;
  }
}

/// The triangle, counter-clockwise, that holds a place, which is not far from the point `near`: a walk over
/// edges that have it on their other side. Nothing if rounding makes it go in circles.
std::optional<std::array<std::uint32_t, 3>> StarMesh::triangle_at(FixedPoint place, std::size_t near) const {
  constexpr int most_steps = 1000;
  std::array<std::uint32_t, 3> t = {static_cast<std::uint32_t>(near), stars_[near].neighbor[0],
                                    stars_[near].neighbor[1]};
  for (int steps = 0; steps < most_steps; ++steps) {
    std::size_t k = 0;
    while (k < 3 && cross(offset(t[k], t[(k + 1) % 3]), way(at_[t[k]], place)) >= 0) ++k;
    if (k == 3) return t;
    const std::uint32_t a = t[k], b = t[(k + 1) % 3];
    t = {b, a, stars_[a].neighbor[stars_[a].before(stars_[a].find(b))]};
  }
  return {};
}

bool StarMesh::insert(std::size_t i, FixedPoint place, std::size_t near) {
  const auto triangle = triangle_at(place, nearest(place, near));
  if (!triangle) return false;
  const auto [a, b, c] = *triangle;
  for (const std::uint32_t v : *triangle)
    if (stars_[v].degree == Star::most) return false;
  const auto self = static_cast<std::uint32_t>(i);
  at_[i] = place;
  stars_[a].insert_after(stars_[a].find(b), self);
  stars_[b].insert_after(stars_[b].find(c), self);
  stars_[c].insert_after(stars_[c].find(a), self);
  Star& star = stars_[i];
  star.degree = 3;
  for (int k = 0; k < Star::most; ++k) star.neighbor[k] = k == 1 ? b : k == 2 ? c : a;
  Suspects suspects{everywhere()};
  suspects.add(a, b);
  suspects.add(b, c);
  suspects.add(c, a);
  legalize(suspects);
  return true;
}

bool StarMesh::is_delaunay_at(std::size_t i) const {
  constexpr double rounding = 1e-7;
  const Star& star = stars_[i];
  for (int k = 0; k < star.degree; ++k) {
    const std::uint32_t a = star.neighbor[k], b = star.neighbor[star.after(k)];
    const Vec2 to_a = offset(i, a), to_b = offset(i, b);
    const std::uint32_t beyond = stars_[a].neighbor[stars_[a].before(stars_[a].find(b))];
    const Vec2 to_beyond = to_a + offset(a, beyond);
    if (!(cross(to_a, to_b) > 0) || !is_short_way(to_b - to_a)) return false;
    if (out_of_circle({0, 0}, to_a, to_b, to_beyond) < -rounding) return false;
  }
  return true;
}

}  // namespace wellspaced

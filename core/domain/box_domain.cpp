#include "core/domain/box_domain.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/domain/torus.h"

namespace wellspaced {
namespace {

/// As much of the move d of x, which is inside, as leaves it well inside: at most this part of the way.
double inside(double x, double d, double side) {
  constexpr double most = 0.75;
  const double room = d < 0 ? x : side - x;
  return std::clamp(d, -most * room, most * room);
}

/// Only the ends are corners.
double between_corners(double x, double side) {
  return x <= 0 ? 0 : x >= side ? side : std::clamp(x, std::nextafter(0.0, 1.0), std::nextafter(side, 0.0));
}

}  // namespace

BoxDomain::BoxDomain(double width, double height, std::array<bool, 2> periodic)
    : size_{width, height}, periodic_(periodic) {
  require_sides(width, height);
}

double BoxDomain::boundary_length() const {
  return (periodic_[1] ? 0 : 2 * size_[0]) + (periodic_[0] ? 0 : 2 * size_[1]);
}

Box BoxDomain::box() const {
  return {{0, 0, 0}, {size_[0], size_[1], 0}, {periodic_[0], periodic_[1], false}};
}

double BoxDomain::distance(Vec3 p, Vec3 q) const {
  const Vec2 d{q.x - p.x, q.y - p.y};
  return norm(Vec2{periodic_[0] ? wrap_difference(d.x, size_[0]) : d.x,
                   periodic_[1] ? wrap_difference(d.y, size_[1]) : d.y});
}

std::optional<std::string> BoxDomain::why_outside(Vec3 p) const {
  const double c[2] = {p.x, p.y};
  bool is_inside = true;
  for (std::size_t a = 0; a < 2; ++a)
    is_inside = is_inside && c[a] >= 0 && (periodic_[a] ? c[a] < size_[a] : c[a] <= size_[a]);
  if (is_inside) return {};
  std::ostringstream text;
  text.precision(17);
  text << "point (" << p.x << ", " << p.y << ") is outside the "
       << (periodic_[0] || periodic_[1] ? "strip" : "box");
  for (std::size_t a = 0; a < 2; ++a)
    text << (a == 0 ? " " : " x ") << "[0, " << size_[a] << (periodic_[a] ? ")" : "]");
  text << "; move it inside" << (periodic_[0] || periodic_[1] ? ", or wrap it along the periodic axis" : "");
  return text.str();
}

Vec3 BoxDomain::random_point(Rng& rng) const {
  double c[2];
  for (std::size_t a = 0; a < 2; ++a) {
    do c[a] = rng.uniform() * size_[a];
    while (at_side(a, c[a]) || c[a] >= size_[a]);
  }
  return {c[0], c[1], 0};
}

Freedom BoxDomain::freedom(Vec3 p) const {
  const bool side_x = at_side(0, p.x), side_y = at_side(1, p.y);
  if (side_x && side_y) return {0};
  if (side_x) return {1, {0, 1}};
  if (side_y) return {1, {1, 0}};
  return {};
}

Vec2 BoxDomain::possible(Vec3 p, Vec2 u) const {
  const double c[2] = {p.x, p.y};
  double d[2] = {u.x, u.y};
  for (std::size_t a = 0; a < 2; ++a) {
    if (periodic_[a]) continue;
    d[a] = at_side(a, c[a]) ? 0 : inside(c[a], d[a], size_[a]);
  }
  return {d[0], d[1]};
}

Vec3 BoxDomain::step(Vec3 p, Vec2 u) const {
  const double from[2] = {p.x, p.y}, d[2] = {u.x, u.y};
  double to[2];
  for (std::size_t a = 0; a < 2; ++a) {
    if (periodic_[a])
      to[a] = wrap(from[a] + d[a], size_[a]);
    else
      to[a] = at_side(a, from[a])
                  ? from[a]
                  : std::clamp(from[a] + d[a], std::nextafter(0.0, 1.0), std::nextafter(size_[a], 0.0));
  }
  return {to[0], to[1], 0};
}

Vec3 BoxDomain::place_at(Vec3 p, Vec2 u) const {
  const Vec2 at{p.x + u.x, p.y + u.y};
  return {periodic_[0] ? wrap(at.x, size_[0]) : std::clamp(at.x, 0.0, size_[0]),
          periodic_[1] ? wrap(at.y, size_[1]) : std::clamp(at.y, 0.0, size_[1]), 0};
}

bool BoxDomain::holds(Vec3 p, Vec2 u) const {
  const double to[2] = {p.x + u.x, p.y + u.y};
  const auto within = [&](std::size_t a) { return periodic_[a] || (to[a] >= 0 && to[a] <= size_[a]); };
  return within(0) && within(1);
}

void BoxDomain::bisectors(Vec3, Vec2 u, std::span<const Neighbor> neighbors, std::span<HalfPlane> out) const {
  flat_bisectors(u, neighbors, out);
}

bool BoxDomain::pieces(Vec3 base, double reach, ChartPieces& out) const {
  const double c[2] = {base.x, base.y};
  double low[2], high[2];
  bool cut = false;
  for (std::size_t a = 0; a < 2; ++a) {
    low[a] = periodic_[a] ? -2 * reach : std::max(-c[a], -2 * reach);
    high[a] = periodic_[a] ? 2 * reach : std::min(size_[a] - c[a], 2 * reach);
    cut = cut || (!periodic_[a] && (c[a] < reach || size_[a] - c[a] < reach));
  }
  if (!cut) return false;
  out.clear();
  out.corners = {{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}};
  out.close();
  return true;
}

std::vector<BoundaryCurve> BoxDomain::boundary() const {
  const double w = size_[0], h = size_[1];
  if (periodic_[0]) return {{w, true}, {w, true}};
  if (periodic_[1]) return {{h, true}, {h, true}};
  return {{w}, {h}, {w}, {h}};
}

Vec3 BoxDomain::boundary_point(std::size_t curve, double along) const {
  const double w = size_[0], h = size_[1];
  if (periodic_[0]) return {wrap(along, w), curve == 0 ? 0 : h, 0};
  if (periodic_[1]) return {curve == 0 ? 0 : w, wrap(along, h), 0};
  switch (curve) {
    case 0:
      return {between_corners(along, w), 0, 0};
    case 1:
      return {w, between_corners(along, h), 0};
    case 2:
      return {between_corners(w - along, w), h, 0};
    default:
      return {0, between_corners(h - along, h), 0};
  }
}

std::optional<BoundarySpot> BoxDomain::boundary_spot(Vec3 p) const {
  if (freedom(p).dimensions != 1) return std::nullopt;
  if (periodic_[0]) return BoundarySpot{p.y == 0 ? 0u : 1u, p.x};
  if (periodic_[1]) return BoundarySpot{p.x == 0 ? 0u : 1u, p.y};
  if (p.y == 0) return BoundarySpot{0, p.x};
  if (p.x == size_[0]) return BoundarySpot{1, p.y};
  return p.y == size_[1] ? BoundarySpot{2, size_[0] - p.x} : BoundarySpot{3, size_[1] - p.y};
}

std::optional<Vec3> BoxDomain::boundary_point_at(Vec3 p) const {
  constexpr double tolerance = 1e-12;
  double c[2] = {p.x, p.y};
  bool found = false;
  for (std::size_t a = 0; a < 2; ++a) {
    if (periodic_[a]) continue;
    for (const double side : {0.0, size_[a]}) {
      if (std::fabs(c[a] - side) > tolerance * size_[a]) continue;
      c[a] = side;
      found = true;
    }
  }
  if (!found) return std::nullopt;
  for (std::size_t a = 0; a < 2; ++a)
    if (periodic_[a]) c[a] = wrap(c[a], size_[a]);
  return Vec3{c[0], c[1], 0};
}

std::vector<DomainTriangle> BoxDomain::triangles() const { return halves_of_rectangle(size_[0], size_[1]); }

}  // namespace wellspaced

#include "core/domain/sphere.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.h"
#include "core/math.h"

namespace wellspaced {
namespace {

Vec3 unit(Vec3 p) { return (1 / norm(p)) * p; }

/// Angle between unit vectors.
double angle(Vec3 p, Vec3 q) { return 2 * portable_atan2(norm(p - q), norm(p + q)); }

struct Frame {
  Vec3 e1, e2;

  /// Of the tangent plane at a unit vector, counter-clockwise seen from outside. Reference: Duff et al.,
  /// "Building an Orthonormal Basis, Revisited", 2017.
  explicit Frame(Vec3 p) {
    const double sign = std::copysign(1.0, p.z), a = -1 / (sign + p.z), b = p.x * p.y * a;
    e1 = {1 + sign * p.x * p.x * a, sign * b, -sign * p.x};
    e2 = {b, sign + p.y * p.y * a, -p.y};
  }

  Vec2 coordinates(Vec3 v) const { return {dot(v, e1), dot(v, e2)}; }
};

/// Longest way that the chart has room for, as an angle: short of a quarter turn, where it ends.
constexpr double widest = 1.57;

double tangent(double angle_rad) {
  const CosSin c = portable_cos_sin(angle_rad / (2 * pi));
  return c.sin / c.cos;
}

}  // namespace

Sphere::Sphere(double radius) : radius_(radius) {
  if (!(radius >= min_radius && radius <= max_radius))
    throw Error(ErrorCode::invalid_parameters, "a sphere's radius must be a number from 1e-6 to 1e6",
                "/radius");
}

double Sphere::chord(double arc) const {
  return 2 * radius_ * portable_cos_sin(std::min(arc / radius_, pi) / (4 * pi)).sin;
}

double Sphere::arc(double chord) const {
  const double half = std::min(0.5 * chord / radius_, 1.0);
  return 2 * radius_ * portable_atan2(half, std::sqrt((1 - half) * (1 + half)));
}

double Sphere::farthest() const { return pi * radius_; }

double Sphere::area() const { return 4 * pi * radius_ * radius_; }

Box Sphere::box() const {
  return {{-radius_, -radius_, -radius_}, {2 * radius_, 2 * radius_, 2 * radius_}, {}};
}

Vec3 Sphere::onto(Vec3 p) const { return (radius_ / norm(p)) * p; }

double Sphere::distance(Vec3 p, Vec3 q) const { return radius_ * angle(unit(p), unit(q)); }

std::optional<std::string> Sphere::why_outside(Vec3 p) const {
  constexpr double tolerance = 1e-9;
  const double from_center = norm(p);
  if (std::fabs(from_center - radius_) <= tolerance * radius_) return {};
  std::ostringstream text;
  text.precision(17);
  text << "point (" << p.x << ", " << p.y << ", " << p.z << ") is not on the sphere of radius " << radius_
       << " around the origin, but " << from_center << " from there; scale it to that";
  return text.str();
}

Vec3 Sphere::random_point(Rng& rng) const {
  const double z = 2 * rng.uniform() - 1, turns = rng.uniform();  // slices of equal height have equal area
  const CosSin c = portable_cos_sin(turns);
  const double r = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
  return onto({r * c.cos, r * c.sin, z});
}

Vec3 Sphere::step(Vec3 p, Vec2 u) const {
  const double length = norm(u);
  if (length == 0) return p;
  const Vec3 here = unit(p);
  const Frame frame(here);
  const CosSin c = portable_cos_sin(length / (2 * pi * radius_));
  return onto(c.cos * here + (c.sin / length) * (u.x * frame.e1 + u.y * frame.e2));
}

void Sphere::bisectors(Vec3 base, Vec2 u, std::span<const Neighbor> neighbors,
                       std::span<HalfPlane> out) const {
  const Vec3 candidate = unit(step(base, u));
  const Frame frame(candidate);
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    const Vec3 d = unit(base + neighbors[k].offset) - candidate;
    out[k] = {frame.coordinates(d), 0.5 * norm2(d) * radius_};
  }
}

double Sphere::chart_to_distance(double u) const { return radius_ * portable_atan2(u, radius_); }

double Sphere::distance_to_chart(double distance) const {
  return radius_ * tangent(std::min(distance / radius_, widest));
}

double Sphere::horizon() const { return radius_ * pi / 2; }

Vec2 Sphere::way_to(Vec3 base, const Neighbor& neighbor) const {
  const Vec3 here = unit(base), there = unit(base + neighbor.offset);
  const Vec2 t = Frame(here).coordinates(there - here);
  const double length = norm(t), way = radius_ * angle(here, there);
  return length == 0 ? Vec2{way, 0} : (way / length) * t;  // any way leads to the other end of the world
}

/// Reference for the area: Van Oosterom and Strackee, 1983; for the mean: half the sum of the edges' angles
/// times the normals of their planes, which follows from Stokes' theorem. `second` is of the chord.
PolygonMoments Sphere::moments(std::span<const Vec2> polygon) const {
  const double r = radius_;
  double area = 0;
  Vec3 sum;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = (1 / r) * polygon[k], b = (1 / r) * polygon[k + 1 == polygon.size() ? 0 : k + 1];
    const double la = std::sqrt(1 + norm2(a)), lb = std::sqrt(1 + norm2(b)), twice = cross(a, b);
    area += 2 * portable_atan2(twice, la * lb + la + lb + 1 + dot(a, b));
    const Vec3 normal{a.y - b.y, b.x - a.x, twice};
    const double length = norm(normal);
    if (length > 0) sum = sum + (0.5 * portable_atan2(length, 1 + dot(a, b)) / length) * normal;
  }
  PolygonMoments moments;
  moments.area = r * r * area;
  const double t = norm(Vec2{sum.x, sum.y});
  if (t > 0) moments.first = (moments.area * r * portable_atan2(t, sum.z) / t) * Vec2{sum.x, sum.y};
  moments.second = 2 * r * r * r * r * (area - sum.z);
  return moments;
}

std::vector<DomainTriangle> Sphere::triangles() const {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const Vec3 v[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  constexpr int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  std::vector<DomainTriangle> triangles;
  for (const auto& face : faces) triangles.push_back({onto(v[face[0]]), onto(v[face[1]]), onto(v[face[2]])});
  return triangles;
}

Vec3 Sphere::middle(Vec3 p, Vec3 q) const { return onto(p + q); }

double Sphere::area_of(const DomainTriangle& t) const {
  const Vec3 a = unit(t[0]), b = unit(t[1]), c = unit(t[2]);
  const double volume = dot(a, cross(b - a, c - a));
  return radius_ * radius_ * 2 * portable_atan2(volume, 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// The flat triangle's points are projected; as many are dropped as the sphere is nearer there.
Vec3 Sphere::random_point_in(const DomainTriangle& t, Rng& rng) const {
  const Vec3 normal = unit(cross(t[1] - t[0], t[2] - t[0]));
  const double height = dot(normal, t[0]);
  for (;;) {
    const Vec3 p = Domain::random_point_in(t, rng);
    const double ratio = height / norm(p);
    if (rng.uniform() < ratio * ratio * ratio) return onto(p);
  }
}

}  // namespace wellspaced

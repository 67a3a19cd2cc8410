#include "core/domain/torus.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.h"

namespace wellspaced {
namespace {

void require_side(double side, const char* where) {
  if (!std::isfinite(side) || side < Torus::min_side || side > Torus::max_side)
    throw Error(ErrorCode::invalid_parameters,
                "a side must be a number from 1e-6 to 1e6; choose another unit of length", where);
}

}  // namespace

void require_sides(double width, double height) {
  require_side(width, "/width");
  require_side(height, "/height");
  if (std::max(width, height) > Torus::max_aspect * std::min(width, height))
    throw Error(ErrorCode::invalid_parameters,
                "the longer side is more than 1000 times the shorter one; use a less elongated torus",
                width < height ? "/height" : "/width");
}

double wrap(double x, double period) {
  if (x >= 0 && x < period) return x;
  x = std::fmod(x, period);  // exact
  if (x < 0) x += period;
  return x >= period ? 0.0 : x;
}

double wrap_difference(double d, double period) {
  if (d > period / 2) return d - period;
  if (d < -period / 2) return d + period;
  return d;
}

Torus::Torus(double width, double height) : width_(width), height_(height) { require_sides(width, height); }

double Torus::distance(Vec3 p, Vec3 q) const {
  return norm(Vec2{wrap_difference(q.x - p.x, width_), wrap_difference(q.y - p.y, height_)});
}

std::optional<std::string> Torus::why_outside(Vec3 p) const {
  if (p.x >= 0 && p.x < width_ && p.y >= 0 && p.y < height_) return {};
  std::ostringstream text;
  text.precision(17);
  text << "point (" << p.x << ", " << p.y << ") is outside the torus [0, " << width_ << ") x [0, " << height_
       << "); both intervals are half-open, so wrap coordinates first";
  return text.str();
}

Vec3 Torus::random_point(Rng& rng) const {
  const double x = rng.uniform() * width_;  // draw in this order: an initializer list would do, but say it
  const double y = rng.uniform() * height_;
  // u < 1 does not keep u * side from rounding up to side.
  return {wrap(x, width_), wrap(y, height_), 0};
}

Vec3 Torus::step(Vec3 p, Vec2 u) const { return {wrap(p.x + u.x, width_), wrap(p.y + u.y, height_), 0}; }

void Torus::bisectors(Vec3, Vec2 u, std::span<const Neighbor> neighbors, std::span<HalfPlane> out) const {
  flat_bisectors(u, neighbors, out);
}

std::vector<DomainTriangle> Torus::triangles() const { return halves_of_rectangle(width_, height_); }

std::vector<DomainTriangle> halves_of_rectangle(double width, double height) {
  const Vec3 a{0, 0, 0}, b{width, 0, 0}, c{width, height, 0}, d{0, height, 0};
  return {{a, b, c}, {a, c, d}};
}

}  // namespace wellspaced

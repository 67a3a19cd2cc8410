#include "core/domain/domain.h"

#include <cmath>

#include "core/point_set.h"

namespace wellspaced {

double Domain::area_of(const DomainTriangle& t) const { return 0.5 * norm(cross(t[1] - t[0], t[2] - t[0])); }

void Domain::distances(Vec3 base, double reach, std::span<const Neighbor> neighbors,
                       std::vector<double>& out) const {
  out.clear();
  for (const Neighbor& neighbor : neighbors) {
    const double distance = norm(way_to(base, neighbor));
    out.push_back(distance <= reach ? distance : HUGE_VAL);
  }
}

PolygonMoments Domain::moments(std::span<const Vec2> polygon) const {
  PolygonMoments sum;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k], b = polygon[k + 1 == polygon.size() ? 0 : k + 1];
    const double twice = cross(a, b);  // of the triangle between the origin and the edge
    sum.area += twice / 2;
    sum.first = sum.first + (twice / 6) * (a + b);
    sum.second += twice / 12 * (norm2(a) + dot(a, b) + norm2(b));
  }
  return sum;
}

Vec3 Domain::random_point_in(const DomainTriangle& t, Rng& rng) const {
  double a = rng.uniform(), b = rng.uniform();
  if (a + b > 1) {  // the other half of the parallelogram
    a = 1 - a;
    b = 1 - b;
  }
  return t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
}

void flat_bisectors(Vec2 u, std::span<const Neighbor> neighbors, std::span<HalfPlane> out) {
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    const Vec2 d{neighbors[k].offset.x - u.x, neighbors[k].offset.y - u.y};
    out[k] = {d, norm2(d) / 2};
  }
}

double hexagonal_spacing(const Domain& domain, std::size_t n) {
  if (domain.boundary_length() == 0) return hexagonal_spacing(domain.area(), n);
  const double inside = 2 * domain.area() / std::sqrt(3.0), rim = domain.boundary_length() / 2;
  const auto count = static_cast<double>(n);
  return (rim + std::sqrt(rim * rim + 4 * count * inside)) / (2 * count);
}

}  // namespace wellspaced

#pragma once

#include "core/domain/domain.h"

namespace wellspaced {

/// The sphere of a radius around the origin; distances are geodesic, along great circles.
///
/// The chart at p is gnomonic: y stands for p + u, u orthogonal to p, brought back to the sphere. Bisectors
/// are exact straight lines there; it holds the open hemisphere around p. The frame of a point depends on
/// the point alone. Points are on the sphere if they are within 1e-9 of its radius from it.
///
/// Errors of the constructor: invalid_parameters at /radius for one that is not within [min_radius,
/// max_radius].
class Sphere final : public Domain {
 public:
  static constexpr double min_radius = 1e-6, max_radius = 1e6;

  explicit Sphere(double radius = 1);

  double radius() const { return radius_; }
  double chord(double arc) const;  ///< straight distance of points so far apart on the sphere
  double arc(double chord) const;

  std::string_view type() const override { return "sphere"; }
  int dimension() const override { return 3; }
  double area() const override;
  int euler_characteristic() const override { return 2; }
  Box box() const override;
  double farthest() const override;
  bool is_flat() const override { return false; }
  double distance(Vec3 p, Vec3 q) const override;
  std::optional<std::string> why_outside(Vec3 p) const override;
  Vec3 random_point(Rng& rng) const override;
  Vec3 step(Vec3 p, Vec2 u) const override;
  void bisectors(Vec3 base, Vec2 u, std::span<const Neighbor> neighbors,
                 std::span<HalfPlane> out) const override;
  double chart_to_distance(double u) const override;
  double distance_to_chart(double distance) const override;
  double horizon() const override;
  Vec2 way_to(Vec3 base, const Neighbor& neighbor) const override;
  PolygonMoments moments(std::span<const Vec2> polygon) const override;
  std::vector<DomainTriangle> triangles() const override;
  Vec3 middle(Vec3 p, Vec3 q) const override;
  double area_of(const DomainTriangle& triangle) const override;
  Vec3 random_point_in(const DomainTriangle& triangle, Rng& rng) const override;

 private:
  Vec3 onto(Vec3 p) const;

  double radius_;
};

}  // namespace wellspaced

#pragma once

#include "core/domain/domain.h"

namespace wellspaced {

/// A rectangle [0, width] x [0, height] that is bounded along one axis or both, and periodic along the other:
/// a strip or a box. Along a periodic axis the interval is half-open.
///
/// Points whose coordinate along a bounded axis is 0 or the side, exactly, are on the boundary. A box has
/// four corners; a strip none, its two sides are closed curves.
///
/// Errors of the constructor: those of Torus. Requires: not periodic along both axes, for that is a Torus.
class BoxDomain final : public Domain {
 public:
  explicit BoxDomain(double width = 1, double height = 1, std::array<bool, 2> periodic = {});

  std::array<bool, 2> periodic() const { return periodic_; }

  std::string_view type() const override { return "box"; }
  int dimension() const override { return 2; }
  double area() const override { return size_[0] * size_[1]; }
  double boundary_length() const override;
  int euler_characteristic() const override { return periodic_[0] || periodic_[1] ? 0 : 1; }
  Box box() const override;
  double distance(Vec3 p, Vec3 q) const override;
  std::optional<std::string> why_outside(Vec3 p) const override;
  Vec3 random_point(Rng& rng) const override;
  Freedom freedom(Vec3 p) const override;
  Vec2 possible(Vec3 p, Vec2 u) const override;
  Vec3 step(Vec3 p, Vec2 u) const override;
  Vec3 place_at(Vec3 p, Vec2 u) const override;
  bool holds(Vec3 p, Vec2 u) const override;
  void bisectors(Vec3 base, Vec2 u, std::span<const Neighbor> neighbors,
                 std::span<HalfPlane> out) const override;
  double chart_to_distance(double u) const override { return u; }
  bool pieces(Vec3 base, double reach, ChartPieces& out) const override;
  std::vector<BoundaryCurve> boundary() const override;
  Vec3 boundary_point(std::size_t curve, double along) const override;
  std::optional<BoundarySpot> boundary_spot(Vec3 p) const override;
  std::optional<Vec3> boundary_point_at(Vec3 p) const override;
  std::vector<DomainTriangle> triangles() const override;

 private:
  bool at_side(std::size_t axis, double x) const { return !periodic_[axis] && (x == 0 || x == size_[axis]); }

  std::array<double, 2> size_;
  std::array<bool, 2> periodic_;
};

}  // namespace wellspaced

#pragma once

#include "core/domain/domain.h"

namespace wellspaced {

/// The flat torus [0, width) x [0, height): a rectangle whose opposite sides are the same.
///
/// Errors of the constructor: invalid_parameters at /width or /height for sides that are not finite, not
/// within [min_side, max_side], or with a ratio above max_aspect.
class Torus final : public Domain {
 public:
  static constexpr double min_side = 1e-6, max_side = 1e6, max_aspect = 1000;

  explicit Torus(double width = 1, double height = 1);

  double width() const { return width_; }
  double height() const { return height_; }

  std::string_view type() const override { return "torus"; }
  int dimension() const override { return 2; }
  double area() const override { return width_ * height_; }
  int euler_characteristic() const override { return 0; }
  Box box() const override { return {{0, 0, 0}, {width_, height_, 0}, {true, true, false}}; }
  double distance(Vec3 p, Vec3 q) const override;
  std::optional<std::string> why_outside(Vec3 p) const override;
  Vec3 random_point(Rng& rng) const override;
  Vec3 step(Vec3 p, Vec2 u) const override;
  void bisectors(Vec3 base, Vec2 u, std::span<const Neighbor> neighbors,
                 std::span<HalfPlane> out) const override;
  double chart_to_distance(double u) const override { return u; }
  std::vector<DomainTriangle> triangles() const override;

 private:
  double width_, height_;
};

inline bool is_torus(const Domain& domain) { return dynamic_cast<const Torus*>(&domain) != nullptr; }

/// Errors: as of the constructor of Torus.
void require_sides(double width, double height);

/// The two triangles that a rectangle with a corner at the origin is made of.
std::vector<DomainTriangle> halves_of_rectangle(double width, double height);

/// x brought into [0, period); never equal to period, whatever rounding does.
double wrap(double x, double period);

/// The shortest representative of a difference: in [-period/2, period/2].
/// Requires: |d| < period.
double wrap_difference(double d, double period);

}  // namespace wellspaced

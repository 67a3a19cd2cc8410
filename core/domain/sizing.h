#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/point_set.h"
#include "core/vec.h"

namespace wellspaced {

/// Which radius r(x) is wanted where, for sets that are denser in some places than in others: lengths near x
/// (r_f, r_c) are compared with r(x), taken at the sample. Ratios such as beta_i don't depend on its scale.
///
/// Guarantees of every implementation: r(x) is positive and finite at every point of the domain; it changes
/// by at most lipschitz() times the distance, but where the implementation tells of jumps. Thread safety:
/// immutable after construction.
class Sizing {
 public:
  /// So that their squares and ratios are finite.
  static constexpr double least_radius = 1e-100, most_radius = 1e100;
  static bool is_radius(double r) { return r >= least_radius && r <= most_radius; }
  /// Errors: invalid_parameters at `where`.
  static void require_radius(double radius, const std::string& where);

  virtual ~Sizing() = default;

  virtual std::string_view type() const = 0;  ///< its name in requests: "constant"
  virtual double at(Vec3 p) const = 0;        ///< r(p), domain lengths. Requires: p is in the domain
  virtual double least() const = 0;           ///< no r(p) is below this
  virtual double most() const = 0;            ///< nor above this
  /// The least L with |r(p) - r(q)| <= L |p - q|, or what is known to be above it; 0 if constant.
  virtual double lipschitz() const = 0;
  /// Whether r is linear on each flat triangle between places of the domain, of a mesh within a face.
  virtual bool is_linear() const { return false; }
  /// No r(q) is below this for a q within `distance` of p, but across a jump.
  virtual double least_near(Vec3 p, double distance) const {
    return std::max(least(), at(p) - lipschitz() * distance);
  }
};

/// The same radius everywhere.
///
/// Errors of the constructor: invalid_parameters at /radius; see require_radius.
class ConstantSizing final : public Sizing {
 public:
  explicit ConstantSizing(double radius);

  std::string_view type() const override { return "constant"; }
  double at(Vec3) const override { return radius_; }
  double least() const override { return radius_; }
  double most() const override { return radius_; }
  double lipschitz() const override { return 0; }
  bool is_linear() const override { return true; }

 private:
  double radius_;
};

/// What r is linear along, and its values at both ends of the domain's box.
struct LinearSizingOptions {
  int axis = 0;  ///< 0: x, 1: y, 2: z
  double from = 0, to = 0;
};

/// Linear in a coordinate: r goes from `from` at the box's low side to `to` at its high side, and stays
/// between the two whatever rounding does.
///
/// On a domain that is periodic along the axis r jumps from `to` back to `from` at the seam: lipschitz() is
/// that of the inside. Errors of the constructor: invalid_parameters at /axis for an axis that points of the
/// domain don't have, at /from and /to; see require_radius. Requires: the box has an
/// extent along the axis.
class LinearSizing final : public Sizing {
 public:
  LinearSizing(const Domain& domain, const LinearSizingOptions& options);

  std::string_view type() const override { return "linear"; }
  const LinearSizingOptions& options() const { return options_; }
  double at(Vec3 p) const override;
  double least() const override { return std::min(options_.from, options_.to); }
  double most() const override { return std::max(options_.from, options_.to); }
  double lipschitz() const override;
  bool is_linear() const override { return true; }

 private:
  double along(Vec3 v) const { return options_.axis == 0 ? v.x : options_.axis == 1 ? v.y : v.z; }

  LinearSizingOptions options_;
  double low_ = 0, size_ = 1;  ///< of the box along the axis
};

/// r at each point; all 1 without a sizing function.
std::vector<double> radii_of(const PointSet& points, const Sizing* sizing);

}  // namespace wellspaced

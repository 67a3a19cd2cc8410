#include "core/domain/sizing.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace wellspaced {

void Sizing::require_radius(double radius, const std::string& where) {
  if (is_radius(radius)) return;
  const bool is_none = !(radius > 0) || !std::isfinite(radius);
  throw Error(ErrorCode::invalid_parameters,
              is_none ? "a radius must be a finite number above 0"
                      : "a radius must be a number from 1e-100 to 1e100; give it in lengths of the domain",
              where);
}

ConstantSizing::ConstantSizing(double radius) : radius_(radius) { require_radius(radius, "/radius"); }

LinearSizing::LinearSizing(const Domain& domain, const LinearSizingOptions& options) : options_(options) {
  if (options.axis < 0 || options.axis >= domain.dimension())
    throw Error(ErrorCode::invalid_parameters,
                domain.dimension() == 3 ? "the axis must be 0 (x), 1 (y) or 2 (z)"
                                        : "the axis must be 0 (x) or 1 (y)",
                "/axis");
  require_radius(options.from, "/from");
  require_radius(options.to, "/to");
  const Box box = domain.box();
  low_ = along(box.low);
  size_ = along(box.size);
}

double LinearSizing::at(Vec3 p) const {
  const double part = (along(p) - low_) / size_;
  const auto [least, most] = std::minmax(options_.from, options_.to);
  return std::clamp(options_.from + (options_.to - options_.from) * part, least, most);
}

double LinearSizing::lipschitz() const { return std::fabs(options_.to - options_.from) / size_; }

std::vector<double> radii_of(const PointSet& points, const Sizing* sizing) {
  std::vector<double> radii(points.size(), 1);
  if (sizing == nullptr) return radii;
  for (std::size_t i = 0; i < points.size(); ++i) radii[i] = sizing->at(points[i]);
  return radii;
}

}  // namespace wellspaced

#include "core/point_set.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/sort.h"

namespace wellspaced {
namespace {

void require_in_domain(const PointSet& points) {
  const int dim = points.domain->dimension();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i];
    const double c[3] = {p.x, p.y, p.z};
    for (int axis = 0; axis < dim; ++axis)
      if (!std::isfinite(c[axis]))
        throw Error(ErrorCode::invalid_parameters,
                    std::string("coordinate is ") + (std::isnan(c[axis]) ? "NaN" : "infinite") +
                        "; every coordinate must be a finite number",
                    "/" + std::to_string(i) + "/" + std::to_string(axis));
    if (const auto reason = points.domain->why_outside(p))
      throw Error(ErrorCode::invalid_parameters, *reason, "/" + std::to_string(i));
  }
}

/// Points that differ by less than this are one: the square of their distance would underflow. Only near the
/// origin are there such numbers.
constexpr double negligible = 1e-100;

Vec3 without_negligible(Vec3 p) {
  const auto flush = [](double c) { return std::fabs(c) < negligible ? 0.0 : c; };
  return {flush(p.x), flush(p.y), flush(p.z)};
}

/// The first point (in input order) that repeats an earlier one, and that earlier one.
std::optional<std::pair<std::uint32_t, std::uint32_t>> first_repetition(const PointSet& points,
                                                                        const Control& control) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) { return without_negligible(points[i]); };
  sort(order.begin(), order.end(), control, [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = place(a), q = place(b);
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  std::optional<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::size_t k = 1; k < order.size(); ++k)
    if (place(order[k]) == place(order[k - 1]) && (!found || order[k] < found->first))
      found.emplace(order[k], order[k - 1]);
  return found;
}

}  // namespace

double hexagonal_spacing(double area, std::size_t n) {
  return std::sqrt(2 * area / (std::sqrt(3.0) * static_cast<double>(n)));
}

void require_usable(const PointSet& points, const Control& control) {
  if (points.size() < 3)
    throw Error(ErrorCode::degenerate_input,
                "the point set has " + std::to_string(points.size()) + " points; at least 3 are needed");
  require_in_domain(points);
  if (const auto repeat = first_repetition(points, control))
    throw Error(ErrorCode::degenerate_input,
                "the point repeats point " + std::to_string(repeat->second) +
                    " (to within 1e-100), so the conflict radius r_f is 0 and beta is not defined; remove "
                    "one of them",
                "/" + std::to_string(repeat->first));
}

}  // namespace wellspaced

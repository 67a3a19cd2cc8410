#include "core/point_set.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/domain/near_pair.h"
#include "core/domain/torus.h"
#include "core/error.h"
#include "core/text.h"

namespace wellspaced {
namespace {

void require_in_domain(const PointSet& points, const Control& control) {
  constexpr std::size_t between_checks = 1 << 16;
  const int dim = std::min(points.domain->dimension(), 3);
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (i % between_checks == 0) control.check();
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

/// Else there are places without a way to any point.
void require_in_every_part(const PointSet& points) {
  const Domain& domain = *points.domain;
  if (domain.parts() < 2) return;
  std::vector<bool> has_point(domain.parts(), false);
  for (std::size_t i = 0; i < points.size(); ++i) has_point[domain.part_of(points[i])] = true;
  const auto bare = std::find(has_point.begin(), has_point.end(), false) - has_point.begin();
  if (static_cast<std::size_t>(bare) == has_point.size()) return;
  const Vec3 at = domain.place_in(static_cast<std::size_t>(bare));
  throw Error(
      ErrorCode::degenerate_input,
      "the part of the domain with " + short_text(at) +
          " has no point, so the coverage radius r_c is infinite; add one there, or give these points a "
          "domain without that part");
}

/// What to say of a pair that is nearer than `limit`.
std::string why_too_near(const NearPair& pair, double limit) {
  const std::string other = "point " + std::to_string(pair.earlier);
  if (pair.distance == 0)
    return "the point repeats " + other +
           ", so the conflict radius r_f is 0 and beta is not defined; remove one of them";
  return "the point is only " + short_number(pair.distance) + " away from " + other +
         "; points nearer than " + short_number(limit) +
         " (1e-10 of the longer side of the domain's box) can't be told apart well enough to measure them; "
         "remove one of them or move them apart";
}

}  // namespace

PointSet points_to_set(std::shared_ptr<const Domain> domain, std::size_t n, const Control& control) {
  constexpr std::size_t step = 1 << 20;  // of numbers to be cleared
  const std::size_t numbers = n * static_cast<std::size_t>(domain->dimension());
  PointSet points{std::move(domain), {}};
  points.coordinates.reserve(numbers);
  while (points.coordinates.size() < numbers) {
    control.check();
    points.coordinates.resize(std::min(numbers, points.coordinates.size() + step));
  }
  return points;
}

bool is_plain_torus(const PointSet& points) { return points.sizing == nullptr && is_torus(*points.domain); }

double hexagonal_spacing(double area, std::size_t n) {
  return std::sqrt(2 * area / (std::sqrt(3.0) * static_cast<double>(n)));
}

double nearest_distance(const Domain& domain) {
  const Vec3 size = domain.box().size;
  return 1e-10 * std::max({size.x, size.y, size.z});
}

void require_usable(const PointSet& points, const Control& control) {
  if (points.size() < 3)
    throw Error(ErrorCode::degenerate_input,
                "at least 3 points are needed; the point set has " + std::to_string(points.size()));
  require_in_domain(points, control);
  require_in_every_part(points);
  const double limit = nearest_distance(*points.domain);
  if (const auto pair = find_near_pair(points, limit, control))
    throw Error(ErrorCode::degenerate_input, why_too_near(*pair, limit), "/" + std::to_string(pair->later));
}

}  // namespace wellspaced

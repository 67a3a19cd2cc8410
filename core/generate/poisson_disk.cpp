#include "core/generate/poisson_disk.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/generate/dart_throwing.h"
#include "core/generate/farthest_point.h"
#include "core/generate/generate.h"
#include "core/generate/row_order.h"

namespace wellspaced {
namespace {

/// Three standard deviations, measured: from 10 points to a million, numbers of points scatter by
/// 0.17 to 0.25 sqrt(n) for a given radius.
double count_below(double count) { return std::max(1.0, count - 0.75 * std::sqrt(count)); }

}  // namespace

void require_radius(const Domain& domain, double radius) {
  const double farthest = norm(domain.box().size) / 2;
  if (!(radius > 0))
    throw Error(ErrorCode::invalid_parameters, "the conflict radius must be greater than 0", "/radius");
  if (radius > farthest)
    throw Error(ErrorCode::infeasible,
                "no two points of this torus are farther apart than " + std::to_string(farthest) +
                    ", so a larger conflict radius leaves room for one sample only; choose a smaller one",
                "/radius");
}

PointSet poisson_disk(const std::shared_ptr<const Torus>& torus, const PoissonDiskOptions& options, Rng& rng,
                      Control& control) {
  require_radius(*torus, options.radius);
  return throw_darts_and_prove(torus, {options.radius, options.radius}, rng, control);
}

PointSet poisson_disk_of_count(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Rng& rng,
                               Control& control) {
  const double wanted = static_cast<double>(count), farthest = norm(torus->box().size) / 2;
  if (count == 1) {
    const Vec3 only = torus->random_point(rng);
    return {torus, {only.x, only.y}};
  }
  for (double radius = radius_for_count(*torus, count_below(wanted));;
       radius = std::min(1.01 * radius, farthest)) {
    PointSet points = throw_darts(torus, {radius, radius}, rng, control);
    const std::size_t drawn = points.size();
    if (drawn > count) continue;
    FarthestPointEnd end;
    end.count = count;
    end.shallowest = radius * (1 - 1.5 * (wanted - static_cast<double>(drawn)) / wanted);
    // Were the darts to leave a gap deeper than the radius with no point to spare for it, beta would be
    // above 1.
    if (insert_farthest(points, end, control) > radius * (1 + 1e-9)) continue;
    bring_into_rows(points, drawn, radius, control);
    control.report({1});
    return points;
  }
}

}  // namespace wellspaced

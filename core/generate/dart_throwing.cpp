#include "core/generate/dart_throwing.h"

#include <algorithm>
#include <cmath>

#include "core/generate/dart_sampler.h"
#include "core/generate/farthest_point.h"
#include "core/generate/row_order.h"

namespace wellspaced {
PointSet throw_darts(const std::shared_ptr<const Torus>& torus, const DiskRadii& radii, Rng& rng,
                     Control& control) {
  DartSampler sampler(*torus, radii, rng, control);
  sampler.run();
  control.report({1});
  return sampler.samples(torus);
}

double count_below(double count, double scatter) {
  return std::max(1.0, count - 2 * scatter * std::sqrt(count));
}

PointSet throw_darts_to_count(const std::shared_ptr<const Torus>& torus, std::uint64_t count,
                              const DiskRadii& radii, Rng& rng, Control& control) {
  if (count == 1) {  // the radius for it would be one that leaves a gap of no size
    const Vec3 only = torus->random_point(rng);
    return {torus, {only.x, only.y}};
  }
  const double farthest = norm(torus->box().size) / 2, beta = radii.coverage / radii.conflict;
  double growth = 0.25 / std::sqrt(static_cast<double>(count));
  for (double radius = radii.conflict;; radius = std::min((1 + growth) * radius, farthest), growth *= 2) {
    DartSampler sampler(*torus, {radius, beta * radius}, rng, control);
    sampler.run();
    PointSet points = sampler.samples(torus);
    const std::size_t drawn = points.size();
    if (drawn > count) continue;
    const double coverage = beta * radius;
    FarthestPointEnd end;
    end.count = count;
    end.shallowest = coverage * (1 - 1.5 * static_cast<double>(count - drawn) / static_cast<double>(count));
    // Were the darts to leave a gap of more than the radius with no point to spare for it, beta would be
    // above what is wanted.
    if (insert_farthest(points, end, control) > coverage * (1 + 1e-9)) continue;
    bring_into_rows(points, drawn, radius, control);
    control.report({1});
    return points;
  }
}

}  // namespace wellspaced

#include "core/generate/two_radii.h"

#include <cmath>

#include "core/error.h"
#include "core/generate/dart_throwing.h"
#include "core/generate/generate.h"
#include "core/generate/poisson_disk.h"

namespace wellspaced {
namespace {

void require_beta(double beta) {
  if (beta > 1 && beta <= 2) return;
  throw Error(
      ErrorCode::invalid_parameters,
      "the coverage radius is more than once and at most twice the conflict radius; for once, there is "
      "poisson-disk",
      "/beta");
}

/// n r_f^2 / A, measured; within 0.5%.
double density(double beta) {
  const double t = beta - 1;
  const double covering = poisson_disk_constant + t * (0.2028 + t * (-0.0334 + t * -0.0395));  // n r_c^2 / A
  return covering / (beta * beta);
}

}  // namespace

double two_radii_count(double area, const TwoRadiiOptions& options) {
  return density(options.beta) * area / (options.radius * options.radius);
}

PointSet two_radii(const std::shared_ptr<const Torus>& torus, const TwoRadiiOptions& options, Rng& rng,
                   Control& control) {
  require_radius(*torus, options.radius);
  require_beta(options.beta);
  return throw_darts(torus, {options.radius, options.beta * options.radius}, rng, control);
}

PointSet two_radii_of_count(const std::shared_ptr<const Torus>& torus, std::uint64_t count,
                            const TwoRadiiOptions& options, Rng& rng, Control& control) {
  require_beta(options.beta);
  constexpr double scatter = 0.35;  // measured: 0.22 to 0.43, growing with beta
  const double radius = radius_for_count(*torus, count_below(static_cast<double>(count), scatter)) *
                        std::sqrt(density(options.beta) / poisson_disk_constant);
  return throw_darts_to_count(torus, count, {radius, options.beta * radius}, rng, control);
}

}  // namespace wellspaced

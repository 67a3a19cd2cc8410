#include "core/generate/poisson_disk.h"

#include <string>

#include "core/generate/dart_throwing.h"
#include "core/generate/generate.h"
#include "core/text.h"

namespace wellspaced {

void require_radius(const Domain& domain, double radius, const std::string& where) {
  const bool is_bounded = !is_torus(domain) && domain.type() != "sphere";
  const double most = is_bounded ? norm(domain.box().size) / 2 : domain.farthest();
  if (!(radius > 0))
    throw Error(ErrorCode::invalid_parameters, "the conflict radius must be greater than 0", where);
  if (radius <= most) return;
  const std::string type(domain.type()), limit = short_number(most);
  if (is_bounded)
    throw Error(ErrorCode::infeasible,
                "a conflict radius above " + limit + " is larger than this " + type +
                    " has room for; choose a smaller one",
                where);
  throw Error(ErrorCode::infeasible,
              "no two points of this " + type + " are farther apart than " + limit +
                  ", so a larger conflict radius leaves room for one sample only; choose a smaller one",
              where);
}

PointSet poisson_disk(const std::shared_ptr<const Torus>& torus, const PoissonDiskOptions& options, Rng& rng,
                      Control& control) {
  require_radius(*torus, options.radius);
  return throw_darts(torus, {options.radius, options.radius}, rng, control);
}

PointSet poisson_disk_of_count(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Rng& rng,
                               Control& control) {
  constexpr double scatter = 0.24;  // measured: 0.17 to 0.25 from 10 points to a million
  const double radius = radius_for_count(*torus, count_below(static_cast<double>(count), scatter));
  return throw_darts_to_count(torus, count, {radius, radius}, rng, control);
}

}  // namespace wellspaced

// The generators' rows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/domain/torus.h"
#include "core/generate/delaunay_refinement.h"
#include "core/generate/domain_darts.h"
#include "core/generate/domain_refinement.h"
#include "core/generate/expected_points.h"
#include "core/generate/generate.h"
#include "core/generate/jittered.h"
#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/generate/two_radii.h"
#include "core/generate/white_noise.h"
#include "core/registry.h"

namespace wellspaced {
namespace {

constexpr double largest_count = 1e15;  // what is really allowed is the operator's limit

std::uint64_t count_of(const Arguments& a) {
  return static_cast<std::uint64_t>(argument(a, "count").value());
}

bool is_plain_torus(const Setting& setting) { return setting.sizing == nullptr && is_torus(*setting.domain); }

/// On any domain with any sizing function; for the plain torus there are faster ways.
PointSet by_darts(const Setting& setting, double coverage, const Arguments& a, Rng& rng, Control& control) {
  DiskRule rule;
  rule.coverage = coverage;
  rule.sizing = setting.sizing.get();
  rule.criterion = static_cast<Criterion>(static_cast<int>(argument(a, "criterion").value_or(0)));
  PointSet points;
  if (argument(a, "count")) {
    points = throw_darts_over_to_count(setting.domain, count_of(a), rule, rng, control);
  } else {
    rule.scale = argument(a, "radius").value_or(1);
    points = throw_darts_over(setting.domain, rule, rng, control);
  }
  points.sizing = setting.sizing;
  return points;
}

double expected_by_darts(const Setting& setting, double coverage, const Arguments& a) {
  DiskRule rule;
  rule.sizing = setting.sizing.get();
  rule.scale = argument(a, "radius").value_or(1) * coverage;
  return expected_points(*setting.domain, rule);
}

Parameter criterion() {
  Parameter p;
  p.name = "criterion";
  p.type = Parameter::Type::choice;
  p.description =
      "With a sizing function: which of two radii counts as the least distance of two points, the smaller or "
      "the bigger one, that of the point that was there first, or that of the one that comes later";
  p.choices = {"smaller", "bigger", "prior", "current"};
  p.maximum = 3;
  p.fallback = "\"smaller\"";
  return p;
}

/// For two points of the radius that is given, or of the least one that the sizing function wants.
void require_room(const Setting& setting, const Arguments& a) {
  require_corners_apart(setting.domain);
  if (argument(a, "count")) return;
  if (setting.sizing != nullptr) return require_radius(*setting.domain, setting.sizing->least(), "/sizing");
  if (const auto r = argument(a, "radius")) require_radius(*setting.domain, *r);
}

std::shared_ptr<const Torus> torus_of(const std::shared_ptr<const Domain>& domain) {
  if (auto torus = std::dynamic_pointer_cast<const Torus>(domain)) return torus;
  throw Error(ErrorCode::invalid_parameters, "this method needs a torus", "/domain/type");
}

Parameter count(bool alone) {
  return {"count",
          Parameter::Type::integer,
          "Exact number of points",
          "",
          1,
          largest_count,
          false,
          false,
          "",
          alone,
          !alone};
}

Parameter radius() {
  return {"radius",
          Parameter::Type::number,
          "Conflict radius r: no two points are nearer to each other",
          "domain length",
          0,
          std::numeric_limits<double>::max(),
          true,
          false,
          "",
          false,
          true};
}

Parameter coverage_ratio() {
  Parameter p;
  p.name = "beta";
  p.description = "Coverage radius over conflict radius: no place is farther than beta r from all points";
  p.minimum = 1;
  p.maximum = 2;
  p.exclusive_minimum = true;
  p.fallback = "1.5";
  return p;
}

TwoRadiiOptions two_radii_options(const Arguments& a) {
  TwoRadiiOptions options;
  options.radius = argument(a, "radius").value_or(options.radius);
  options.beta = argument(a, "beta").value_or(options.beta);
  return options;
}

Parameter even_count() {
  Parameter p = count(true);
  p.description += ", even: a honeycomb has two points a cell";
  p.minimum = 2;
  return p;
}

double counted(const Setting&, const Arguments& a) { return argument(a, "count").value(); }

template <PointSet (*lattice)(const std::shared_ptr<const Torus>&, std::uint64_t, Control&)>
PointSet run_lattice(const Setting& setting, const Arguments& a, Rng&, Control& control) {
  return lattice(torus_of(setting.domain), count_of(a), control);
}

const std::vector<Generator> generator_rows = {
    {{"poisson-disk",
      "Maximal Poisson-disk sampling",
      "Random points, none nearer than r to another, and no room for one more: beta <= 1.",
      "Ebeida et al., A Simple Algorithm for Maximal Poisson-Disk Sampling in High Dimensions, 2012",
      {count(false), radius(), criterion()}},
     true,
     false,
     true,
     [](const Setting& setting, const Arguments& a, Rng& rng, Control& control) {
       if (!is_plain_torus(setting)) return by_darts(setting, 1, a, rng, control);
       const auto torus = torus_of(setting.domain);
       const auto r = argument(a, "radius");
       return r ? poisson_disk(torus, {*r}, rng, control)
                : poisson_disk_of_count(torus, count_of(a), rng, control);
     },
     [](const Setting& setting, const Arguments& a) {
       if (const auto n = argument(a, "count")) return *n;
       return is_plain_torus(setting)
                  ? poisson_disk_count(setting.domain->area(), argument(a, "radius").value())
                  : expected_by_darts(setting, 1, a);
     },
     require_room,
     {5e-6, 180},
     {5e-5, 500}},
    {{"two-radii",
      "Two-radii Poisson-disk sampling",
      "Random points, none nearer than r to another, no place farther than beta r from all: between "
      "poisson-disk and white noise.",
      "Mitchell et al., Variable Radii Poisson Disk Sampling, 2012",
      {count(false), radius(), coverage_ratio(), criterion()}},
     true,
     false,
     true,
     [](const Setting& setting, const Arguments& a, Rng& rng, Control& control) {
       if (!is_plain_torus(setting)) return by_darts(setting, two_radii_options(a).beta, a, rng, control);
       const auto torus = torus_of(setting.domain);
       const TwoRadiiOptions options = two_radii_options(a);
       return argument(a, "radius") ? two_radii(torus, options, rng, control)
                                    : two_radii_of_count(torus, count_of(a), options, rng, control);
     },
     [](const Setting& setting, const Arguments& a) {
       if (const auto n = argument(a, "count")) return *n;
       return is_plain_torus(setting) ? two_radii_count(setting.domain->area(), two_radii_options(a))
                                      : expected_by_darts(setting, std::sqrt(two_radii_options(a).beta), a);
     },
     require_room,
     {1e-5, 260},
     {8e-5, 500}},
    {{"white-noise",
      "White noise",
      "Independent uniform points: what nothing is spaced looks like.",
      "",
      {count(true)}},
     true,
     false,
     false,
     [](const Setting& setting, const Arguments& a, Rng& rng, Control& control) {
       return white_noise(setting.domain, count_of(a), rng, control);
     },
     counted,
     nullptr,
     {1e-7, 64},
     {1e-6, 64}},
    {{"jittered",
      "Jittered grid",
      "One uniform point in each of as many parts of equal area: on rectangles row by row, elsewhere by "
      "halving.",
      "",
      {count(true)}},
     true,
     false,
     false,
     [](const Setting& setting, const Arguments& a, Rng& rng, Control& control) {
       return jittered(setting.domain, count_of(a), rng, control);
     },
     counted,
     nullptr,
     {1e-7, 64},
     {2e-5, 400}},
    {{"delaunay-refinement",
      "Delaunay refinement",
      "The circumcenter of the largest Delaunay triangle becomes a point until none is larger than r, which "
      "is "
      "also the least distance: beta <= 1, and no randomness.",
      "Chew, Guaranteed-Quality Triangular Meshes, 1989",
      {count(false), radius()}},
     false,
     false,
     false,
     [](const Setting& setting, const Arguments& a, Rng&, Control& control) {
       const auto r = argument(a, "radius");
       if (!is_torus(*setting.domain))
         return r ? refine_domain(setting.domain, *r, control)
                  : refine_domain_to_count(setting.domain, count_of(a), control);
       const auto torus = torus_of(setting.domain);
       return r ? delaunay_refinement(torus, *r, control)
                : delaunay_refinement_of_count(torus, count_of(a), control);
     },
     [](const Setting& setting, const Arguments& a) {
       const auto r = argument(a, "radius");
       if (!r) return argument(a, "count").value();
       return is_torus(*setting.domain) ? delaunay_refinement_count(setting.domain->area(), *r)
                                        : expected_by_darts(setting, 1, a);
     },
     require_room,
     {1e-5, 200},
     {1e-4, 500}},
    {{"triangular",
      "Triangular lattice",
      "The best possible spacing and no randomness: the least stretched lattice of that many points, beta = "
      "1/sqrt(3) where one fits.",
      "",
      {count(true)}},
     false,
     true,
     false,
     run_lattice<triangular_lattice>,
     counted,
     nullptr,
     {3e-7, 64},
     {}},
    {{"square",
      "Square lattice",
      "The least stretched lattice of that many points: beta = 1/sqrt(2) where one fits.",
      "",
      {count(true)}},
     false,
     true,
     false,
     run_lattice<square_lattice>,
     counted,
     nullptr,
     {3e-7, 64},
     {}},
    {{"hexagonal",
      "Hexagonal lattice (honeycomb)",
      "The corners of the least stretched hexagons, an even number: beta = 1 where they fit.",
      "",
      {even_count()}},
     false,
     true,
     false,
     run_lattice<hexagonal_lattice>,
     counted,
     [](const Setting&, const Arguments& a) { require_even(count_of(a)); },
     {3e-7, 64},
     {}},
};

}  // namespace

std::span<const Generator> generators() { return generator_rows; }

}  // namespace wellspaced

// The optimizers' rows.
#include <cmath>

#include "core/optimize/cvt.h"
#include "core/optimize/distmesh.h"
#include "core/optimize/far_point.h"
#include "core/optimize/opt_beta.h"
#include "core/optimize/opt_beta_local.h"
#include "core/optimize/push_pull.h"
#include "core/registry.h"

namespace wellspaced {
namespace {

Parameter beta(const std::string& fallback) {
  return {"beta",
          Parameter::Type::number,
          "Target for the global ratio beta = r_c / r_f",
          "",
          1 / std::sqrt(3.0),
          1,
          false,
          true,
          fallback,
          false,
          false,
          "no point set in the plane has beta below 1/sqrt(3) = 0.57735, that of the triangular lattice"};
}

OptBetaLocalOptions opt_beta_local_options(const Arguments& a) {
  OptBetaLocalOptions options;
  options.beta = argument(a, "beta").value_or(options.beta);
  options.max_sweeps = static_cast<int>(argument(a, "max_sweeps").value_or(options.max_sweeps));
  options.damping = argument(a, "damping");
  return options;
}

OptBetaOptions opt_beta_options(const Arguments& a) {
  OptBetaOptions options;
  options.beta = argument(a, "beta").value_or(options.beta);
  if (argument(a, "randomness") == 1.0) options.randomness = OptBetaOptions::Randomness::fast;
  if (const auto visits = argument(a, "max_visits")) options.max_visits = static_cast<int>(*visits);
  return options;
}

Parameter randomness() {
  Parameter p;
  p.name = "randomness";
  p.type = Parameter::Type::choice;
  p.description =
      "How to go about it: gentle keeps more of the input's randomness, fast takes about half the time; "
      "below 0.69 both do the same";
  p.choices = {"gentle", "fast"};
  p.maximum = 1;
  p.fallback = "\"gentle\"";
  return p;
}

Parameter max_sweeps(const std::string& fallback) {
  return {"max_sweeps",
          Parameter::Type::integer,
          "Sweeps over the points after which the best state is returned",
          "",
          1,
          10000,
          false,
          false,
          fallback};
}

PushPullOptions push_pull_options(const Arguments& a) {
  PushPullOptions options;
  options.rho = argument(a, "rho").value_or(options.rho);
  options.coverage = argument(a, "coverage").value_or(options.coverage);
  options.area_sd = argument(a, "area_sd");
  options.max_sweeps = static_cast<int>(argument(a, "max_sweeps").value_or(options.max_sweeps));
  return options;
}

std::vector<Parameter> push_pull_parameters() {
  Parameter rho{"rho",
                Parameter::Type::number,
                "Target for the conflict radius: r_f is at least rho d_hex, d_hex being the spacing of the "
                "triangular lattice with as many points",
                "",
                0,
                1,
                true,
                false,
                "0.87"};
  rho.infeasible_above =
      "no point set in the plane has r_f above d_hex, that of the triangular lattice: rho is at most 1";
  Parameter coverage{"coverage",
                     Parameter::Type::number,
                     "Target for the coverage radius: r_c is at most coverage d_hex",
                     "",
                     1 / std::sqrt(3.0),
                     100,
                     false,
                     false,
                     "0.65"};
  coverage.infeasible_below =
      "no point set in the plane has r_c below d_hex/sqrt(3), that of the triangular lattice: coverage is at "
      "least 0.57735";
  return {rho,
          coverage,
          {"area_sd", Parameter::Type::number,
           "Target for the cells' areas: each is within this part of their mean", "", 0, 10, true, false, ""},
          max_sweeps("1000")};
}

Parameter tolerance(const std::string& fallback) {
  return {"tolerance",
          Parameter::Type::number,
          "It is over when no point moved farther in a sweep, in units of d_hex, the spacing of the "
          "triangular lattice with as many points",
          "",
          0,
          1,
          false,
          false,
          fallback};
}

template <class Options>
Options sweeps_and_tolerance(const Arguments& a) {
  Options options;
  options.max_sweeps = static_cast<int>(argument(a, "max_sweeps").value_or(options.max_sweeps));
  options.tolerance = argument(a, "tolerance").value_or(options.tolerance);
  return options;
}

CvtOptions cvt_options(const Arguments& a) {
  auto options = sweeps_and_tolerance<CvtOptions>(a);
  if (argument(a, "variant") == 0.0) options.variant = CvtOptions::Variant::lloyd;
  return options;
}

Parameter cvt_variant() {
  Parameter p;
  p.name = "variant";
  p.type = Parameter::Type::choice;
  p.description =
      "lloyd moves all points to the centroids of their cells in each sweep; accelerated is a quasi-Newton "
      "method that needs a fraction of the sweeps";
  p.choices = {"lloyd", "accelerated"};
  p.maximum = 1;
  p.fallback = "\"accelerated\"";
  return p;
}

const std::vector<Optimizer> optimizer_rows = {
    {{"opt-beta",
      "Opt-beta",
      "Pushes and pulls the points that violate absolute radii, on a triangulation that is kept while they "
      "move, until the global beta is at most the target. Targets of 0.69 and more are reached in a fraction "
      "of a second for 10,000 points, 0.667 in seconds; below, sets become nearly crystals. Sets of fewer "
      "than 20 points, or on a torus thinner than four times their mean spacing, go the way of "
      "opt-beta-local.",
      "Radii as in Ahmed et al., A Simple Push-Pull Algorithm for Blue-Noise Sampling, 2017; the rest is "
      "this project's",
      {beta("0.75"),
       randomness(),
       {"max_visits", Parameter::Type::integer,
        "Visits a point (a sweep visits marked points only) after which the best state is returned", "", 1,
        1000000, false, false, "250 for a beta of at least 0.7 (at least 100,000 in all), else 20000"}}},
     [](const PointSet& points, const Arguments& a, Control& control) {
       return opt_beta(points, opt_beta_options(a), control);
     },
     [](const Arguments& a) {
       return Cost{0.1e-6 * expected_visits(opt_beta_options(a)) + 5e-6, 400};
     },
     30},
    {{"opt-beta-local",
      "Opt-beta^i",
      "The paper's method: each point in turn moves to where its own ratio beta_i is least, until the global "
      "beta is at most "
      "the target.",
      "Ebeida et al., Improving Spatial Coverage while Preserving the Blue Noise of Point Sets, 2013, "
      "section 4",
      {beta("0.85"),
       max_sweeps("100"),
       {"damping", Parameter::Type::number, "Part of each found move that is made", "", 0, 1, true, false,
        "0.7 for beta above 0.9, else 1"}}},
     [](const PointSet& points, const Arguments& a, Control& control) {
       return opt_beta_local(points, opt_beta_local_options(a), control);
     },
     [](const Arguments& a) {
       return Cost{13e-6 * opt_beta_local_options(a).max_sweeps + 10e-6, 220};
     },
     1.5},
    {{"push-pull", "Push-pull",
      "Pushes points away from neighbors that are too near and pulls them towards gaps that are too wide, "
      "until absolute targets for both radii, and for the cells' areas if wanted, hold; takes 20 points or "
      "more that are spread over their domain.",
      "Ahmed et al., A Simple Push-Pull Algorithm for Blue-Noise Sampling, 2017", push_pull_parameters()},
     [](const PointSet& points, const Arguments& a, Control& control) {
       return push_pull(points, push_pull_options(a), control);
     },
     [](const Arguments& a) {
       const PushPullOptions options = push_pull_options(a);
       constexpr int usual_sweeps = 300;  // later ones visit few points
       return Cost{options.area_sd ? 1.2e-6 * options.max_sweeps + 12e-6
                                   : 0.1e-6 * std::min(options.max_sweeps, usual_sweeps) + 5e-6,
                   250};
     },
     40},
    {{"cvt",
      "Centroidal Voronoi tessellation",
      "Moves points to the centroids of their Voronoi cells, which lowers the mean squared distance to the "
      "nearest point; takes 20 points or more that are spread over their domain.",
      "Lloyd 1982; Liu et al., On Centroidal Voronoi Tessellation - Energy Smoothness and Fast Computation, "
      "2009",
      {cvt_variant(), max_sweeps("100"), tolerance("0.0001")}},
     [](const PointSet& points, const Arguments& a, Control& control) {
       return cvt(points, cvt_options(a), control);
     },
     [](const Arguments& a) {
       const CvtOptions options = cvt_options(a);
       const bool lloyd = options.variant == CvtOptions::Variant::lloyd;
       return Cost{(lloyd ? 0.4e-6 : 1e-6) * options.max_sweeps + 12e-6, lloyd ? 250.0 : 700.0};
     },
     15},
    {{"distmesh",
      "DistMesh",
      "Edges of the triangulation as springs that only push; takes 20 points or more that are spread over "
      "their domain.",
      "Persson and Strang, A Simple Mesh Generator in MATLAB, 2004",
      {max_sweeps("100"), tolerance("0.001")}},
     [](const PointSet& points, const Arguments& a, Control& control) {
       return distmesh(points, sweeps_and_tolerance<DistMeshOptions>(a), control);
     },
     [](const Arguments& a) {
       return Cost{0.4e-6 * sweeps_and_tolerance<DistMeshOptions>(a).max_sweeps + 12e-6, 250};
     },
     15},
    {{"far-point",
      "Farthest-point optimization",
      "Takes out each point in turn and puts it where the others are farthest, which raises r_f; takes 20 "
      "points or more that are spread over their domain.",
      "Schloemer et al., Farthest-Point Optimized Point Sets with Maximized Minimum Distance, 2011",
      {max_sweeps("100"),
       {"tolerance", Parameter::Type::number,
        "It is over when the mean distance to the nearest point grew by less in a sweep, in units of d_hex, "
        "the spacing of the triangular lattice with as many points",
        "", 0, 1, false, false, "0.00001"}}},
     [](const PointSet& points, const Arguments& a, Control& control) {
       return far_point(points, sweeps_and_tolerance<FarPointOptions>(a), control);
     },
     [](const Arguments& a) {
       return Cost{6e-6 * sweeps_and_tolerance<FarPointOptions>(a).max_sweeps + 12e-6, 250};
     },
     15},
};

}  // namespace

std::span<const Optimizer> optimizers() { return optimizer_rows; }

}  // namespace wellspaced

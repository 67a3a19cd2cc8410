#include "core/generate/expected_points.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/generate/generate.h"
#include "core/math.h"
#include "core/rng.h"

namespace wellspaced {
namespace {

/// Means of 1 / r and of its square, at scale 1.
struct InverseMeans {
  double first = 0, second = 0;

  /// A part of so much around p, where r takes all values between its least one and as much above: narrow
  /// places where it is tiny count.
  void add(const Sizing& sizing, Vec3 p, double around, double part) {
    constexpr double ln_10 = 2.302585092994046;
    const double r = sizing.at(p), least = sizing.least_near(p, around), most = 2 * r - least;
    first += part * (most > least ? ln_10 * portable_log10(most / least) / (most - least) : 1 / r);
    second += part / (least * most);
  }
};

constexpr int draws = 4096;

InverseMeans means_inside(const Domain& domain, const Sizing* sizing) {
  if (sizing == nullptr) return {1, 1};
  InverseMeans means;
  Rng rng(0x5ca1e);
  const double around = std::sqrt(domain.area() / draws / pi);
  for (int k = 0; k < draws; ++k) means.add(*sizing, domain.random_point(rng), around, 1.0 / draws);
  return means;
}

InverseMeans means_on_boundary(const Domain& domain, const Sizing* sizing) {
  if (sizing == nullptr) return {1, 1};
  InverseMeans means;
  const std::vector<BoundaryCurve> curves = domain.boundary();
  const double step = domain.boundary_length() / draws;
  double begin = 0, at = 0.5 * step;  // of the curve, of the next place, along all curves
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (; at < begin + curves[c].length; at += step)
      means.add(*sizing, domain.boundary_point(c, at - begin), 0.5 * step, 1.0 / draws);
    begin += curves[c].length;
  }
  return means;
}

}  // namespace

CountFormula::CountFormula(const Domain& domain, const Sizing* sizing) {
  constexpr double on_rim = 0.39;
  const double length = domain.boundary_length();
  inside = poisson_disk_constant * domain.area() * means_inside(domain, sizing).second;
  if (length > 0) rim = on_rim * length * means_on_boundary(domain, sizing).first;
}

double CountFormula::count(double scale) const { return (inside / scale + rim) / scale; }

double CountFormula::scale(double count) const {
  return (rim + std::sqrt(rim * rim + 4 * inside * count)) / (2 * count);
}

double expected_points(const Domain& domain, const DiskRule& rule) {
  return std::max(16.0, CountFormula(domain, rule.sizing).count(rule.scale));
}

double scale_for_count(const Domain& domain, const DiskRule& rule, double count) {
  return CountFormula(domain, rule.sizing).scale(count) / rule.coverage;
}

}  // namespace wellspaced

#include "core/analyze/domain_certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/analyze/spacing.h"
#include "core/domain/sphere.h"
#include "core/domain/torus.h"
#include "core/voronoi/neighbors.h"

namespace wellspaced {
namespace {

constexpr std::uint32_t nobody = ~0u;
/// Of what is computed in a few steps from numbers of that size; 40 units in the last place.
constexpr double rounding = 1e-14;

/// Distances are straight ones through space; on a sphere those of chords.
class Cover {
 public:
  Cover(const PointSet& points, const NeighborGrid& grid, double radius, const Control& control)
      : domain_(*points.domain), grid_(grid), radius_(radius), radius2_(radius * radius), control_(control) {}

  /// Whether every place of the domain is within the radius of a sample, but for rounding.
  bool holds() {
    for (const DomainTriangle& triangle : domain_.triangles())
      if (!covers_large(triangle)) return false;
    return true;
  }

 private:
  struct Open {
    DomainTriangle triangle;
    int depth;
  };

  /// Down to triangles of about the radius, for which samples are searched.
  bool covers_large(const DomainTriangle& whole) {
    std::vector<DomainTriangle> open = {whole};
    while (!open.empty()) {
      const DomainTriangle triangle = open.back();
      open.pop_back();
      if (longest2(triangle) <= radius2_) {
        if (!covers_small(triangle)) return false;
        continue;
      }
      for (const DomainTriangle& half : halves(triangle)) open.push_back(half);
    }
    return true;
  }

  /// Depth first.
  bool covers_small(const DomainTriangle& small) {
    constexpr int deepest = 120;
    if (++steps_ % 64 == 0) control_.check();
    gather(small);
    std::vector<Open> open = {{small, 0}};
    while (!open.empty()) {
      const Open now = open.back();
      open.pop_back();
      if (is_covered(now.triangle)) continue;
      if (now.depth == deepest) return false;
      for (const DomainTriangle& half : halves(now.triangle)) open.push_back({half, now.depth + 1});
    }
    return true;
  }

  bool is_covered(const DomainTriangle& t) const {
    return std::any_of(found_.begin(), found_.end(), [&](Vec3 q) {
      return norm2(t[0] - q) <= radius2_ && norm2(t[1] - q) <= radius2_ && norm2(t[2] - q) <= radius2_;
    });
  }

  void gather(const DomainTriangle& t) {
    const double reach = radius_ + std::sqrt(longest2(t));
    neighbors_.clear();
    grid_.gather(t[0], nobody, reach, neighbors_);
    found_.clear();
    for (const Neighbor& neighbor : neighbors_) found_.push_back(t[0] + neighbor.offset);
  }

  static double longest2(const DomainTriangle& t) {
    return std::max({norm2(t[1] - t[0]), norm2(t[2] - t[1]), norm2(t[0] - t[2])});
  }

  std::array<DomainTriangle, 2> halves(const DomainTriangle& t) const {
    const double lengths[3] = {norm2(t[1] - t[0]), norm2(t[2] - t[1]), norm2(t[0] - t[2])};
    const auto k = static_cast<std::size_t>(std::max_element(lengths, lengths + 3) - lengths);
    const Vec3 a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], m = domain_.middle(a, b);
    return {DomainTriangle{a, m, c}, DomainTriangle{m, b, c}};
  }

  const Domain& domain_;
  const NeighborGrid& grid_;
  double radius_, radius2_;
  const Control& control_;
  std::vector<Neighbor> neighbors_;
  std::vector<Vec3> found_;
  std::size_t steps_ = 0;
};

/// Smallest straight distance of two samples that are not both corners of the domain.
double shortest(const PointSet& points, const NeighborGrid& grid, double about, const Control& control) {
  double least2 = std::numeric_limits<double>::infinity();
  std::vector<Neighbor> neighbors;
  std::vector<bool> fixed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    fixed[i] = points.domain->freedom(points[i]).dimensions == 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 1024 == 0) control.check();
    neighbors.clear();
    grid.gather(points[i], static_cast<std::uint32_t>(i), about, neighbors);
    for (const Neighbor& neighbor : neighbors)
      if (neighbor.id != i && !(fixed[i] && fixed[neighbor.id]))
        least2 = std::min(least2, norm2(neighbor.offset));
  }
  return std::sqrt(least2);
}

/// Both ways between distances on the domain and straight ones.
double to_straight(const Domain& domain, double distance) {
  const auto* sphere = dynamic_cast<const Sphere*>(&domain);
  return sphere == nullptr ? distance : sphere->chord(distance);
}

double from_straight(const Domain& domain, double straight) {
  const auto* sphere = dynamic_cast<const Sphere*>(&domain);
  return sphere == nullptr ? straight : sphere->arc(straight);
}

}  // namespace

bool can_be_certified(const PointSet& points) {
  return points.sizing == nullptr && (points.domain->is_flat() || points.domain->type() == "sphere");
}

std::optional<Certificate> certify_domain(const PointSet& points, const Control& control) {
  const Domain& domain = *points.domain;
  const Spacing measured = measure_spacing(points, control);
  if (measured.r_c >= domain.horizon() * (1 - 1e-6)) return std::nullopt;  // such a disk isn't convex
  const NeighborGrid grid(points, hexagonal_spacing(domain, points.size()));
  const double hidden = rounding * (norm(domain.box().size) + norm(domain.box().low));
  for (const double above : {1e-11, 1e-9, 1e-7, 1e-6}) {
    const double radius = to_straight(domain, measured.r_c) * (1 + above);
    if (!Cover(points, grid, radius, control).holds()) continue;
    Certificate proof;
    proof.r_c_upper = from_straight(domain, radius + hidden) * (1 + rounding);
    const double straight =
        shortest(points, grid, to_straight(domain, measured.r_f_free) * (1 + 1e-9), control);
    if (!(straight > hidden)) return std::nullopt;  // rounding hides how near the points are
    proof.r_f_lower = from_straight(domain, straight - hidden) * (1 - rounding);
    proof.beta_upper = proof.r_c_upper / proof.r_f_lower * (1 + rounding);
    return proof;
  }
  return std::nullopt;
}

}  // namespace wellspaced

#include "core/analyze/domain_spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analyze/spacing_star.h"
#include "core/error.h"
#include "core/math.h"
#include "core/parallel.h"
#include "core/voronoi/domain_star.h"
#include "core/voronoi/moving_set.h"

namespace wellspaced {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What one point's cell and star say; lengths in its units.
struct Local {
  double nearest = infinity;  ///< distance to the nearest sample in domain lengths
  double outradius = 0;       ///< of its cell, in domain lengths
  double r_f = infinity, r_f_free = infinity;
  double area = 0;
  double edge_max = 0, cotangent_max = -infinity, cotangent_min = infinity;
  int valence = 0;
};

/// Cotangents of the angles of the triangle (0, a, b), from the lengths of its sides.
void see_angles(Vec2 a, Vec2 b, Local& local) {
  const double twice = cross(a, b);
  const Vec2 e = b - a;
  for (const double product : {dot(a, b), -dot(a, e), dot(b, e)}) {
    local.cotangent_max = std::max(local.cotangent_max, product / twice);
    local.cotangent_min = std::min(local.cotangent_min, product / twice);
  }
}

Local look(const MovingSet& set, std::size_t i, CellFinder& cells, DomainStar& star) {
  star.load(set, i, cells);
  Local local;
  const double unit = set.unit(i);
  local.outradius = cells.outradius();
  local.area = cells.moments().area / (unit * unit);
  for (const Neighbor& neighbor : cells.neighbors()) {
    if (neighbor.id == i) continue;
    const double distance = norm(set.domain().way_to(set[i], neighbor));
    const double in_units = distance / std::min(unit, set.unit(neighbor.id));
    local.nearest = std::min(local.nearest, distance);
    local.r_f = std::min(local.r_f, in_units);
    if (!set.both_fixed(i, neighbor.id)) local.r_f_free = std::min(local.r_f_free, in_units);
  }
  const std::span<const DomainStar::Spoke> spokes = star.spokes();
  local.valence = static_cast<int>(spokes.size());
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    local.edge_max = std::max(local.edge_max, norm(spokes[k].way) / unit);
    if (spokes[k].closes) see_angles(spokes[k].way, spokes[k + 1 == spokes.size() ? 0 : k + 1].way, local);
  }
  return local;
}

double angle_deg(double cotangent) { return portable_atan2(1, cotangent) * (180 / pi); }

Spacing sum_up(const MovingSet& set, const std::vector<Local>& locals, std::vector<double>& beta_i) {
  const auto n = static_cast<double>(set.size());
  const double unit = set.spacing();
  Spacing s;
  s.n = set.size();
  double r_f = infinity, r_f_free = infinity, r_c = 0, area = 0, squares = 0, edge_max = 0, disks = 0;
  double most = -infinity, least = infinity, whole = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    area += locals[i].area;
    whole += locals[i].area * set.unit(i) * set.unit(i);
  }
  if (set.domain().is_flat()) require_whole(whole, set.domain().area());
  const double mean_area = area / n;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Local& local = locals[i];
    r_f = std::min(r_f, local.r_f);
    r_f_free = std::min(r_f_free, local.r_f_free);
    r_c = std::max(r_c, local.outradius / set.unit(i));
    beta_i.push_back(local.outradius / local.nearest);
    s.beta_i_max = std::max(s.beta_i_max, beta_i.back());
    s.beta_i_mean += beta_i.back() / n;
    s.nearest_mean += local.nearest / set.unit(i) / n;
    squares += (local.area - mean_area) * (local.area - mean_area);
    edge_max = std::max(edge_max, local.edge_max);
    disks += set.unit(i) * set.unit(i);
    most = std::max(most, local.cotangent_max);
    least = std::min(least, local.cotangent_min);
    ++s.valence[local.valence];
  }
  s.r_f = r_f * unit;
  s.r_f_free = r_f_free * unit;
  s.r_c = r_c * unit;
  s.beta = r_c / r_f_free;
  if (!std::isfinite(s.beta)) throw hidden_triangles();
  s.rho = r_f_free;
  s.coverage = r_c;
  s.packing_density = disks * pi * r_f * r_f / (4 * set.domain().area());
  s.cell_area_sd = std::sqrt(squares / n) / mean_area;
  s.angle_min_deg = angle_deg(most);
  s.angle_max_deg = angle_deg(least);
  s.edge_min = 1;
  s.edge_max = edge_max / r_f;
  return s;
}

}  // namespace

LocalSpacing measure_domain_spacing(const PointSet& points, const Control& control) {
  constexpr std::size_t block = 256;
  const MovingSet set(points, control);
  std::vector<Local> locals(set.size());
  parallel_blocks(set.size(), block, control, [&](std::size_t begin, std::size_t end) {
    CellFinder cells = set.finder(control);
    DomainStar star;
    for (std::size_t i = begin; i < end; ++i) {
      if (i % 64 == 0) control.check();
      locals[i] = look(set, i, cells, star);
    }
  });
  LocalSpacing result;
  result.beta_i.reserve(set.size());
  result.global = sum_up(set, locals, result.beta_i);
  return result;
}

}  // namespace wellspaced

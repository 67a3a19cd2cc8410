#include "core/point_set.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/domain/torus.h"
#include "core/error.h"
#include "core/sort.h"
#include "core/voronoi/grid_order.h"

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

/// Points that differ by less than this are one: the square of their distance would underflow. Only near the
/// origin are there such numbers.
constexpr double negligible = 1e-100;

Vec3 without_negligible(Vec3 p) {
  const auto flush = [](double c) { return std::fabs(c) < negligible ? 0.0 : c; };
  return {flush(p.x), flush(p.y), flush(p.z)};
}

/// A point and an earlier one that it repeats.
struct Repetition {
  std::uint32_t later, earlier;
};

/// The first point (in input order) that repeats an earlier one.
std::optional<Repetition> first_repetition(const PointSet& points, const Control& control) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) { return without_negligible(points[i]); };
  sort(order.begin(), order.end(), control, [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = place(a), q = place(b);
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  std::optional<Repetition> found;
  for (std::size_t k = 1; k < order.size(); ++k)
    if (place(order[k]) == place(order[k - 1]) && (!found || order[k] < found->later))
      found = Repetition{order[k], order[k - 1]};
  return found;
}

/// Whether any point repeats another one, for even sets: points that are the same lie in the same cell of a
/// grid. Nothing is known of sets with crowded cells.
std::optional<bool> repeats_within_cells(const PointSet& points, const Control& control) {
  constexpr std::uint32_t crowd = 32;
  constexpr std::size_t between_checks = 1 << 16;
  const GridOrder order =
      grid_order(points, hexagonal_spacing(points.domain->area(), points.size()), control);
  if (order.fullest() > crowd) return std::nullopt;
  const auto same = [&](std::uint32_t a, std::uint32_t b) {
    return without_negligible({order.x[a], order.y[a], 0}) == without_negligible({order.x[b], order.y[b], 0});
  };
  for (std::size_t c = 0; c + 1 < order.start.size(); ++c) {
    if (c % between_checks == 0) control.check();
    for (std::uint32_t a = order.start[c]; a < order.start[c + 1]; ++a)
      for (std::uint32_t b = order.start[c]; b < a; ++b)
        if (same(a, b)) return true;
  }
  return false;
}

std::optional<Repetition> find_repetition(const PointSet& points, const Control& control) {
  if (is_torus(*points.domain) && repeats_within_cells(points, control) == false) return std::nullopt;
  return first_repetition(points, control);
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

void require_usable(const PointSet& points, const Control& control) {
  if (points.size() < 3)
    throw Error(ErrorCode::degenerate_input,
                "at least 3 points are needed; the point set has " + std::to_string(points.size()));
  require_in_domain(points, control);
  if (const auto repeat = find_repetition(points, control))
    throw Error(ErrorCode::degenerate_input,
                "the point repeats point " + std::to_string(repeat->earlier) +
                    " (to within 1e-100), so the conflict radius r_f is 0 and beta is not defined; remove "
                    "one of them",
                "/" + std::to_string(repeat->later));
}

}  // namespace wellspaced

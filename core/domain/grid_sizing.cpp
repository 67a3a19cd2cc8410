#include "core/domain/grid_sizing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

#include "core/domain/sphere.h"
#include "core/error.h"
#include "core/math.h"

namespace wellspaced {
namespace {

double cosine(double angle) { return portable_cos_sin(angle / (2 * pi)).cos; }

/// Its slope is greatest in one of its corners, for it is linear along every row and every column.
double steepest_in_cell(double a, double b, double c, double d, Vec2 size) {
  const double bottom = (b - a) / size.x, top = (d - c) / size.x;
  const double left = (c - a) / size.y, right = (d - b) / size.y;
  return norm(Vec2{std::max(std::fabs(bottom), std::fabs(top)), std::max(std::fabs(left), std::fabs(right))});
}

}  // namespace

GridSizing::Between GridSizing::Axis::between(double u) const {
  const auto n = static_cast<std::int64_t>(cells);
  if (!periodic) u = std::clamp(u, 0.0, static_cast<double>(n - 1));
  const double floor = std::floor(u);
  const auto from = static_cast<std::int64_t>(floor);
  const auto wrapped = [&](std::int64_t k) {
    return static_cast<std::size_t>(periodic ? ((k % n) + n) % n : std::min(k, n - 1));
  };
  return {wrapped(from), wrapped(from + 1), u - floor};
}

GridSizing::GridSizing(const Domain& domain, RadiusGrid grid) : grid_(std::move(grid)) {
  check_radii();
  const auto* sphere = dynamic_cast<const Sphere*>(&domain);
  if (domain.dimension() != 2 && sphere == nullptr)
    throw Error(
        ErrorCode::invalid_parameters,
        "grids and images of radii are for planar domains and spheres; a mesh takes radii at its vertices");
  if (sphere != nullptr) {
    is_sphere_ = true;
    sphere_radius_ = sphere->radius();
    axes_ = {{{-pi, 2 * pi, grid_.columns, true}, {-pi / 2, pi, grid_.rows, false}}};
    for (const std::size_t pole : {0, 1}) {
      const auto row =
          grid_.radii.begin() + static_cast<std::ptrdiff_t>(pole == 0 ? 0 : (grid_.rows - 1) * grid_.columns);
      pole_radii_[pole] = std::accumulate(row, row + static_cast<std::ptrdiff_t>(grid_.columns), 0.0) /
                          static_cast<double>(grid_.columns);
    }
  } else {
    const Box box = domain.box();
    axes_ = {{{box.low.x, box.size.x, grid_.columns, box.periodic[0]},
              {box.low.y, box.size.y, grid_.rows, box.periodic[1]}}};
  }
  const auto [least, most] = std::minmax_element(grid_.radii.begin(), grid_.radii.end());
  least_ = *least;
  most_ = *most;
  lipschitz_ = steepest();
}

void GridSizing::check_radii() const {
  if (grid_.radii.empty() || grid_.radii.size() != grid_.columns * grid_.rows)
    throw Error(ErrorCode::invalid_parameters, "there must be rows of radii, all of the same length",
                "/radii");
  for (std::size_t k = 0; k < grid_.radii.size(); ++k)
    if (!is_radius(grid_.radii[k]))
      require_radius(grid_.radii[k],
                     "/radii/" + std::to_string(k / grid_.columns) + "/" + std::to_string(k % grid_.columns));
}

Vec2 GridSizing::coordinates(Vec3 p) const {
  if (!is_sphere_) return {p.x, p.y};
  return {portable_atan2(p.y, p.x), portable_atan2(p.z, norm(Vec2{p.x, p.y}))};
}

double GridSizing::along_row(std::size_t row, Between columns) const {
  return std::lerp(value(columns.from, row), value(columns.to, row), columns.part);
}

/// u is outside the middles of the outermost rows, half a row away at most.
double GridSizing::to_pole(double u, Between columns) const {
  const bool south = u < 0;
  const std::size_t row = south ? 0 : grid_.rows - 1;
  const double beyond = south ? -u : u - static_cast<double>(grid_.rows - 1);
  return std::lerp(along_row(row, columns), pole_radii_[south ? 0 : 1], std::min(1.0, 2 * beyond));
}

double GridSizing::at(Vec3 p) const {
  const Vec2 c = coordinates(p);
  const Between columns = axes_[0].between(axes_[0].cells_at(c.x));
  const double u = axes_[1].cells_at(c.y);
  double r = 0;
  if (is_sphere_ && (u < 0 || u > static_cast<double>(grid_.rows - 1))) {
    r = to_pole(u, columns);
  } else {
    const Between rows = axes_[1].between(u);
    r = std::lerp(along_row(rows.from, columns), along_row(rows.to, columns), rows.part);
  }
  return std::clamp(r, least_, most_);
}

double GridSizing::least_near(Vec3 p, double distance) const {
  constexpr double most_cells = 1024;
  const double by_slope = std::max(least_, at(p) - lipschitz_ * distance);
  if (is_sphere_) return by_slope;
  const double u = axes_[0].cells_at(p.x), v = axes_[1].cells_at(p.y);
  const double du = distance / axes_[0].cell_size(), dv = distance / axes_[1].cell_size();
  if (!((2 * du + 2) * (2 * dv + 2) <= most_cells)) return by_slope;
  double least = most_;
  for (double row = std::floor(v - dv); row <= std::floor(v + dv) + 1; ++row)
    for (double column = std::floor(u - du); column <= std::floor(u + du) + 1; ++column)
      least = std::min(least, value(axes_[0].between(column).from, axes_[1].between(row).from));
  return std::max(least, by_slope);
}

double GridSizing::steepest() const {
  double most = 0;
  for (std::size_t row = 0; row + 1 < grid_.rows + (axes_[1].periodic ? 1 : 0); ++row) {
    const std::size_t next = (row + 1) % grid_.rows;
    Vec2 size = {axes_[0].cell_size(), axes_[1].cell_size()};
    if (is_sphere_) {  // parallels are shortest at the end nearer to a pole
      const auto latitude = [&](std::size_t k) { return (static_cast<double>(k) + 0.5) * size.y - pi / 2; };
      const double shortest = std::min(cosine(latitude(row)), cosine(latitude(next)));
      size = sphere_radius_ * Vec2{size.x * shortest, size.y};
    }
    for (std::size_t i = 0; i < grid_.columns; ++i) {
      const Between columns = axes_[0].between(static_cast<double>(i));
      most = std::max(most, steepest_in_cell(value(columns.from, row), value(columns.to, row),
                                             value(columns.from, next), value(columns.to, next), size));
    }
  }
  if (grid_.rows == 1 && !is_sphere_) {
    for (std::size_t i = 0; i < grid_.columns; ++i) {
      const Between columns = axes_[0].between(static_cast<double>(i));
      most = std::max(most, std::fabs(value(columns.to, 0) - value(columns.from, 0)) / axes_[0].cell_size());
    }
  }
  if (is_sphere_)
    most = std::max({most, steepest_cap(0, pole_radii_[0]), steepest_cap(grid_.rows - 1, pole_radii_[1])});
  return most;
}

/// Between the middle of the row and its pole. At the angle a from the pole the values of the row count by
/// a / a_row, while the parallel is as long as sin a says, which is at least that part of sin a_row.
double GridSizing::steepest_cap(std::size_t row, double mean) const {
  const double a_row = 0.5 * axes_[1].cell_size();
  const double east = sphere_radius_ * portable_cos_sin(a_row / (2 * pi)).sin * axes_[0].cell_size(),
               north = sphere_radius_ * a_row;
  double most = 0;
  for (std::size_t i = 0; i < grid_.columns; ++i) {
    const Between columns = axes_[0].between(static_cast<double>(i));
    const double a = value(columns.from, row), b = value(columns.to, row);
    const double to_mean = std::max(std::fabs(a - mean), std::fabs(b - mean));
    most = std::max(most, norm(Vec2{(b - a) / east, to_mean / north}));
  }
  return most;
}

}  // namespace wellspaced

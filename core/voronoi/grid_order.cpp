#include "core/voronoi/grid_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wellspaced {
namespace {

/// More cells than points only cost memory; a thin torus may ask for that.
double affordable(double side, double width, double height, double n) {
  const double most = std::max(64.0, n), wanted = std::max(1.0, width / side) * std::max(1.0, height / side);
  return wanted > most ? side * std::sqrt(wanted / most) : side;
}

std::uint32_t cells_along(double length, double side) {
  return static_cast<std::uint32_t>(std::max(1.0, std::floor(length / side)));
}

}  // namespace

std::uint32_t GridOrder::fullest() const {
  std::uint32_t most = 0;
  for (std::size_t c = 0; c + 1 < start.size(); ++c) most = std::max(most, start[c + 1] - start[c]);
  return most;
}

GridOrder grid_order(const PointSet& points, double side, const Control& control) {
  constexpr std::size_t between_checks = 1 << 16;
  const Box box = points.domain->box();
  GridOrder order;
  order.width = box.size.x;
  order.height = box.size.y;
  side = affordable(side, order.width, order.height, static_cast<double>(points.size()));
  order.columns = cells_along(order.width, side);
  order.rows = cells_along(order.height, side);
  order.start.assign(std::size_t{order.columns} * order.rows + 1, 0);
  const std::size_t n = points.size();
  const double* at = points.coordinates.data();
  LargeVector<std::uint32_t> cell(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i % between_checks == 0) control.check();
    cell[i] = order.row_of(at[2 * i + 1]) * order.columns + order.column_of(at[2 * i]);
    ++order.start[cell[i] + 1];
  }
  std::partial_sum(order.start.begin(), order.start.end(), order.start.begin());
  LargeVector<std::uint32_t> next(order.start.begin(), order.start.end() - 1);
  order.original.resize(n);
  order.x.resize(n);
  order.y.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i % between_checks == 0) control.check();
    const std::uint32_t place = next[cell[i]]++;
    order.original[place] = static_cast<std::uint32_t>(i);
    order.x[place] = at[2 * i];
    order.y[place] = at[2 * i + 1];
  }
  return order;
}

}  // namespace wellspaced

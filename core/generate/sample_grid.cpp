#include "core/generate/sample_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/generate/row_order.h"
#include "core/parallel.h"

namespace wellspaced {

GridAxis::GridAxis(double length, const DiskRadii& radii)
    : period(length), side(0), cells(background_cells(length, radii.conflict)), near(0), reach(0), stride(0) {
  side = period / static_cast<double>(cells);
  near = static_cast<std::int64_t>(std::ceil(radii.conflict / side * (1 + 1e-12)));
  reach = static_cast<std::int64_t>(std::ceil(radii.coverage / side * (1 + 1e-12)));
  stride = cells + 2 * reach;
}

SampleGrid::SampleGrid(const Torus& torus, const DiskRadii& radii, const Control& control)
    : x(torus.width(), radii),
      y(torus.height(), radii),
      table_x_(static_cast<std::size_t>(x.stride * y.stride) + CellWindow::readable_beyond),
      table_y_(table_x_.size()) {
  constexpr std::size_t block = 1 << 16;
  parallel_blocks(table_x_.size(), block, control, [&](std::size_t begin, std::size_t end) {
    for (LargeVector<double>* table : {&table_x_, &table_y_})
      std::fill(table->data() + begin, table->data() + end, std::numeric_limits<double>::quiet_NaN());
  });
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(x.period, y.period);
  conflict2_ = (radii.conflict + rounding) * (radii.conflict + rounding);
  coverage2_ = (radii.coverage + rounding) * (radii.coverage + rounding);
}

void SampleGrid::put_all_images(std::int64_t i, std::int64_t j, Vec2 p) {
  for (std::int64_t gj = j - y.cells * ((j + y.reach) / y.cells); gj < y.cells + y.reach; gj += y.cells) {
    const std::int64_t turns_y = (gj - j) / y.cells;
    for (std::int64_t gi = i - x.cells * ((i + x.reach) / x.cells); gi < x.cells + x.reach; gi += x.cells) {
      const std::int64_t turns_x = (gi - i) / x.cells;
      put_image(index(gi, gj), {p.x + static_cast<double>(turns_x) * x.period,
                                p.y + static_cast<double>(turns_y) * y.period});
    }
  }
}

void SampleGrid::prefetch(std::int64_t i, std::int64_t j) const {
  const CellWindow w = window(i, j);
  for (std::size_t row = 0; row < w.rows; ++row) {
    __builtin_prefetch(w.x + row * w.stride);
    __builtin_prefetch(w.x + row * w.stride + w.columns - 1);
    __builtin_prefetch(w.y + row * w.stride);
    __builtin_prefetch(w.y + row * w.stride + w.columns - 1);
  }
}

std::pair<std::int64_t, std::int64_t> SampleGrid::cell_of(Vec2 p) const {
  return {std::clamp<std::int64_t>(static_cast<std::int64_t>(p.x / x.side), 0, x.cells - 1),
          std::clamp<std::int64_t>(static_cast<std::int64_t>(p.y / y.side), 0, y.cells - 1)};
}

}  // namespace wellspaced

#pragma once

#include <cstddef>
#include <vector>

#include "core/render/canvas.h"

namespace wellspaced {

/// Values in rows from the top.
struct Raster {
  std::size_t columns = 0, rows = 0;
  std::vector<double> values;
};

/// The part of a raster from column `x0` to `x1` and row `y0` to `y1`, which may lie within pixels, on so
/// many pixels: each the mean over what it covers. Requires: the part lies in the raster.
Raster resampled(const Raster& raster, double x0, double x1, double y0, double y1, std::size_t columns,
                 std::size_t rows);

/// `low` and below get the map's first color, `high` and above its last.
Image colored(const Raster& raster, ColorMap map, double low, double high);

}  // namespace wellspaced

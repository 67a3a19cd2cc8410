#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/analyze/local_measures.h"
#include "core/render/chart.h"
#include "core/render/color.h"

namespace wellspaced {

/// What a picture of points shows.
enum class PointsKind { voronoi, delaunay, points };

/// How a local measure becomes a color: `best` at the dark end, `worst` at the light one.
struct ColorScale {
  std::string name;
  double best, worst;
  std::vector<Tick> ticks;
  ColorMap map = map_sequential;

  Rgb operator()(double value) const { return color_at(map, (value - best) / (worst - best)); }
  /// Whether its dark end needs light points on it.
  bool is_dark() const { return map.data() == map_sequential.data(); }
  /// The one of two values that is farther from the best.
  double worse(double a, double b) const { return std::abs(a - best) > std::abs(b - best) ? a : b; }
};

ColorScale scale_of(LocalMeasure what);

}  // namespace wellspaced

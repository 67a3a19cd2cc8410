#include "core/render/pictures/pictures.h"

#include <cmath>
#include <string>

#include "core/render/pictures/rows.h"

namespace wellspaced {
namespace {

const std::vector<Picture> picture_rows = {
    voronoi_picture(),     delaunay_picture(),    points_picture(),           overview_picture(),
    spectrum_picture(),    periodogram_picture(), pair_correlation_picture(), distributions_picture(),
    convergence_picture(), zone_plate_picture(),  differential_picture(),
};

}  // namespace

std::span<const Picture> pictures() { return picture_rows; }

Parameter size_parameter(double fallback_px, double least_px) {
  Parameter p;
  p.name = "size_px";
  p.type = Parameter::Type::integer;
  p.description = "longer side of a panel";
  p.unit = "pixels";
  p.minimum = least_px;
  p.maximum = 4000;
  p.fallback = std::to_string(static_cast<int>(fallback_px));
  return p;
}

double size_px_of(const Arguments& arguments, double fallback_px) {
  return argument(arguments, "size_px").value_or(fallback_px);
}

Series curve_of(std::span<const PictureGroup> groups, std::size_t number) {
  Series series;
  if (groups.size() > 1)
    series.label = groups[number].label.empty() ? "set " + std::to_string(number + 1) : groups[number].label;
  series.color = color_of_class(number);
  series.dash_px = dash_px_of_class(number);
  return series;
}

std::size_t columns_of(std::size_t panels) {
  if (panels <= 3) return panels;
  return static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(panels))));
}

}  // namespace wellspaced

#include "core/render/pictures/pictures.h"

#include <algorithm>
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

double image_side_px(double size_px, double across) {
  return size_px < across ? size_px : std::round(size_px / across) * across;
}

SheetSize chart_size(double frame_width_px, double frame_height_px) {
  return {frame_width_px + beside_frame_px, frame_height_px + around_frame_px};
}

SheetSize sheet_of(const SheetSize& panel, std::size_t panels, std::size_t columns) {
  constexpr double caption_px = 26, below_px = 44, below_width_px = 330, margin_px = 16;
  columns = std::min(columns, panels);
  const auto across = static_cast<double>(columns),
             down = static_cast<double>((panels + columns - 1) / columns);
  return {std::max(below_width_px, across * panel.width_px + (across - 1) * panel_gap_px) + 2 * margin_px,
          down * (panel.height_px + caption_px) + (down - 1) * panel_gap_px + below_px + 2 * margin_px};
}

std::size_t columns_of(std::size_t panels) {
  if (panels <= 3) return panels;
  return static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(panels))));
}

}  // namespace wellspaced

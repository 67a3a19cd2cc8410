#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/analyze/differential.h"
#include "core/analyze/zone_plate.h"
#include "core/registry_measures.h"
#include "core/render/chart.h"
#include "core/render/pictures/rows.h"
#include "core/render/raster.h"

namespace wellspaced {
namespace {

constexpr double plate_px = 500, domain_px = 380, domain_shape = 0.45, numbers_px = 28;

/// Rows from the top, of values whose row 0 is at the bottom.
Raster upright(std::size_t columns, std::size_t rows, const std::vector<double>& values) {
  Raster raster{columns, rows, {}};
  raster.values.reserve(values.size());
  for (std::size_t y = rows; y-- > 0;)
    raster.values.insert(raster.values.end(), values.begin() + static_cast<std::ptrdiff_t>(y * columns),
                         values.begin() + static_cast<std::ptrdiff_t>((y + 1) * columns));
  return raster;
}

// ---- zone plate

Drawing plate_of(const PictureGroup& group, const ZonePlateOptions& options, double size_px,
                 const Control& control) {
  const PointSet& set = group.sets.front();
  const ZonePlate plate = zone_plate(set, options, control);
  const Box box = set.domain->box();
  const double longer = std::max(box.size.x, box.size.y);
  // A pixel of the plate is a whole number of the picture's, so that none looks wider than the others.
  const double across = static_cast<double>(std::max(plate.columns, plate.rows));
  const double whole = std::max(1.0, std::round(size_px / across));
  const double width = size_px < across ? size_px * box.size.x / longer
                                        : whole * static_cast<double>(plate.columns),
               height =
                   size_px < across ? size_px * box.size.y / longer : whole * static_cast<double>(plate.rows);
  Raster raster = upright(plate.columns, plate.rows, plate.pixels);
  if (size_px < across)
    raster = resampled(raster, 0, static_cast<double>(raster.columns), 0, static_cast<double>(raster.rows),
                       static_cast<std::size_t>(std::max(1.0, width)),
                       static_cast<std::size_t>(std::max(1.0, height)));
  Drawing picture{width, height, "zone plate of " + std::to_string(set.size()) + " points",
                  [image = colored(raster, map_gray, 0, 1), width, height](Canvas& canvas) {
                    canvas.image({0, 0, width, height}, image);
                    canvas.rectangle({0, 0, width, height}, {std::nullopt, Pen{ink, 1}});
                  }};
  Drawing numbers = text_rows(
      {std::to_string(set.size()) + " points",
       std::to_string(plate.columns) + " × " + std::to_string(plate.rows) + " pixels",
       "σ = " + number_label(options.sigma, 3) + " √(A/n)", "rmse = " + number_label(plate.rmse, 3)},
      std::max(240.0, width), 13);
  return with_caption(stack_of({std::move(picture), std::move(numbers)}, 8), group.label);
}

Drawing make_zone_plate(std::span<const PictureGroup> groups, const Arguments& arguments,
                        const Control& control) {
  const ZonePlateOptions options = zone_plate_options(arguments);
  const double size_px = size_px_of(arguments, plate_px);
  std::vector<Drawing> panels;
  for (const PictureGroup& group : groups) panels.push_back(plate_of(group, options, size_px, control));
  Drawing function = text_rows(
      {"(1 + cos πkρ^2) / 2,", "k = " + number_label(options.frequency, 3) + " w √(n/A), ρ in widths w"}, 600,
      12);
  return with_margin(
      stack_of({grid_of(std::move(panels), columns_of(groups.size()), panel_gap_px), std::move(function)}, 8),
      16);
}

/// Of plates with the most pixels that their groups' points have.
SheetSize plate_sheet(std::span<const SetsSize> groups, const Arguments& arguments) {
  const double size_px = size_px_of(arguments, plate_px);
  const auto asked = zone_plate_options(arguments).columns;
  constexpr double numbers_width_px = 210;
  SheetSize panel{numbers_width_px, 0};
  for (const SetsSize& group : groups) {
    const double mean = std::round(std::sqrt(group.n / group.height_over_width)),
                 most = ZonePlateOptions::most_columns,
                 columns = asked ? *asked : std::clamp(mean, 1.0, most);
    const double rows = std::max(1.0, std::round(columns * group.height_over_width)),
                 across = std::max(columns, rows), side_px = image_side_px(size_px, across);
    panel.width_px = std::max(panel.width_px, side_px * columns / across);
    panel.height_px = std::max(panel.height_px, side_px * rows / across + numbers_px);
  }
  return sheet_of(panel, groups.size(), columns_of(groups.size()));
}

// ---- differential domain

DifferentialDomain mean_domain(const PictureGroup& group, const DifferentialOptions& options,
                               const Control& control) {
  std::vector<DifferentialDomain> all;
  for (const PointSet& set : group.sets)
    all.push_back(differential_domain(set, radii_of(set, group.sizing), options, control));
  return average(all);
}

Drawing domain_image(const DifferentialDomain& d, double size_px) {
  const auto side = static_cast<std::size_t>(d.size);
  Chart chart;
  chart.width_px = chart.height_px = image_side_px(size_px, static_cast<double>(side));
  chart.x = {-d.reach, d.reach, "d_x / d_{hex}"};
  chart.y = {-d.reach, d.reach, "d_y / d_{hex}"};
  chart.image = colored(upright(side, side, d.density), map_gray, 0, 3);
  return draw(std::move(chart));
}

Drawing domain_curve(const DifferentialDomain& d, double size_px, double high) {
  Chart chart;
  chart.width_px = size_px;
  chart.height_px = domain_shape * size_px;
  Series series;
  series.x = d.r;
  series.y = d.mean;
  chart.series = {std::move(series)};
  chart.x = {0, d.reach, "|d| / d_{hex}"};
  chart.y = {0, high, "radial mean"};
  chart.references = {{std::nullopt, 1, "white noise"}};
  return draw(std::move(chart));
}

Drawing make_differential(std::span<const PictureGroup> groups, const Arguments& arguments,
                          const Control& control) {
  const DifferentialOptions options = differential_options(arguments);
  const double size_px = size_px_of(arguments, domain_px);
  std::vector<DifferentialDomain> domains;
  std::vector<Series> means(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    domains.push_back(mean_domain(groups[g], options, control));
    means[g].y = domains[g].mean;
  }
  const double high = round_high(means, 1.8, 12);
  std::vector<Drawing> panels;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Drawing image = domain_image(domains[g], size_px);
    Drawing curve = domain_curve(domains[g], image.width_px - beside_frame_px, high);
    Drawing panel = stack_of({std::move(image), std::move(curve)}, 6);
    panel.title = "differential domain of " + std::to_string(groups[g].sets.front().size()) + " points";
    panels.push_back(with_caption(std::move(panel), groups[g].label));
  }
  Drawing bar = color_bar(
      map_gray, {0, 3, "density (white noise: 1)", {{0, "0"}, {1, "1"}, {2, "2"}, {3, "≥ 3"}}}, 220);
  return with_margin(
      stack_of({grid_of(std::move(panels), columns_of(groups.size()), panel_gap_px), std::move(bar)}, 8), 16);
}

SheetSize domain_sheet(std::span<const SetsSize> groups, const Arguments& arguments) {
  const double side_px =
      image_side_px(size_px_of(arguments, domain_px), differential_options(arguments).pixels);
  SheetSize panel = chart_size(side_px, side_px);
  panel.height_px += chart_size(side_px, domain_shape * side_px).height_px;
  return sheet_of(panel, groups.size(), columns_of(groups.size()));
}

}  // namespace

Picture zone_plate_picture() {
  Picture picture;
  picture.name = "zone-plate";
  picture.title = "Zone plate";
  picture.description =
      "Rings that get finer outwards, sampled at the points and reconstructed by a Gaussian filter; of each "
      "group the "
      "first set.";
  picture.parameters = zone_plate_parameters();
  picture.parameters.push_back(size_parameter(plate_px));
  picture.make = make_zone_plate;
  picture.averages = false;
  picture.cost = [](const SetsSize& size, const Arguments& arguments) {
    return zone_plate_cost(size.n, size.height_over_width, zone_plate_options(arguments));
  };
  picture.sheet = plate_sheet;
  picture.check = [](const Domain& domain, double n, const Arguments& arguments) {
    require_options(zone_plate_options(arguments), domain, static_cast<std::size_t>(n));
  };
  picture.needs_torus = true;
  return picture;
}

Picture differential_picture() {
  Picture picture;
  picture.name = "differential";
  picture.title = "Differential domain";
  picture.description =
      "The density of differences between points, divided by their radii where there is a sizing function, "
      "in two "
      "dimensions and by rings; averaged over the sets of a group.";
  picture.parameters = differential_parameters();
  picture.parameters.push_back(size_parameter(domain_px, least_chart_px));
  picture.make = make_differential;
  picture.cost = [](const SetsSize& size, const Arguments& arguments) {
    const Cost one = differential_cost(size.n, differential_options(arguments));
    return Cost{size.sets * one.seconds, (1 + size.sets / 8) * one.bytes};
  };
  picture.sheet = domain_sheet;
  picture.check = [](const Domain&, double, const Arguments& arguments) {
    require_options(differential_options(arguments));
  };
  picture.needs_torus = true;
  return picture;
}

}  // namespace wellspaced

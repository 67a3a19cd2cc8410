#pragma once

#include <span>
#include <vector>

#include "core/render/chart.h"
#include "core/render/pictures/pictures.h"

namespace wellspaced {

// The registry's rows, in the files that draw them.

Picture voronoi_picture();
Picture delaunay_picture();
Picture points_picture();
Picture periodogram_picture();
Picture spectrum_picture();
Picture pair_correlation_picture();
Picture distributions_picture();
Picture zone_plate_picture();
Picture differential_picture();
Picture convergence_picture();
Picture overview_picture();

// What they share.

/// The samples as black dots, for pictures that show other things beside.
Drawing plain_points(const PointSet& points, double size_px, const Control& control);

Parameter size_parameter(double fallback_px, double least_px = 50);
double size_px_of(const Arguments& arguments, double fallback_px);

/// How a group's curve looks among those of all groups, without its points. The legend names it where there
/// are several.
Series curve_of(std::span<const PictureGroup> groups, std::size_t number);

/// Below that, the axes of a chart have no room for their names.
inline constexpr double least_chart_px = 180;

/// What stands beside what.
inline constexpr double panel_gap_px = 24;

/// The side of an image of so many pixels across: each becomes a whole number of the picture's, so that none
/// looks wider than the others, unless there are too many.
double image_side_px(double size_px, double across);

// How large things get, without what is in them.

/// Of a chart with that frame.
SheetSize chart_size(double frame_width_px, double frame_height_px);
/// Of panels in a grid with a line above each, something below all, and a margin.
SheetSize sheet_of(const SheetSize& panel, std::size_t panels, std::size_t columns);

/// How many panels stand side by side, in pictures about as wide as they are high.
std::size_t columns_of(std::size_t panels);

}  // namespace wellspaced

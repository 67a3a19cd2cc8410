#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/control.h"
#include "core/render/canvas.h"

namespace wellspaced {

/// A picture that is still to be drawn, on whatever canvas. What it was made of, point sets and a control,
/// has to be there until then.
struct Drawing {
  double width_px = 0, height_px = 0;
  std::string title;  ///< for readers who can't see it
  std::function<void(Canvas&)> draw;
};

/// SVG text without ids, so that several can stand in one page. Errors: cancelled, deadline_exceeded.
/// Determinism: the same bytes everywhere, but for the zlib at hand in images.
std::string to_svg(const Drawing& drawing, const Control& control);

inline constexpr double most_png_pixels = 5e7;

/// PNG with `scale` pixels for each of the drawing's. Errors: too_large at /scale for more than
/// most_png_pixels; cancelled, deadline_exceeded: it stops within the shape or the row of pixels that it is
/// at. Determinism: whole numbers throughout, so the same bytes on any CPU; the compression is that of the
/// zlib at hand.
std::string to_png(const Drawing& drawing, double scale, const Control& control);

/// Drawings in rows of so many, each in the middle of a place as large as the largest.
Drawing grid_of(std::vector<Drawing> panels, std::size_t columns, double gap_px);

/// Drawings below each other, from the left.
Drawing stack_of(std::vector<Drawing> parts, double gap_px);

/// With a line of text above it, as much of it as fits; it may be empty: then there is none.
Drawing with_caption(Drawing drawing, const std::string& caption);

/// With a margin on each side.
Drawing with_margin(Drawing drawing, double margin_px);

}  // namespace wellspaced

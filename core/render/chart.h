#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/render/drawing.h"

namespace wellspaced {

struct Tick {
  double value = 0;
  std::string text;
};

struct Axis {
  double low = 0, high = 1;
  std::string title;
  std::vector<Tick> ticks = {};  ///< none: round numbers
};

/// About `count` round numbers from low to high. Requires: low < high.
std::vector<Tick> round_ticks(double low, double high, int count);

struct Series {
  enum class Kind { line, steps };  ///< steps: y[i] from x[i] to x[i + 1], one more x than y, filled faintly

  std::string label;  ///< for the legend; empty: none
  std::vector<double> x, y;
  Kind kind = Kind::line;
  double fill = 0.16;  ///< opacity of what is below steps
  Rgb color = color_of_class(0);
  double dash_px = 0;
  bool marks = false;  ///< a dot at each point of a line
};

/// A line across the whole frame.
struct Reference {
  std::optional<double> x, y;  ///< one of them
  std::string label;
  Align align = Align::start;  ///< the side at which a horizontal one has its label
};

/// A frame with curves: what is outside of the axes' ranges or not finite is not shown.
struct Chart {
  double width_px = 440, height_px = 260;  ///< of the frame; ticks and titles come on top
  Axis x, y;
  std::vector<Series> series;
  std::vector<Reference> references;
  std::string title;
  std::optional<Image> image = {};  ///< fills the frame
  bool legend = true;               ///< of the series that have labels
};

/// What a chart without title and legend has beside its frame, and above and below it.
inline constexpr double beside_frame_px = 78, around_frame_px = 58;

Drawing draw(Chart chart);

/// The legend of several charts with the same series, in rows of at most that width.
Drawing legend_of(const std::vector<Series>& series, double width_px);

/// With the legend above, if there is any.
Drawing with_legend(Drawing drawing, const std::vector<Series>& series);

/// Where an axis from 0 may end: somewhat above the largest finite value and at `least`, a round number; not
/// above `most`.
double round_high(const std::vector<Series>& series, double least, double most);

/// "0.7071": significant digits, without trailing zeros; "−" for minus.
std::string number_label(double value, int digits);

/// A bar of colors with ticks below and its name beside.
Drawing color_bar(ColorMap map, const Axis& axis, double width_px);

/// Words in rows of at most that width.
Drawing text_rows(std::vector<std::string> items, double width_px, double size_px);

}  // namespace wellspaced

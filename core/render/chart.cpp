#include "core/render/chart.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "core/render/font.h"

namespace wellspaced {
namespace {

constexpr double left_px = 62, right_px = beside_frame_px - left_px, bottom_px = 46,
                 top_px = around_frame_px - bottom_px, tick_size_px = 12, title_size_px = 13,
                 legend_row_px = 20, swatch_px = 22, heading_px = 22;

std::string with_minus(const std::string& text) {
  return text.starts_with('-') ? "−" + text.substr(1) : text;
}

/// With so many digits behind the point.
std::string fixed_text(double value, int decimals) {
  constexpr double longest = 1e15;
  constexpr int most_decimals = 15;
  if (std::abs(value) >= longest || decimals > most_decimals) return number_label(value, 4);
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals);
  std::string text(buffer, end.ptr);
  return with_minus(text == "-0" ? "0" : text);
}

/// What a legend writes, row by row.
struct LegendRows {
  struct Entry {
    Vec2 place;  ///< from the legend's corner
    std::string label;
    Rgb color;
    double dash_px;
  };
  std::vector<Entry> entries;
  double height_px = 0;
};

LegendRows legend_rows(const std::vector<Series>& series, double width_px) {
  const Font font;
  LegendRows rows;
  double x = 0, y = 0;
  for (const Series& s : series) {
    if (s.label.empty()) continue;
    const std::string label = fitted(font, s.label, tick_size_px, width_px - swatch_px - 6);
    const double width = swatch_px + 6 + font.width_px(label, tick_size_px) + 18;
    if (x > 0 && x + width > width_px) {
      x = 0;
      y += legend_row_px;
    }
    rows.entries.push_back({{x, y}, label, s.color, s.dash_px});
    x += width;
  }
  rows.height_px = rows.entries.empty() ? 0 : y + legend_row_px;
  return rows;
}

/// What is left to be seen of a curve whose points lie closer than pixels: where it comes into a column, goes
/// out of it, and how far up and down it goes in between.
std::vector<Vec2> thinned(std::span<const Vec2> points) {
  const auto column = [](Vec2 p) { return std::floor(p.x); };
  const auto higher = [](Vec2 a, Vec2 b) { return a.y < b.y; };
  std::vector<Vec2> kept;
  for (auto first = points.begin(); first != points.end();) {
    const auto end = std::find_if(first, points.end(), [&](Vec2 p) { return column(p) != column(*first); });
    const auto [top, bottom] = std::minmax_element(first, end, higher);
    for (auto p = first; p != end; ++p)
      if (p == first || p == top || p == bottom || p + 1 == end) kept.push_back(*p);
    first = end;
  }
  return kept;
}

class Painter {
 public:
  Painter(const Chart& chart, const Area& frame, Canvas& canvas)
      : chart_(chart), frame_(frame), canvas_(canvas) {}

  void paint() {
    axes();
    canvas_.clip(frame_);
    if (chart_.image) canvas_.image(frame_, *chart_.image);
    for (const Series& s : chart_.series)
      if (s.kind == Series::Kind::steps) steps(s);
    for (const Reference& r : chart_.references) reference(r);
    for (const Series& s : chart_.series)
      if (s.kind == Series::Kind::line) line(s);
    canvas_.unclip();
    for (const Reference& r : chart_.references) reference_label(r);
    canvas_.rectangle(frame_, {std::nullopt, Pen{ink, 1}});
  }

 private:
  double x_px(double x) const {
    return frame_.x + (x - chart_.x.low) / (chart_.x.high - chart_.x.low) * frame_.width;
  }
  double y_px(double y) const {
    return frame_.bottom() - (y - chart_.y.low) / (chart_.y.high - chart_.y.low) * frame_.height;
  }
  /// Far outside of the frame is near enough.
  Vec2 place(double x, double y) const {
    return {std::clamp(x_px(x), frame_.x - 1e4, frame_.right() + 1e4),
            std::clamp(y_px(y), frame_.y - 1e4, frame_.bottom() + 1e4)};
  }

  static std::vector<Tick> ticks_of(const Axis& axis, int count) {
    return axis.ticks.empty() ? round_ticks(axis.low, axis.high, count) : axis.ticks;
  }

  void axes() {
    const std::vector<Tick> across = ticks_of(chart_.x, std::max(3, static_cast<int>(frame_.width / 62))),
                            up = ticks_of(chart_.y, std::max(4, static_cast<int>(frame_.height / 44)));
    for (const Tick& t : across)
      canvas_.line({x_px(t.value), frame_.y}, {x_px(t.value), frame_.bottom()}, {grid_ink, 1});
    for (const Tick& t : up)
      canvas_.line({frame_.x, y_px(t.value)}, {frame_.right(), y_px(t.value)}, {grid_ink, 1});
    for (const Tick& t : across)
      canvas_.text({x_px(t.value), frame_.bottom() + 16}, t.text, {tick_size_px, ink, Align::middle});
    for (const Tick& t : up)
      canvas_.text({frame_.x - 6, y_px(t.value) + 4}, t.text, {tick_size_px, ink, Align::end});
    canvas_.text({frame_.x + frame_.width / 2, frame_.bottom() + 36}, chart_.x.title,
                 {title_size_px, ink, Align::middle});
    canvas_.text({frame_.x - 46, frame_.y + frame_.height / 2}, chart_.y.title,
                 {title_size_px, ink, Align::middle, true});
  }

  /// Whether a point, or the line to a neighbor in x, may show.
  bool may_show(const Series& s, std::size_t i) const {
    const double before = i == 0 ? s.x[i] : s.x[i - 1], after = i + 1 == s.x.size() ? s.x[i] : s.x[i + 1];
    return after >= chart_.x.low && before <= chart_.x.high;
  }

  void line(const Series& s) {
    std::vector<Vec2> points;
    const auto flush = [&] {
      points = thinned(points);
      if (points.size() > 1) canvas_.polyline(points, {std::nullopt, Pen{s.color, 1.6, s.dash_px}});
      if (s.marks || points.size() == 1)  // which has no line to be seen by
        for (const Vec2 p : points) canvas_.circle(p, 2.2, {s.color, std::nullopt});
      points.clear();
    };
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (std::isfinite(s.y[i]) && may_show(s, i))
        points.push_back(place(s.x[i], s.y[i]));
      else
        flush();
    }
    flush();
  }

  void steps(const Series& s) {
    if (s.y.empty()) return;
    std::vector<Vec2> outline = {place(s.x.front(), 0)};
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      outline.push_back(place(s.x[i], s.y[i]));
      outline.push_back(place(s.x[i + 1], s.y[i]));
    }
    outline.push_back(place(s.x.back(), 0));
    outline = thinned(outline);
    if (s.fill > 0) canvas_.polygon(outline, {s.color, std::nullopt, s.fill});
    canvas_.polyline(outline, {std::nullopt, Pen{s.color, 1.6, s.dash_px}});
  }

  void reference(const Reference& r) {
    const Pen pen{faint_ink, 1, 4};
    if (r.y) canvas_.line({frame_.x, y_px(*r.y)}, {frame_.right(), y_px(*r.y)}, pen);
    if (r.x) canvas_.line({x_px(*r.x), frame_.y}, {x_px(*r.x), frame_.bottom()}, pen);
  }

  void reference_label(const Reference& r) {
    if (r.y && *r.y <= chart_.y.high && *r.y >= chart_.y.low)
      canvas_.text({r.align == Align::end ? frame_.right() - 5 : frame_.x + 5, y_px(*r.y) - 4}, r.label,
                   {11, faint_ink, r.align, false, false, true});
    if (r.x && *r.x <= chart_.x.high && *r.x >= chart_.x.low)
      canvas_.text({x_px(*r.x) + 4, frame_.y + 13}, r.label,
                   {11, faint_ink, Align::start, false, false, true});
  }

  const Chart& chart_;
  const Area& frame_;
  Canvas& canvas_;
};

void paint_legend(const LegendRows& rows, Vec2 at, Canvas& canvas) {
  for (const LegendRows::Entry& entry : rows.entries) {
    const Vec2 from = at + entry.place + Vec2{0, 9};
    canvas.line(from, from + Vec2{swatch_px, 0}, {entry.color, 2.4, entry.dash_px});
    canvas.text(from + Vec2{swatch_px + 6, 4}, entry.label, {tick_size_px, ink, Align::start, false, true});
  }
}

}  // namespace

std::string number_label(double value, int digits) {
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value + 0.0, std::chars_format::general, digits);
  return with_minus(std::string(buffer, end.ptr));
}

std::vector<Tick> round_ticks(double low, double high, int count) {
  double unit = 1;
  int decimals = 0;
  const double least = 1e-12 * std::max({std::abs(low), std::abs(high), 1e-290});
  const double wanted = std::max((high - low) / count, least);
  for (; unit > wanted; unit /= 10) ++decimals;
  for (; unit * 10 <= wanted; unit *= 10) --decimals;
  double step = unit;
  for (const double factor : {2.0, 5.0, 10.0})
    if (step < wanted * (1 - 1e-9)) step = factor * unit;
  if (step >= 9.99 * unit) --decimals;
  std::vector<Tick> ticks;
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  constexpr int most_ticks = 100;
  for (int i = 0; first + i <= last && i < most_ticks; ++i) {
    const double k = first + i;
    const double value = k * step + 0.0;  // no zero with a sign
    ticks.push_back({value, fixed_text(value, std::max(0, decimals))});
  }
  return ticks;
}

double round_high(const std::vector<Series>& series, double least, double most) {
  double high = least;
  for (const Series& s : series)
    for (const double y : s.y)
      if (std::isfinite(y)) high = std::max(high, y);
  if (high >= most) return most;
  const double low = 0, step = round_ticks(low, 1.04 * high, 6)[1].value;
  return std::min(most, std::ceil(1.04 * high / step) * step);
}

Drawing draw(Chart chart) {
  const double heading = chart.title.empty() ? 0 : heading_px;
  const double legend = chart.legend ? legend_rows(chart.series, chart.width_px).height_px : 0;
  const Area frame{left_px, top_px + heading + legend, chart.width_px, chart.height_px};
  Drawing drawing{left_px + chart.width_px + right_px, frame.bottom() + bottom_px, chart.title, {}};
  drawing.draw = [chart = std::move(chart), frame, heading](Canvas& canvas) {
    canvas.text({frame.x + frame.width / 2, top_px + 8}, chart.title, {14, ink, Align::middle});
    if (chart.legend)
      paint_legend(legend_rows(chart.series, chart.width_px), {frame.x, top_px - 4 + heading}, canvas);
    Painter(chart, frame, canvas).paint();
  };
  return drawing;
}

Drawing legend_of(const std::vector<Series>& series, double width_px) {
  return {width_px, legend_rows(series, width_px).height_px, "", [series, width_px](Canvas& canvas) {
            paint_legend(legend_rows(series, width_px), {left_px, 0}, canvas);
          }};
}

Drawing with_legend(Drawing drawing, const std::vector<Series>& series) {
  Drawing legend = legend_of(series, drawing.width_px - left_px);
  if (legend.height_px == 0) return drawing;
  return stack_of({std::move(legend), std::move(drawing)}, 0);
}

Drawing color_bar(ColorMap map, const Axis& axis, double width_px) {
  constexpr double height_px = 13;
  const Font font;
  const double name_px = font.width_px(text_runs(axis.title, false), title_size_px);
  Drawing bar{width_px + 14 + name_px, 34, "", {}};
  bar.draw = [map, axis, width_px](Canvas& canvas) {
    Image colors{256, 1, {}};
    for (std::size_t i = 0; i < colors.columns; ++i) {
      const Rgb c = color_at(map, static_cast<double>(i) / 255);
      for (const double channel : {c.r, c.g, c.b})
        colors.rgb.push_back(static_cast<std::uint8_t>(channel + 0.5));
    }
    canvas.image({0, 0, width_px, height_px}, colors);
    canvas.rectangle({0, 0, width_px, height_px}, {std::nullopt, Pen{faint_ink, 0.8}});
    const std::vector<Tick> ticks = axis.ticks.empty() ? round_ticks(axis.low, axis.high, 5) : axis.ticks;
    for (const Tick& tick : ticks) {
      const double t = (tick.value - axis.low) / (axis.high - axis.low);
      canvas.line({t * width_px, height_px}, {t * width_px, height_px + 4}, {ink, 1});
      const Align align = t < 0.02 ? Align::start : t > 0.98 ? Align::end : Align::middle;
      canvas.text({t * width_px, height_px + 17}, tick.text, {tick_size_px, ink, align});
    }
    canvas.text({width_px + 14, height_px - 1}, axis.title, {title_size_px, ink});
  };
  return bar;
}

Drawing text_rows(std::vector<std::string> items, double width_px, double size_px) {
  const double gap_px = 1.2 * size_px;
  const Font font;
  std::vector<std::pair<Vec2, std::string>> places;
  double x = 0, y = size_px, widest = 0;
  for (std::string& item : items) {
    const double width = font.width_px(text_runs(item, false), size_px);
    if (x > 0 && x + width > width_px) {
      x = 0;
      y += 1.45 * size_px;
    }
    places.emplace_back(Vec2{x, y}, std::move(item));
    widest = std::max(widest, x + width);
    x += width + gap_px;
  }
  Drawing rows{widest, y + 0.4 * size_px, "", {}};
  rows.draw = [places = std::move(places), size_px](Canvas& canvas) {
    for (const auto& [at, text] : places) canvas.text(at, text, {size_px, ink});
  };
  return rows;
}

}  // namespace wellspaced

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_STROKER_H

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "core/render/drawing.h"
#include "core/render/font.h"
#include "core/render/png.h"

namespace wellspaced {
namespace {

constexpr std::size_t most_outline_points = 30'000;  // FreeType counts them in 16 bits

/// Device pixels in 64ths, y up, as FreeType wants them.
FT_Vector to_fixed(Vec2 p) {
  const auto fixed = [](double x) -> FT_Pos { return std::lround(std::clamp(x, -1e6, 1e6) * 64); };
  return {fixed(p.x), -fixed(p.y)};
}

/// Contours for FreeType's rasterizer.
class Outline final : public GlyphPen {
 public:
  explicit Outline(double scale) : scale_(scale) {}

  void move_to(Vec2 p) override {
    close();
    add(p, FT_CURVE_TAG_ON);
  }
  void line_to(Vec2 p) override { add(p, FT_CURVE_TAG_ON); }
  void curve_to(Vec2 control, Vec2 p) override {
    add(control, FT_CURVE_TAG_CONIC);
    add(p, FT_CURVE_TAG_ON);
  }
  /// Third degree.
  void cubic_to(Vec2 a, Vec2 b, Vec2 p) {
    add(a, FT_CURVE_TAG_CUBIC);
    add(b, FT_CURVE_TAG_CUBIC);
    add(p, FT_CURVE_TAG_ON);
  }

  void clear() {
    points_.clear();
    tags_.clear();
    ends_.clear();
  }

  std::vector<FT_Vector>& points() { return points_; }

  /// Good until the outline changes.
  FT_Outline view() {
    close();
    FT_Outline outline{};
    outline.n_points = static_cast<decltype(outline.n_points)>(points_.size());
    outline.n_contours = static_cast<decltype(outline.n_contours)>(ends_.size());
    outline.points = points_.data();
    outline.tags = tags_.data();
    outline.contours = ends_.data();
    return outline;
  }

 private:
  using Tag = std::remove_pointer_t<decltype(FT_Outline::tags)>;
  using End = std::remove_pointer_t<decltype(FT_Outline::contours)>;

  void add(Vec2 p, int tag) {
    points_.push_back(to_fixed(scale_ * p));
    tags_.push_back(static_cast<Tag>(tag));
  }
  void close() {
    const std::size_t begun = ends_.empty() ? 0 : static_cast<std::size_t>(ends_.back()) + 1;
    if (points_.size() > begun) ends_.push_back(static_cast<End>(points_.size() - 1));
  }

  double scale_;
  std::vector<FT_Vector> points_;
  std::vector<Tag> tags_;
  std::vector<End> ends_;
};

/// Calls draw(piece) for the pieces of a line that are drawn, where dashes and gaps are of one length.
template <class Draw>
void for_each_dash(std::span<const Vec2> points, double dash, const Draw& draw) {
  double left = dash;
  bool on = true;
  std::vector<Vec2> piece = {points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    Vec2 at = points[i - 1];
    double way = norm(points[i] - at);
    while (way > left) {
      at = at + (left / way) * (points[i] - at);
      way -= left;
      left = dash;
      piece.push_back(at);
      if (on) draw(piece);
      on = !on;
      piece = {at};
    }
    left -= way;
    piece.push_back(points[i]);
  }
  if (on) draw(piece);
}

class PngCanvas final : public Canvas {
 public:
  PngCanvas(const Drawing& drawing, double scale, const Control& control)
      : control_(control), scale_(scale), outline_(scale) {
    image_.columns = static_cast<std::size_t>(std::ceil(drawing.width_px * scale));
    image_.rows = static_cast<std::size_t>(std::ceil(drawing.height_px * scale));
    image_.rgb.assign(3 * image_.columns * image_.rows, 255);
    unclip();
    if (FT_Init_FreeType(&library_) != 0) throw Error(ErrorCode::internal, "no FreeType");
    if (FT_Stroker_New(library_, &stroker_) != 0) {
      FT_Done_FreeType(library_);
      throw Error(ErrorCode::internal, "no stroker");
    }
  }
  ~PngCanvas() override {
    FT_Stroker_Done(stroker_);
    FT_Done_FreeType(library_);
  }
  PngCanvas(const PngCanvas&) = delete;
  PngCanvas& operator=(const PngCanvas&) = delete;

  void unclip() override {
    clip_ = {0, 0, static_cast<FT_Pos>(image_.columns), static_cast<FT_Pos>(image_.rows)};
  }

  std::string finish() const { return write_png(image_, 96 * scale_, control_); }

 private:
  /// In device pixels, y down.
  struct Clip {
    FT_Pos left, top, right, bottom;
  };

  void paint_path(std::span<const Vec2> points, bool closed, const Paint& paint) override {
    if (points.size() < 2) return;
    if (closed && paint.fill) {
      outline_.clear();
      outline_.move_to(points.front());
      for (const Vec2 p : points.subspan(1)) outline_.line_to(p);
      fill(*paint.fill, paint.opacity);
    }
    if (paint.pen) stroke(points, closed, *paint.pen, paint.opacity);
  }

  void paint_circle(Vec2 c, double r, const Paint& paint) override {
    constexpr double k = 0.5522847498307936;  // a quarter of a circle as a curve of the third degree
    outline_.clear();
    outline_.move_to({c.x + r, c.y});
    outline_.cubic_to({c.x + r, c.y + k * r}, {c.x + k * r, c.y + r}, {c.x, c.y + r});
    outline_.cubic_to({c.x - k * r, c.y + r}, {c.x - r, c.y + k * r}, {c.x - r, c.y});
    outline_.cubic_to({c.x - r, c.y - k * r}, {c.x - k * r, c.y - r}, {c.x, c.y - r});
    outline_.cubic_to({c.x + k * r, c.y - r}, {c.x + r, c.y - k * r}, {c.x + r, c.y});
    if (paint.fill) fill(*paint.fill, paint.opacity);
    if (!paint.pen) return;
    FT_Outline view = outline_.view();
    FT_Stroker_ParseOutline(with_pen(*paint.pen), &view, 0);
    fill_stroke(*paint.pen, paint.opacity);
  }

  void paint_text(Vec2 at, std::span<const TextRun> runs, const TextStyle& style) override {
    const double width = font_.width_px(runs, style.size_px);
    double along = style.align == Align::start ? 0 : style.align == Align::middle ? -width / 2 : -width;
    outline_.clear();
    for (const TextRun& run : runs) {
      const double lift = style.size_px * (run.level > 0 ? run_rise : run.level < 0 ? -run_drop : 0);
      const Vec2 base = style.upward ? Vec2{at.x - lift, at.y - along} : Vec2{at.x + along, at.y - lift};
      const double size = run_size_px(run, style.size_px);
      font_.outline(run.text, size, base, style.upward, outline_);
      along += font_.width_px(run.text, size);
    }
    if (style.halo && !outline_.points().empty()) {
      FT_Outline view = outline_.view();
      FT_Stroker_ParseOutline(with_pen({paper, 2 * halo_px}), &view, 0);
      fill_stroke({paper, 2 * halo_px}, 1);
    }
    fill(style.color, 1);
  }

  void paint_image(const Area& area, const Image& image) override {
    const auto edge = [&](double x) { return static_cast<FT_Pos>(std::lround(x * scale_)); };
    const FT_Pos left = edge(area.x), top = edge(area.y), right = edge(area.right()),
                 bottom = edge(area.bottom());
    for (FT_Pos y = std::max(top, clip_.top); y < std::min(bottom, clip_.bottom); ++y) {
      control_.check();
      const auto row =
          static_cast<std::size_t>(y - top) * image.rows / static_cast<std::size_t>(bottom - top);
      for (FT_Pos x = std::max(left, clip_.left); x < std::min(right, clip_.right); ++x) {
        const auto column =
            static_cast<std::size_t>(x - left) * image.columns / static_cast<std::size_t>(right - left);
        std::copy_n(&image.rgb[3 * (row * image.columns + column)], 3, pixel(x, y));
      }
    }
  }

  void clip_to(const Area& area) override {
    const auto edge = [&](double x, std::size_t most) {
      return std::clamp<FT_Pos>(std::lround(x * scale_), 0, static_cast<FT_Pos>(most));
    };
    clip_ = {edge(area.x, image_.columns), edge(area.y, image_.rows), edge(area.right(), image_.columns),
             edge(area.bottom(), image_.rows)};
  }

  std::uint8_t* pixel(FT_Pos x, FT_Pos y) {
    return &image_.rgb[3 * (static_cast<std::size_t>(y) * image_.columns + static_cast<std::size_t>(x))];
  }

  FT_Stroker with_pen(const Pen& pen) {
    FT_Stroker_Set(stroker_, std::max<FT_Fixed>(1, std::lround(pen.width_px * scale_ * 32)),
                   FT_STROKER_LINECAP_BUTT, FT_STROKER_LINEJOIN_ROUND, 0);
    return stroker_;
  }

  /// How many points of a line to stroke at a time. FreeType can't be stopped meanwhile, and takes long for
  /// lines that go up and down over the same pixels.
  std::size_t most_at_once(std::span<const Vec2> points) const {
    constexpr std::size_t most_points = 256;
    const double most_rows = 2 * static_cast<double>(std::max<std::size_t>(image_.rows, 100));
    double rows = 0;
    std::size_t k = 1;
    for (; k < points.size() && k < most_points && (k < 2 || rows < most_rows); ++k)
      rows += scale_ * std::abs(points[k].y - points[k - 1].y);
    return k;
  }

  void stroke(std::span<const Vec2> points, bool closed, const Pen& pen, double opacity) {
    if (pen.dash_px > 0) {
      for_each_dash(points, pen.dash_px, [&](std::span<const Vec2> piece) {
        stroke(piece, false, {pen.color, pen.width_px, 0}, opacity);
      });
      return;
    }
    if (closed && points.size() > most_at_once(points)) {
      std::vector<Vec2> around(points.begin(), points.end());
      around.push_back(points.front());
      return stroke(around, false, pen, opacity);
    }
    if (points.size() > most_at_once(points)) {
      for (std::size_t from = 0; from + 1 < points.size();) {
        const auto piece = points.subspan(from, most_at_once(points.subspan(from)));
        stroke(piece, false, pen, opacity);
        from += piece.size() - 1;
      }
      return;
    }
    line_.clear();
    for (const Vec2 p : points) {
      const FT_Vector at = to_fixed(scale_ * p);
      if (line_.empty() || at.x != line_.back().x || at.y != line_.back().y) line_.push_back(at);
    }
    if (line_.size() < 2) return;  // FreeType can't stroke what has no length
    with_pen(pen);
    FT_Stroker_BeginSubPath(stroker_, line_.data(), closed ? 0 : 1);
    for (std::size_t i = 1; i < line_.size(); ++i) FT_Stroker_LineTo(stroker_, &line_[i]);
    FT_Stroker_EndSubPath(stroker_);
    fill_stroke(pen, opacity);
  }

  /// What the stroker has made.
  void fill_stroke(const Pen& pen, double opacity) {
    control_.check();
    FT_UInt points = 0, contours = 0;
    FT_Outline border{};
    if (FT_Stroker_GetCounts(stroker_, &points, &contours) != 0 || points > most_outline_points) return;
    if (FT_Outline_New(library_, points, static_cast<FT_Int>(contours), &border) != 0) return;
    border.n_points = 0;
    border.n_contours = 0;
    FT_Stroker_Export(stroker_, &border);
    render(border, pen.color, opacity);
    FT_Outline_Done(library_, &border);
  }

  void fill(Rgb color, double opacity) {
    control_.check();
    if (outline_.points().empty() || outline_.points().size() > most_outline_points) return;
    FT_Outline view = outline_.view();
    render(view, color, opacity);
  }

  void render(FT_Outline& outline, Rgb color, double opacity) {
    color_ = color;
    opacity_ = opacity;
    FT_Raster_Params params{};
    params.flags = FT_RASTER_FLAG_AA | FT_RASTER_FLAG_DIRECT | FT_RASTER_FLAG_CLIP;
    params.user = this;
    params.gray_spans = [](int y, int count, const FT_Span* spans, void* user) {
      static_cast<PngCanvas*>(user)->blend(-y - 1, std::span(spans, static_cast<std::size_t>(count)));
    };
    params.clip_box = {clip_.left, -clip_.bottom, clip_.right, -clip_.top};
    FT_Outline_Render(library_, &outline, &params);
  }

  void blend(FT_Pos y, std::span<const FT_Span> spans) {
    if (y < clip_.top || y >= clip_.bottom) return;
    const std::array<double, 3> color = {color_.r, color_.g, color_.b};
    for (const FT_Span& span : spans) {
      const int alpha = static_cast<int>(span.coverage * opacity_ + 0.5);
      const FT_Pos end = std::min<FT_Pos>(span.x + span.len, clip_.right);
      for (FT_Pos x = std::max<FT_Pos>(span.x, clip_.left); x < end; ++x) {
        std::uint8_t* to = pixel(x, y);
        for (std::size_t c = 0; c < 3; ++c) {
          const int from = to[c], wanted = static_cast<int>(color[c] + 0.5);
          to[c] = static_cast<std::uint8_t>((from * (255 - alpha) + wanted * alpha + 127) / 255);
        }
      }
    }
  }

  const Control& control_;
  double scale_;
  Image image_;
  Clip clip_{};
  Outline outline_;
  std::vector<FT_Vector> line_;  ///< scratch
  Font font_;
  FT_Library library_ = nullptr;
  FT_Stroker stroker_ = nullptr;
  Rgb color_;
  double opacity_ = 1;
};

}  // namespace

std::string to_png(const Drawing& drawing, double scale, const Control& control) {
  if (!(drawing.width_px * drawing.height_px * scale * scale <= most_png_pixels))
    throw Error(ErrorCode::too_large,
                "this would be a picture of more than fifty million pixels; ask for a smaller scale or size",
                "/scale");
  control.check();
  PngCanvas canvas(drawing, scale, control);
  drawing.draw(canvas);
  return canvas.finish();
}

}  // namespace wellspaced

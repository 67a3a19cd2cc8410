#include "core/render/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/analyze/spacing.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

constexpr double scale_low = 0.5773502691896258, scale_high = 1.0;
constexpr double legend_px = 64, margin_px = 16;

struct Rgb {
  double r, g, b;
};
/// Dark blue, blue, blue-green, green, olive, amber; interpolated linearly. Lightness rises by about 11 a
/// step, and the last one still shows on white paper.
constexpr std::array<Rgb, 6> anchors = {
    {{48, 28, 96}, {44, 70, 140}, {24, 110, 140}, {36, 142, 110}, {128, 160, 50}, {232, 160, 24}}};

Rgb color_of(double beta_i) {
  const double t =
      std::clamp((beta_i - scale_low) / (scale_high - scale_low), 0.0, 1.0) * (anchors.size() - 1);
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(t), anchors.size() - 2);
  const double s = t - static_cast<double>(k);
  const Rgb &a = anchors[k], &b = anchors[k + 1];
  return {a.r + s * (b.r - a.r), a.g + s * (b.g - a.g), a.b + s * (b.b - a.b)};
}

/// A number that is written with `digits` significant ones.
struct Significant {
  double value;
  int digits;
};

/// SVG text under construction.
class Canvas {
 public:
  Canvas& operator<<(std::string_view text) {
    out_ += text;
    return *this;
  }
  /// A length in pixels, to a hundredth.
  Canvas& operator<<(double x) {
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::fixed, 2);
    std::string_view digits(buffer, static_cast<std::size_t>(end.ptr - buffer));
    digits = digits.substr(0, digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.remove_suffix(1);
    return *this << (digits == "-0" ? "0" : digits);
  }
  Canvas& operator<<(Significant number) {
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, number.value, std::chars_format::general,
                                   number.digits);
    return *this << std::string_view(buffer, static_cast<std::size_t>(end.ptr - buffer));
  }
  Canvas& operator<<(std::size_t n) { return *this << std::string_view(std::to_string(n)); }
  Canvas& operator<<(Rgb color) {
    constexpr char hex[] = "0123456789abcdef";
    out_ += '#';
    for (const double channel : {color.r, color.g, color.b}) {
      const int v = static_cast<int>(channel + 0.5);
      out_ += hex[v / 16];
      out_ += hex[v % 16];
    }
    return *this;
  }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

/// Domain to pixels, y up.
struct View {
  double scale, width_px, height_px;

  View(const Box& box, double longer_side_px)
      : scale(longer_side_px / std::max(box.size.x, box.size.y)),
        width_px(box.size.x * scale),
        height_px(box.size.y * scale) {}
  double x(double domain_x) const { return domain_x * scale; }
  double y(double domain_y) const { return height_px - domain_y * scale; }
};

/// How far something reaches around its sample, in domain lengths.
struct Extent {
  Vec2 low, high;

  void include(Vec2 at) {
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
};

class Painter {
 public:
  Painter(const PointSet& points, const SvgOptions& options, const Control& control)
      : points_(points),
        control_(control),
        box_(points.domain->box()),
        view_(box_, options.size_px),
        spacing_(measure_local_spacing(points, control)),
        stars_(points.size()) {
    visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
      stars_[i].assign(spokes.begin(), spokes.end());
    });
    const double spacing_px = hexagonal_spacing(points.domain->area(), points.size()) * view_.scale;
    sample_px_ = std::clamp(0.08 * spacing_px, 0.4, 4.0);
  }

  std::string paint(Picture picture) {
    open();
    if (picture == Picture::voronoi) cells();
    if (picture == Picture::delaunay) edges();
    samples(picture);
    svg_ << "</g>\n<rect width=\"" << view_.width_px << "\" height=\"" << view_.height_px
         << "\" fill=\"none\" stroke=\"#222\"/>\n";
    legend();
    svg_ << "</g>\n</svg>\n";
    return svg_.take();
  }

 private:
  /// Wide enough for the legend.
  double sheet_px() const { return std::max(view_.width_px, 700.0); }

  void open() {
    const double w = sheet_px() + 2 * margin_px, h = view_.height_px + 2 * margin_px + legend_px;
    svg_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << w << "\" height=\"" << h
         << "\" viewBox=\"0 0 " << w << " " << h << "\" font-family=\"sans-serif\" font-size=\"14\">\n"
         << "<title>" << points_.size() << " points, beta " << Significant{spacing_.global.beta, 4}
         << "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
         << "<clipPath id=\"domain\"><rect width=\"" << view_.width_px << "\" height=\"" << view_.height_px
         << "\"/></clipPath>\n<g transform=\"translate(" << margin_px << " " << margin_px << ")\">\n"
         << "<g clip-path=\"url(#domain)\">\n";
  }

  /// Calls draw(place) for sample i and each periodic image of it that something of this extent around it
  /// brings into the picture.
  template <class Draw>
  void on_all_sides(std::size_t i, const Extent& extent, const Draw& draw) {
    control_.check();
    const Vec3 p = points_[i];
    const auto turns = [](double low, double high, double size) {
      return std::pair{std::ceil(-high / size), std::floor((size - low) / size)};
    };
    const auto [x0, x1] = turns(p.x + extent.low.x, p.x + extent.high.x, box_.size.x);
    const auto [y0, y1] = turns(p.y + extent.low.y, p.y + extent.high.y, box_.size.y);
    for (double ty = y0; ty <= y1; ++ty)
      for (double tx = x0; tx <= x1; ++tx) draw(Vec2{p.x + tx * box_.size.x, p.y + ty * box_.size.y});
  }

  void cells() {
    svg_ << "<g stroke=\"#fff\" stroke-linejoin=\"round\" stroke-width=\""
         << std::clamp(sample_px_ / 3, 0.15, 1.0) << "\">\n";
    std::vector<Vec2> corners;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto& star = stars_[i];
      corners.clear();
      Extent extent;
      for (std::size_t k = 0; k < star.size(); ++k) {
        corners.push_back(circumcenter(star[k].offset, star[k + 1 == star.size() ? 0 : k + 1].offset));
        extent.include(corners.back());
      }
      on_all_sides(i, extent, [&](Vec2 at) {
        svg_ << "<path fill=\"" << color_of(spacing_.beta_i[i]) << "\" d=\"M";
        for (const Vec2 c : corners) svg_ << view_.x(at.x + c.x) << " " << view_.y(at.y + c.y) << " ";
        svg_ << "Z\"/>\n";
      });
    }
    svg_ << "</g>\n";
  }

  void edges() {
    svg_ << "<g stroke-linecap=\"round\" stroke-width=\"" << std::clamp(0.8 * sample_px_, 0.4, 3.0)
         << "\">\n";
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (const Spoke& spoke : stars_[i]) {
        // Each edge is seen from both ends; own images, which have no smaller end, from one direction.
        const bool mine = spoke.id != i ? spoke.id > i
                                        : (spoke.offset.x > 0 || (spoke.offset.x == 0 && spoke.offset.y > 0));
        if (mine) edge(i, spoke);
      }
    svg_ << "</g>\n";
  }

  void edge(std::size_t i, const Spoke& spoke) {
    const Rgb color = color_of(std::max(spacing_.beta_i[i], spacing_.beta_i[spoke.id]));
    Extent extent;
    extent.include(spoke.offset);
    on_all_sides(i, extent, [&](Vec2 at) {
      svg_ << "<path stroke=\"" << color << "\" d=\"M" << view_.x(at.x) << " " << view_.y(at.y) << "L"
           << view_.x(at.x + spoke.offset.x) << " " << view_.y(at.y + spoke.offset.y) << "\"/>\n";
    });
  }

  void samples(Picture picture) {
    const bool alone = picture == Picture::points;
    const double radius_px = alone ? 2.5 * sample_px_ : sample_px_, radius = radius_px / view_.scale;
    svg_ << "<g fill=\"" << (picture == Picture::voronoi ? "#fff" : "#111") << "\">\n";
    for (std::size_t i = 0; i < points_.size(); ++i)
      on_all_sides(i, {{-radius, -radius}, {radius, radius}}, [&](Vec2 at) {
        svg_ << "<circle r=\"" << radius_px;
        if (alone) svg_ << "\" fill=\"" << color_of(spacing_.beta_i[i]);
        svg_ << "\" cx=\"" << view_.x(at.x) << "\" cy=\"" << view_.y(at.y) << "\"/>\n";
      });
    svg_ << "</g>\n";
  }

  void legend() {
    svg_ << "<g fill=\"#222\" transform=\"translate(0 " << view_.height_px + 18 << ")\">\n";
    color_scale();
    numbers();
    svg_ << "</g>\n";
  }

  void color_scale() {
    svg_ << "<linearGradient id=\"scale\">";
    for (std::size_t k = 0; k < anchors.size(); ++k)
      svg_ << "<stop offset=\"" << static_cast<double>(k) / (anchors.size() - 1) << "\" stop-color=\""
           << anchors[k] << "\"/>";
    svg_ << "</linearGradient>\n<rect width=\"" << scale_px << "\" height=\"12\" fill=\"url(#scale)\"/>\n";
    struct Tick {
      double beta_i;
      std::string_view label, anchor;
    };
    constexpr std::array<Tick, 4> ticks = {
        {{scale_low, "1/√3", "start"}, {0.7, "0.7", "middle"}, {0.85, "0.85", "middle"}, {1, "≥ 1", "end"}}};
    for (const Tick& tick : ticks)
      svg_ << "<text font-size=\"12\" text-anchor=\"" << tick.anchor << "\" x=\""
           << (tick.beta_i - scale_low) / (scale_high - scale_low) * scale_px << "\" y=\"27\">" << tick.label
           << "</text>\n";
    svg_ << "<text x=\"" << scale_px + 10 << "\" y=\"11\">β" << subscript("i") << "</text>\n";
  }

  void numbers() {
    const Spacing& s = spacing_.global;
    const std::string_view gap = "<tspan dx=\"16\">";
    svg_ << "<text text-anchor=\"end\" x=\"" << sheet_px() << "\" y=\"11\">" << s.n << " points" << gap
         << "β = " << Significant{s.beta, 4} << "</tspan>" << gap << "r" << subscript("f")
         << "</tspan> = " << Significant{s.r_f, 4} << gap << "r" << subscript("c")
         << "</tspan> = " << Significant{s.r_c, 4} << gap << "ρ = " << Significant{s.rho, 4}
         << "</tspan></text>\n";
  }

  /// Below the line; the caller's text goes on where the next tspan puts it, so it lifts what follows.
  static std::string subscript(const char* letter) {
    return std::string("<tspan font-size=\"10\" dy=\"3\">") + letter +
           "</tspan><tspan dy=\"-3\">&#8203;</tspan>";
  }

  static constexpr double scale_px = 220;

  const PointSet& points_;
  const Control& control_;
  Box box_;
  View view_;
  LocalSpacing spacing_;
  std::vector<std::vector<Spoke>> stars_;
  double sample_px_ = 1;
  Canvas svg_;
};

}  // namespace

std::string render_svg(const PointSet& points, const SvgOptions& options, const Control& control) {
  return Painter(points, options, control).paint(options.picture);
}

}  // namespace wellspaced

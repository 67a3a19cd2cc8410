#include "core/render/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "core/analyze/spacing.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

constexpr double scale_low = 0.5773502691896258, scale_high = 1.0;
constexpr double legend_px = 64, margin_px = 16;

/// Anchors of a perceptually even scale (dark blue, blue-green, green, yellow), interpolated linearly.
struct Rgb {
  double r, g, b;
};
constexpr std::array<Rgb, 6> anchors = {
    {{52, 30, 98}, {56, 82, 139}, {38, 127, 142}, {46, 173, 125}, {137, 211, 74}, {252, 231, 56}}};

Rgb color_of(double beta_i) {
  const double t =
      std::clamp((beta_i - scale_low) / (scale_high - scale_low), 0.0, 1.0) * (anchors.size() - 1);
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(t), anchors.size() - 2);
  const double s = t - static_cast<double>(k);
  const Rgb &a = anchors[k], &b = anchors[k + 1];
  return {a.r + s * (b.r - a.r), a.g + s * (b.g - a.g), a.b + s * (b.b - a.b)};
}

/// SVG text under construction.
class Canvas {
 public:
  Canvas& text(std::string_view t) {
    out_ += t;
    return *this;
  }
  /// Two decimals are a hundredth of a pixel.
  Canvas& number(double x, int decimals = 2) {
    char buffer[64];
    const auto end =
        std::to_chars(buffer, buffer + sizeof buffer, x == 0 ? 0.0 : x, std::chars_format::fixed, decimals);
    std::string_view digits(buffer, static_cast<std::size_t>(end.ptr - buffer));
    if (decimals > 0) {
      digits.remove_suffix(digits.size() - digits.find_last_not_of('0') - 1);
      if (digits.back() == '.') digits.remove_suffix(1);
    }
    out_ += digits == "-0" ? "0" : digits;
    return *this;
  }
  Canvas& color(Rgb c) {
    constexpr char hex[] = "0123456789abcdef";
    out_ += '#';
    for (const double channel : {c.r, c.g, c.b}) {
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

class Painter {
 public:
  Painter(const PointSet& points, const SvgOptions& options, const Control& control)
      : points_(points),
        box_(points.domain->box()),
        view_(box_, options.size_px),
        spacing_(measure_local_spacing(points, control)) {
    stars_.resize(points.size());
    visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
      stars_[i].assign(spokes.begin(), spokes.end());
    });
    sample_px_ =
        std::clamp(0.09 * hexagonal_spacing(points.domain->area(), points.size()) * view_.scale, 0.4, 5.0);
  }

  std::string paint(Picture picture) {
    open();
    if (picture == Picture::voronoi) cells();
    if (picture == Picture::delaunay) edges();
    samples(picture == Picture::points);
    svg_.text("</g>\n<rect width=\"").number(view_.width_px).text("\" height=\"").number(view_.height_px);
    svg_.text("\" fill=\"none\" stroke=\"#222\"/>\n");
    legend();
    svg_.text("</g>\n</svg>\n");
    return svg_.take();
  }

 private:
  void open() {
    const double w = sheet_px() + 2 * margin_px, h = view_.height_px + 2 * margin_px + legend_px;
    svg_.text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"").number(w).text("\" height=\"").number(h);
    svg_.text("\" viewBox=\"0 0 ")
        .number(w)
        .text(" ")
        .number(h)
        .text("\" font-family=\"sans-serif\" font-size=\"14\">\n<title>");
    svg_.number(static_cast<double>(points_.size()), 0)
        .text(" points, beta ")
        .number(spacing_.global.beta, 4)
        .text("</title>\n");
    svg_.text("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<clipPath id=\"domain\"><rect width=\"")
        .number(view_.width_px);
    svg_.text("\" height=\"")
        .number(view_.height_px)
        .text("\"/></clipPath>\n<g transform=\"translate(")
        .number(margin_px);
    svg_.text(" ").number(margin_px).text(")\">\n<g clip-path=\"url(#domain)\">\n");
  }

  /// Calls draw(shift) for each period by which something around point i, `reach` large, may show in the
  /// picture.
  template <class Draw>
  void on_all_sides(std::size_t i, double reach, const Draw& draw) {
    const Vec3 p = points_[i];
    const auto turns = [reach](double at, double size) {
      return std::pair{std::ceil((-at - reach) / size), std::floor((size - at + reach) / size)};
    };
    const auto [x0, x1] = turns(p.x, box_.size.x);
    const auto [y0, y1] = turns(p.y, box_.size.y);
    for (double ty = y0; ty <= y1; ++ty)
      for (double tx = x0; tx <= x1; ++tx) draw(Vec2{p.x + tx * box_.size.x, p.y + ty * box_.size.y});
  }

  /// Wide enough for the legend.
  double sheet_px() const { return std::max(view_.width_px, 680.0); }

  void cells() {
    const double line = std::clamp(sample_px_ / 3, 0.15, 1.0);
    svg_.text("<g stroke=\"#fff\" stroke-linejoin=\"round\" stroke-width=\"").number(line).text("\">\n");
    std::vector<Vec2> corners;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto& star = stars_[i];
      corners.clear();
      for (std::size_t k = 0; k < star.size(); ++k)
        corners.push_back(circumcenter(star[k].offset, star[k + 1 == star.size() ? 0 : k + 1].offset));
      on_all_sides(i, spacing_.global.r_c, [&](Vec2 at) {
        svg_.text("<path fill=\"").color(color_of(spacing_.beta_i[i])).text("\" d=\"M");
        for (const Vec2 c : corners)
          svg_.number(view_.x(at.x + c.x)).text(" ").number(view_.y(at.y + c.y)).text(" ");
        svg_.text("Z\"/>\n");
      });
    }
    svg_.text("</g>\n");
  }

  void edges() {
    svg_.text("<g stroke-linecap=\"round\" stroke-width=\"")
        .number(std::clamp(0.8 * sample_px_, 0.4, 3.0))
        .text("\">\n");
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (const Spoke& spoke : stars_[i]) {
        // Each edge is seen from both ends; own images, which have no smaller end, from one direction.
        const bool mine = spoke.id != i ? spoke.id > i
                                        : (spoke.offset.x > 0 || (spoke.offset.x == 0 && spoke.offset.y > 0));
        if (!mine) continue;
        const Rgb color = color_of(std::max(spacing_.beta_i[i], spacing_.beta_i[spoke.id]));
        on_all_sides(i, 2 * spacing_.global.r_c, [&](Vec2 at) {
          svg_.text("<path stroke=\"")
              .color(color)
              .text("\" d=\"M")
              .number(view_.x(at.x))
              .text(" ")
              .number(view_.y(at.y))
              .text("L");
          svg_.number(view_.x(at.x + spoke.offset.x))
              .text(" ")
              .number(view_.y(at.y + spoke.offset.y))
              .text("\"/>\n");
        });
      }
    svg_.text("</g>\n");
  }

  void samples(bool colored) {
    const double radius = colored ? 2.2 * sample_px_ : sample_px_;
    svg_.text("<g fill=\"#111\">\n");
    for (std::size_t i = 0; i < points_.size(); ++i)
      on_all_sides(i, radius / view_.scale, [&](Vec2 at) {
        svg_.text("<circle r=\"").number(radius);
        if (colored) svg_.text("\" fill=\"").color(color_of(spacing_.beta_i[i]));
        svg_.text("\" cx=\"").number(view_.x(at.x)).text("\" cy=\"").number(view_.y(at.y)).text("\"/>\n");
      });
    svg_.text("</g>\n");
  }

  void legend() {
    constexpr double bar_px = 220, bar_height_px = 12;
    svg_.text("<g transform=\"translate(0 ")
        .number(view_.height_px + 18)
        .text(")\">\n<linearGradient id=\"scale\">");
    for (std::size_t k = 0; k < anchors.size(); ++k)
      svg_.text("<stop offset=\"")
          .number(static_cast<double>(k) / (anchors.size() - 1))
          .text("\" stop-color=\"")
          .color(anchors[k])
          .text("\"/>");
    svg_.text("</linearGradient>\n<rect width=\"").number(bar_px).text("\" height=\"").number(bar_height_px);
    svg_.text("\" fill=\"url(#scale)\"/>\n");
    const std::array<std::pair<double, std::string_view>, 4> ticks = {
        {{scale_low, "1/√3"}, {0.7, "0.7"}, {0.85, "0.85"}, {1.0, "≥ 1"}}};
    for (const auto& [value, label] : ticks) {
      const double x = (value - scale_low) / (scale_high - scale_low) * bar_px;
      svg_.text("<text font-size=\"12\" text-anchor=\"")
          .text(x < 1            ? "start"
                : x > bar_px - 1 ? "end"
                                 : "middle")
          .text("\" x=\"");
      svg_.number(x).text("\" y=\"").number(bar_height_px + 14).text("\">").text(label).text("</text>\n");
    }
    const Spacing& s = spacing_.global;
    svg_.text("<text x=\"")
        .number(bar_px + 12)
        .text("\" y=\"11\">β<tspan font-size=\"10\" dy=\"3\">i</tspan></text>\n");
    svg_.text("<text text-anchor=\"end\" x=\"")
        .number(sheet_px())
        .text("\" y=\"11\">")
        .number(static_cast<double>(s.n), 0);
    svg_.text(" points   β = ")
        .number(s.beta, 4)
        .text("   r_f = ")
        .number(s.r_f, 5)
        .text("   r_c = ")
        .number(s.r_c, 5);
    svg_.text("   ρ = ").number(s.rho, 4).text("</text>\n</g>\n");
  }

  const PointSet& points_;
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

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "core/render/drawing.h"
#include "core/render/png.h"

namespace wellspaced {
namespace {

/// How many pixels to make of each in a row of `pixels` on a length, so that viewers that interpolate show
/// them with sharp edges: a whole number of times as many as the sheet has. One of those that are hardly
/// larger than the sheet's.
std::size_t pixels_a_pixel(std::size_t pixels, double length_px) {
  constexpr double finer = 2, most_pixels = 2400;
  const double times = length_px / static_cast<double>(pixels);
  if (times < 1.5) return 1;
  return static_cast<std::size_t>(std::ceil(times * (finer * length_px <= most_pixels ? finer : 1)));
}

Image enlarged(const Image& image, const Area& area) {
  const std::size_t across = pixels_a_pixel(image.columns, area.width),
                    down = pixels_a_pixel(image.rows, area.height);
  if (across == 1 && down == 1) return image;
  Image larger{image.columns * across, image.rows * down, {}};
  larger.rgb.reserve(3 * larger.columns * larger.rows);
  for (std::size_t y = 0; y < larger.rows; ++y) {
    const std::uint8_t* row = &image.rgb[3 * image.columns * (y / down)];
    for (std::size_t x = 0; x < larger.columns; ++x)
      larger.rgb.insert(larger.rgb.end(), row + 3 * (x / across), row + 3 * (x / across) + 3);
  }
  return larger;
}

/// A length in pixels, to a hundredth.
void append_px(std::string& out, double x) {
  char buffer[64];
  const double near = std::clamp(x, -1e9, 1e9);  // far outside of any sheet is far enough
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, near, std::chars_format::fixed, 2);
  std::string_view digits(buffer, static_cast<std::size_t>(end.ptr - buffer));
  digits = digits.substr(0, digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.remove_suffix(1);
  out += digits == "-0" ? "0" : digits;
}

std::string px(double x) {
  std::string text;
  append_px(text, x);
  return text;
}

std::string hex(Rgb color) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text = "#";
  for (const double channel : {color.r, color.g, color.b}) {
    const int v = static_cast<int>(channel + 0.5);
    text += digits[v / 16];
    text += digits[v % 16];
  }
  return text;
}

/// What XML can't hold is left out.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) {
      out += c;
    }
  }
  for (const char* none : {"\xef\xbf\xbe", "\xef\xbf\xbf"})  // U+FFFE and U+FFFF
    for (auto at = out.find(none); at != std::string::npos; at = out.find(none)) out.erase(at, 3);
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

class SvgCanvas final : public Canvas {
 public:
  SvgCanvas(const Drawing& drawing, const Control& control) : control_(control) {
    const std::string w = px(drawing.width_px), h = px(drawing.height_px);
    out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
           "\" viewBox=\"0 0 " + w + " " + h +
           "\" xml:space=\"preserve\" style=\"white-space:pre\" font-family=\"DejaVu Sans, Verdana, "
           "sans-serif\">\n<title>" +
           escaped(drawing.title) + "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  }

  void unclip() override {
    close_group();
    out_ += "</svg>\n";
  }

  std::string finish() {
    close_group();
    return std::move(out_) + "</svg>\n";
  }

 private:
  void paint_path(std::span<const Vec2> points, bool closed, const Paint& paint) override {
    start("path", closed ? paint : Paint{std::nullopt, paint.pen, paint.opacity});
    out_ += " d=\"M";
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i != 0) out_ += i == 1 && !closed ? "L" : " ";
      append_px(out_, points[i].x);
      out_ += ' ';
      append_px(out_, points[i].y);
    }
    out_ += closed ? " Z\"/>\n" : "\"/>\n";
  }

  void paint_circle(Vec2 center, double radius_px, const Paint& paint) override {
    start("circle", paint);
    out_ += " r=\"" + px(radius_px) + "\" cx=\"" + px(center.x) + "\" cy=\"" + px(center.y) + "\"/>\n";
  }

  void paint_text(Vec2 at, std::span<const TextRun> runs, const TextStyle& style) override {
    close_group();
    out_ += "<text font-size=\"" + px(style.size_px) + "\" fill=\"" + hex(style.color) + "\"";
    if (style.halo)
      out_ += " stroke=\"" + hex(paper) + "\" stroke-width=\"" + px(2 * halo_px) +
              "\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
    if (style.align != Align::start)
      out_ += style.align == Align::middle ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
    if (style.upward) {
      out_ += " transform=\"translate(" + px(at.x) + " " + px(at.y) + ") rotate(-90)\">";
    } else {
      out_ += " x=\"" + px(at.x) + "\" y=\"" + px(at.y) + "\">";
    }
    double lifted = 0;
    for (const TextRun& run : runs) {
      const double lift = style.size_px * (run.level > 0 ? run_rise : run.level < 0 ? -run_drop : 0);
      if (run.level == 0 && lift == lifted) {
        out_ += escaped(run.text);
        continue;
      }
      out_ += "<tspan dy=\"" + px(lifted - lift) + "\"";
      if (run.level != 0) out_ += " font-size=\"" + px(style.size_px * run_scale) + "\"";
      out_ += ">" + escaped(run.text) + "</tspan>";
      lifted = lift;
    }
    out_ += "</text>\n";
  }

  void paint_image(const Area& area, const Image& image) override {
    close_group();
    out_ += "<image x=\"" + px(area.x) + "\" y=\"" + px(area.y) + "\" width=\"" + px(area.width) +
            "\" height=\"" + px(area.height) +
            "\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\"" +
            " href=\"data:image/png;base64," + base64(write_png(enlarged(image, area), 0, control_)) +
            "\"/>\n";
  }

  /// An inner svg element clips what it holds, and needs no id for that.
  void clip_to(const Area& area) override {
    close_group();
    const std::string x = px(area.x), y = px(area.y), w = px(area.width), h = px(area.height);
    out_ += "<svg x=\"" + x + "\" y=\"" + y + "\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"" + x +
            " " + y + " " + w + " " + h + "\">\n";
  }

  static bool same_but_colors(const Paint& a, const Paint& b) {
    if (a.fill.has_value() != b.fill.has_value() || a.pen.has_value() != b.pen.has_value()) return false;
    if (a.opacity != b.opacity) return false;
    return !a.pen || (a.pen->width_px == b.pen->width_px && a.pen->dash_px == b.pen->dash_px);
  }

  /// Begins an element. Those painted alike share a group, of which they differ at most in colors.
  void start(const char* element, const Paint& paint) {
    if (!group_ || !same_but_colors(*group_, paint)) open_group(paint);
    out_ += '<';
    out_ += element;
    if (paint.fill && paint.fill != group_->fill) out_ += " fill=\"" + hex(*paint.fill) + "\"";
    if (paint.pen && paint.pen->color != group_->pen->color)
      out_ += " stroke=\"" + hex(paint.pen->color) + "\"";
  }

  void open_group(const Paint& paint) {
    close_group();
    group_ = paint;
    out_ += "<g fill=\"" + (paint.fill ? hex(*paint.fill) : std::string("none")) + "\"";
    if (paint.pen) {
      out_ += " stroke=\"" + hex(paint.pen->color) + "\" stroke-width=\"" + px(paint.pen->width_px) +
              "\" stroke-linejoin=\"round\"";
      if (paint.pen->dash_px > 0) out_ += " stroke-dasharray=\"" + px(paint.pen->dash_px) + "\"";
    }
    if (paint.opacity != 1) out_ += " opacity=\"" + px(paint.opacity) + "\"";
    out_ += ">\n";
  }

  void close_group() {
    if (group_) out_ += "</g>\n";
    group_.reset();
  }

  const Control& control_;
  std::string out_;
  std::optional<Paint> group_;
};

}  // namespace

std::string to_svg(const Drawing& drawing, const Control& control) {
  control.check();
  SvgCanvas canvas(drawing, control);
  drawing.draw(canvas);
  return canvas.finish();
}

}  // namespace wellspaced

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/render/color.h"
#include "core/vec.h"

namespace wellspaced {

/// A rectangle in pixels, y down.
struct Area {
  double x = 0, y = 0, width = 0, height = 0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

struct Pen {
  Rgb color;
  double width_px = 1;
  double dash_px = 0;  ///< length of dashes and of the gaps between them; 0: none

  bool operator==(const Pen&) const = default;
};

/// How a shape is painted; both parts may be missing.
struct Paint {
  std::optional<Rgb> fill;
  std::optional<Pen> pen;
  double opacity = 1;
};

enum class Align { start, middle, end };

struct TextStyle {
  double size_px = 13;
  Rgb color = ink;
  Align align = Align::start;
  bool upward = false;  ///< turned so that it reads from bottom to top
  bool plain = false;   ///< `_` and `^` are themselves
  bool halo = false;    ///< stands out from what it is written over
};

/// Of paper around text with a halo.
inline constexpr double halo_px = 1.8;

/// A piece of text that is written at one height: 0 on the line, -1 below it, 1 above it.
struct TextRun {
  std::string text;
  int level = 0;
};

/// What is written below or above the line: "r_f" and "10^{-3}" as in TeX, one character or what is in
/// braces.
std::vector<TextRun> text_runs(std::string_view text, bool plain);

/// Of runs off the line, in sizes of the text.
inline constexpr double run_scale = 0.72, run_drop = 0.22, run_rise = 0.4;

/// Colors in rows from the top.
struct Image {
  std::size_t columns = 0, rows = 0;
  std::vector<std::uint8_t> rgb;  ///< three bytes a pixel
};

/// Something to draw on, in pixels of a sheet, y down. What is drawn later covers what was drawn before.
class Canvas {
 public:
  virtual ~Canvas() = default;

  void polygon(std::span<const Vec2> corners, const Paint& paint) { draw_path(corners, true, paint); }
  void polyline(std::span<const Vec2> points, const Paint& paint) { draw_path(points, false, paint); }
  void line(Vec2 a, Vec2 b, const Pen& pen);
  void rectangle(const Area& area, const Paint& paint);
  void circle(Vec2 center, double radius_px, const Paint& paint);
  /// On the base line through `at`.
  void text(Vec2 at, std::string_view text, const TextStyle& style);
  /// Stretched over the area, every pixel as a rectangle of its own.
  void image(const Area& area, const Image& image);

  /// Nothing shows outside of the area until `unclip`. Not nested.
  void clip(const Area& area);
  virtual void unclip() = 0;

  /// What is drawn until `pop` is moved by that much, on top of earlier moves.
  void push(Vec2 by);
  void pop();

 protected:
  Vec2 origin() const { return moves_.empty() ? Vec2{0, 0} : moves_.back(); }

 private:
  void draw_path(std::span<const Vec2> points, bool closed, const Paint& paint);

  // All in pixels of the sheet.
  virtual void paint_path(std::span<const Vec2> points, bool closed, const Paint& paint) = 0;
  virtual void paint_circle(Vec2 center, double radius_px, const Paint& paint) = 0;
  virtual void paint_text(Vec2 at, std::span<const TextRun> runs, const TextStyle& style) = 0;
  virtual void paint_image(const Area& area, const Image& image) = 0;
  virtual void clip_to(const Area& area) = 0;

  std::vector<Vec2> moves_;
  std::vector<Vec2> moved_;  ///< scratch
};

}  // namespace wellspaced

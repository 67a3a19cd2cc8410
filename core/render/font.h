#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/render/canvas.h"

namespace wellspaced {

/// The outline of a glyph in pixels, y down: lines, and Bezier curves of the second degree.
class GlyphPen {
 public:
  virtual ~GlyphPen() = default;
  virtual void move_to(Vec2 p) = 0;
  virtual void line_to(Vec2 p) = 0;
  virtual void curve_to(Vec2 control, Vec2 p) = 0;
};

/// DejaVu Sans, which is part of the program, so that pictures don't depend on what a machine has installed.
///
/// Determinism: outlines are not hinted and in whole units of the font. Thread safety: none; cheap to make.
class Font {
 public:
  Font();
  ~Font();
  Font(Font&&) noexcept;

  /// Of text in UTF-8, in pixels. What the font lacks is as wide as its box for the unknown.
  double width_px(std::string_view text, double size_px) const;
  double width_px(std::span<const TextRun> runs, double size_px) const;

  /// Calls pen with the outlines of the text, its base line beginning at `at`.
  void outline(std::string_view text, double size_px, Vec2 at, bool upward, GlyphPen& pen) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The text, or as much of its beginning as fits with "…".
std::string fitted(const Font& font, std::string_view text, double size_px, double width_px);

/// The size of a run's letters.
inline double run_size_px(const TextRun& run, double size_px) {
  return run.level == 0 ? size_px : size_px * run_scale;
}

}  // namespace wellspaced

#include "core/render/canvas.h"

#include <array>

namespace wellspaced {
namespace {

/// The bytes of the UTF-8 character that text begins with.
std::size_t character_bytes(std::string_view text) {
  std::size_t n = 1;
  while (n < text.size() && (static_cast<unsigned char>(text[n]) & 0xc0) == 0x80) ++n;
  return n;
}

Area moved(const Area& area, Vec2 by) { return {area.x + by.x, area.y + by.y, area.width, area.height}; }

}  // namespace

std::vector<TextRun> text_runs(std::string_view text, bool plain) {
  std::vector<TextRun> runs = {{"", 0}};
  while (!text.empty()) {
    const bool marked = !plain && text.size() > 1 && (text[0] == '_' || text[0] == '^');
    if (!marked) {
      if (runs.back().level != 0) runs.push_back({"", 0});
      runs.back().text += text[0];
      text.remove_prefix(1);
      continue;
    }
    const int level = text[0] == '_' ? -1 : 1;
    text.remove_prefix(1);
    const auto close = text[0] == '{' ? text.find('}') : std::string_view::npos;
    const bool braced = close != std::string_view::npos;
    const std::size_t bytes = braced ? close + 1 : character_bytes(text);
    runs.push_back({std::string(braced ? text.substr(1, close - 1) : text.substr(0, bytes)), level});
    text.remove_prefix(bytes);
  }
  if (runs.front().text.empty() && runs.size() > 1) runs.erase(runs.begin());
  return runs;
}

void Canvas::draw_path(std::span<const Vec2> points, bool closed, const Paint& paint) {
  const Vec2 by = origin();
  moved_.clear();
  for (const Vec2 p : points) moved_.push_back(p + by);
  paint_path(moved_, closed, paint);
}

void Canvas::line(Vec2 a, Vec2 b, const Pen& pen) {
  const std::array<Vec2, 2> ends = {a, b};
  polyline(ends, {std::nullopt, pen});
}

void Canvas::rectangle(const Area& area, const Paint& paint) {
  const std::array<Vec2, 4> corners = {Vec2{area.x, area.y}, Vec2{area.right(), area.y},
                                       Vec2{area.right(), area.bottom()}, Vec2{area.x, area.bottom()}};
  polygon(corners, paint);
}

void Canvas::circle(Vec2 center, double radius_px, const Paint& paint) {
  paint_circle(center + origin(), radius_px, paint);
}

void Canvas::text(Vec2 at, std::string_view text, const TextStyle& style) {
  if (text.empty()) return;
  paint_text(at + origin(), text_runs(text, style.plain), style);
}

void Canvas::image(const Area& area, const Image& image) { paint_image(moved(area, origin()), image); }

void Canvas::clip(const Area& area) { clip_to(moved(area, origin())); }

void Canvas::push(Vec2 by) { moves_.push_back(origin() + by); }
void Canvas::pop() { moves_.pop_back(); }

}  // namespace wellspaced

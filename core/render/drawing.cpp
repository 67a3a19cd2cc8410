#include "core/render/drawing.h"

#include <algorithm>
#include <utility>

#include "core/render/font.h"

namespace wellspaced {
namespace {

void draw_at(const Drawing& drawing, Vec2 at, Canvas& canvas) {
  canvas.push(at);
  drawing.draw(canvas);
  canvas.pop();
}

std::string joined_titles(const std::vector<Drawing>& drawings) {
  std::string all;
  for (const Drawing& drawing : drawings)
    if (!drawing.title.empty()) all += (all.empty() ? "" : "; ") + drawing.title;
  return all;
}

}  // namespace

Drawing grid_of(std::vector<Drawing> panels, std::size_t columns, double gap_px) {
  if (panels.size() == 1) return std::move(panels.front());
  double width = 0, height = 0;
  for (const Drawing& panel : panels) {
    width = std::max(width, panel.width_px);
    height = std::max(height, panel.height_px);
  }
  columns = std::min(columns, panels.size());
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  const auto across = static_cast<double>(columns), down = static_cast<double>(rows);
  Drawing grid{
      across * width + (across - 1) * gap_px, down * height + (down - 1) * gap_px, joined_titles(panels), {}};
  grid.draw = [panels = std::move(panels), columns, width, height, gap_px](Canvas& canvas) {
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const std::size_t row_number = i / columns;
      const auto column = static_cast<double>(i % columns), row = static_cast<double>(row_number);
      draw_at(panels[i],
              {column * (width + gap_px) + (width - panels[i].width_px) / 2, row * (height + gap_px)},
              canvas);
    }
  };
  return grid;
}

Drawing stack_of(std::vector<Drawing> parts, double gap_px) {
  Drawing stack{0, gap_px * static_cast<double>(parts.size() - 1), joined_titles(parts), {}};
  for (const Drawing& part : parts) {
    stack.width_px = std::max(stack.width_px, part.width_px);
    stack.height_px += part.height_px;
  }
  stack.draw = [parts = std::move(parts), gap_px](Canvas& canvas) {
    double y = 0;
    for (const Drawing& part : parts) {
      draw_at(part, {0, y}, canvas);
      y += part.height_px + gap_px;
    }
  };
  return stack;
}

Drawing with_caption(Drawing drawing, const std::string& caption) {
  if (caption.empty()) return drawing;
  constexpr double line_px = 26;
  Drawing captioned{drawing.width_px,
                    drawing.height_px + line_px,
                    drawing.title.empty() ? caption : caption + ": " + drawing.title,
                    {}};
  constexpr double size_px = 15;
  const std::string shown = fitted(Font(), caption, size_px, drawing.width_px);
  captioned.draw = [drawing = std::move(drawing), shown](Canvas& canvas) {
    canvas.text({drawing.width_px / 2, 15}, shown, {size_px, ink, Align::middle, false, true});
    draw_at(drawing, {0, line_px}, canvas);
  };
  return captioned;
}

Drawing with_margin(Drawing drawing, double margin_px) {
  Drawing wider{drawing.width_px + 2 * margin_px, drawing.height_px + 2 * margin_px, drawing.title, {}};
  wider.draw = [drawing = std::move(drawing), margin_px](Canvas& canvas) {
    draw_at(drawing, {margin_px, margin_px}, canvas);
  };
  return wider;
}

}  // namespace wellspaced

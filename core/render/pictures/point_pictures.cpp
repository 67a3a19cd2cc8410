#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/analyze/local_measures.h"
#include "core/analyze/spacing.h"
#include "core/domain/torus.h"
#include "core/render/chart.h"
#include "core/render/pictures/mesh_panel.h"
#include "core/render/pictures/point_colors.h"
#include "core/render/pictures/rows.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

using Kind = PointsKind;

constexpr std::size_t most_panels = 16;
constexpr double alone_px = 900, beside_px = 420;

/// Domain to pixels, y up.
struct View {
  double scale, width_px, height_px;

  View(const Box& box, double longer_side_px)
      : scale(longer_side_px / std::max(box.size.x, box.size.y)),
        width_px(box.size.x * scale),
        height_px(box.size.y * scale) {}
  Vec2 operator()(Vec2 p) const { return {p.x * scale, height_px - p.y * scale}; }
};

/// How far something reaches around its sample, in domain lengths.
struct Extent {
  Vec2 low, high;

  void include(Vec2 at) {
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
};

/// A point set with what is needed to draw it.
class Panel {
 public:
  Panel(const PointSet& points, Kind kind, std::optional<LocalMeasure> color, double size_px,
        const Control& control)
      : points_(points),
        kind_(kind),
        control_(control),
        box_(points.domain->box()),
        view_(box_, size_px),
        spacing_(measure_spacing(points, control)),
        stars_(points.size()) {
    if (color) {
      scale_ = scale_of(*color);
      values_ = measure_locally(points, *color, control);
    }
    visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
      stars_[i].assign(spokes.begin(), spokes.end());
    });
    const double spacing_px = hexagonal_spacing(points.domain->area(), points.size()) * view_.scale;
    sample_px_ = std::clamp(0.08 * spacing_px, 0.4, 4.0);
  }

  double width_px() const { return view_.width_px; }
  double height_px() const { return view_.height_px; }
  const Spacing& spacing() const { return spacing_; }

  void draw(Canvas& canvas) const {
    const Area area{0, 0, view_.width_px, view_.height_px};
    canvas.clip(area);
    if (kind_ == Kind::voronoi) cells(canvas);
    if (kind_ == Kind::delaunay) edges(canvas);
    samples(canvas);
    canvas.unclip();
    canvas.rectangle(area, {std::nullopt, Pen{ink, 1}});
  }

 private:
  Rgb color(double value) const { return scale_ ? (*scale_)(value) : Rgb{205, 216, 226}; }
  double value(std::size_t i) const { return values_.empty() ? 0 : values_[i]; }

  /// Calls draw(place) for sample i and each periodic image of it that something of this extent around it
  /// brings into the picture.
  template <class Draw>
  void on_all_sides(std::size_t i, const Extent& extent, const Draw& draw) const {
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

  void cells(Canvas& canvas) const {
    const Pen pen{paper, std::clamp(sample_px_ / 3, 0.15, 1.0)};
    std::vector<Vec2> corners, placed;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto& star = stars_[i];
      corners.clear();
      Extent extent;
      for (std::size_t k = 0; k < star.size(); ++k) {
        corners.push_back(circumcenter(star[k].offset, star[k + 1 == star.size() ? 0 : k + 1].offset));
        extent.include(corners.back());
      }
      on_all_sides(i, extent, [&](Vec2 at) {
        placed.clear();
        for (const Vec2 c : corners) placed.push_back(view_(at + c));
        canvas.polygon(placed, {color(value(i)), pen});
      });
    }
  }

  void edges(Canvas& canvas) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (const Spoke& spoke : stars_[i]) {
        // Each edge is seen from both ends; own images, which have no smaller end, from one direction.
        const bool mine = spoke.id != i ? spoke.id > i
                                        : (spoke.offset.x > 0 || (spoke.offset.x == 0 && spoke.offset.y > 0));
        if (mine) edge(i, spoke, canvas);
      }
  }

  /// In the color of the end that is farther from the best.
  void edge(std::size_t i, const Spoke& spoke, Canvas& canvas) const {
    const double worse = scale_ ? scale_->worse(value(i), value(spoke.id)) : 0;
    const Pen pen{scale_ ? color(worse) : Rgb{120, 140, 160}, std::clamp(0.8 * sample_px_, 0.4, 3.0)};
    Extent extent;
    extent.include(spoke.offset);
    on_all_sides(i, extent, [&](Vec2 at) { canvas.line(view_(at), view_(at + spoke.offset), pen); });
  }

  void samples(Canvas& canvas) const {
    const bool alone = kind_ == Kind::points;
    const double radius_px = alone ? 2.5 * sample_px_ : sample_px_, radius = radius_px / view_.scale;
    const bool on_dark = kind_ == Kind::voronoi && scale_ && scale_->is_dark();
    const Rgb dark{17, 17, 17}, plain = on_dark ? paper : dark;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Rgb fill = alone && scale_ ? color(value(i)) : plain;
      on_all_sides(i, {{-radius, -radius}, {radius, radius}}, [&](Vec2 at) {
        canvas.circle(view_(at), radius_px, {fill, std::nullopt});
      });
    }
  }

  const PointSet& points_;
  Kind kind_;
  const Control& control_;
  Box box_;
  View view_;
  Spacing spacing_;
  std::vector<std::vector<Spoke>> stars_;
  std::optional<ColorScale> scale_;
  std::vector<double> values_;
  double sample_px_ = 1;
};

/// A panel, and below it what was measured.
template <class AnyPanel>
Drawing panel_as(const PointSet& points, Kind kind, std::optional<LocalMeasure> color, double size_px,
                 const Control& control) {
  const auto panel = std::make_shared<const AnyPanel>(points, kind, color, size_px, control);
  const Spacing& s = panel->spacing();
  Drawing picture{panel->width_px(), panel->height_px(),
                  std::to_string(s.n) + " points, beta " + number_label(s.beta, 4),
                  [panel](Canvas& canvas) { panel->draw(canvas); }};
  Drawing numbers = text_rows(
      {std::to_string(s.n) + " points", "β = " + number_label(s.beta, 4), "r_f = " + number_label(s.r_f, 4),
       "r_c = " + number_label(s.r_c, 4), "ρ = " + number_label(s.rho, 4)},
      std::max(200.0, panel->width_px()), size_px < 500 ? 12 : 13);
  numbers.title.clear();
  return stack_of({std::move(picture), std::move(numbers)}, 8);
}

Drawing panel_of(const PointSet& points, Kind kind, std::optional<LocalMeasure> color, double size_px,
                 const Control& control) {
  return is_torus(*points.domain) ? panel_as<Panel>(points, kind, color, size_px, control)
                                  : panel_as<MeshPanel>(points, kind, color, size_px, control);
}

/// With the name of its group, and its number if the group has others.
std::string caption_of(const PictureGroup& group, std::size_t set, std::size_t shown) {
  if (shown < 2) return group.label;
  return (group.label.empty() ? "set " : group.label + ", set ") + std::to_string(set + 1);
}

/// How many sets of each group are shown.
std::size_t sets_each_of(std::size_t groups, std::size_t sets) {
  return groups == 1 ? std::min(most_panels, sets) : 1;
}

SheetSize sheet(std::span<const SetsSize> groups, const Arguments& arguments) {
  const std::size_t panels =
      groups.size() * sets_each_of(groups.size(), static_cast<std::size_t>(groups[0].sets));
  const double size_px = size_px_of(arguments, panels == 1 ? alone_px : beside_px);
  constexpr double numbers_px = 28, numbers_width_px = 170;
  SheetSize panel{numbers_width_px, 0};
  for (const SetsSize& group : groups) {
    panel.width_px = std::max(panel.width_px, size_px * std::min(1.0, 1 / group.height_over_width));
    panel.height_px =
        std::max(panel.height_px, size_px * std::min(1.0, group.height_over_width) + numbers_px);
  }
  return sheet_of(panel, panels, columns_of(panels));
}

/// Of one group all sets, of several the first of each.
Drawing make(Kind kind, std::span<const PictureGroup> groups, const Arguments& arguments,
             const Control& control) {
  const std::size_t sets_each = sets_each_of(groups.size(), groups[0].sets.size());
  const std::size_t panels = groups.size() * sets_each;
  const double size_px = size_px_of(arguments, panels == 1 ? alone_px : beside_px);
  const auto choice = static_cast<std::size_t>(argument(arguments, "color").value_or(0));
  const std::optional<LocalMeasure> color =
      choice < local_measure_names.size() ? std::optional(static_cast<LocalMeasure>(choice)) : std::nullopt;
  std::vector<Drawing> all;
  for (const PictureGroup& group : groups)
    for (std::size_t s = 0; s < sets_each; ++s)
      all.push_back(with_caption(panel_of(group.sets[s], kind, color, size_px, control),
                                 caption_of(group, s, sets_each)));
  Drawing sheet = grid_of(std::move(all), columns_of(panels), panel_gap_px);
  if (groups.size() == 1 && sets_each < groups[0].sets.size())
    sheet = stack_of({std::move(sheet), text_rows({"the first " + std::to_string(sets_each) + " of " +
                                                   std::to_string(groups[0].sets.size()) + " sets"},
                                                  300, 13)},
                     8);
  if (color) {
    ColorScale scale = scale_of(*color);
    const Axis axis{scale.best, scale.worst, scale.name, scale.ticks};
    sheet = stack_of({std::move(sheet), color_bar(scale.map, axis, 220)}, 12);
  }
  return with_margin(std::move(sheet), 16);
}

Picture row(const char* name, const char* title, const char* description) {
  Picture picture;
  picture.name = name;
  picture.title = title;
  picture.description = description;
  Parameter color;
  color.name = "color";
  color.type = Parameter::Type::choice;
  color.description = "the measure of each sample that colors it";
  color.choices.assign(local_measure_names.begin(), local_measure_names.end());
  color.choices.push_back("none");
  color.fallback = "\"beta_i\"";
  picture.parameters = {color, size_parameter(alone_px)};
  picture.parameters.back().fallback = "900, several panels 420";
  picture.draws_each_point = true;
  picture.averages = false;
  picture.cost = [](const SetsSize& size, const Arguments&) {
    const double panels = size.alone ? std::min<double>(most_panels, size.sets) : 1;
    return Cost{3e-5 * size.n * panels, 1000 * size.n * panels};
  };
  picture.sheet = sheet;
  return picture;
}

}  // namespace

Drawing plain_points(const PointSet& points, double size_px, const Control& control) {
  const auto panel = std::make_shared<const Panel>(points, Kind::points, std::nullopt, size_px, control);
  return {panel->width_px(), panel->height_px(), std::to_string(points.size()) + " points",
          [panel](Canvas& canvas) { panel->draw(canvas); }};
}

Picture voronoi_picture() {
  Picture picture =
      row("voronoi", "Voronoi cells", "Each sample's Voronoi cell, colored by a measure of the sample.");
  picture.make = [](std::span<const PictureGroup> groups, const Arguments& arguments,
                    const Control& control) { return make(Kind::voronoi, groups, arguments, control); };
  return picture;
}

Picture delaunay_picture() {
  Picture picture = row("delaunay", "Delaunay triangulation",
                        "Its edges, colored by the worse of the measures of their ends.");
  picture.make = [](std::span<const PictureGroup> groups, const Arguments& arguments,
                    const Control& control) { return make(Kind::delaunay, groups, arguments, control); };
  return picture;
}

Picture points_picture() {
  Picture picture = row("points", "Points", "The samples alone, colored by a measure.");
  picture.make = [](std::span<const PictureGroup> groups, const Arguments& arguments,
                    const Control& control) { return make(Kind::points, groups, arguments, control); };
  return picture;
}

}  // namespace wellspaced

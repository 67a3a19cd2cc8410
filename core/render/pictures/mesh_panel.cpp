#include "core/render/pictures/mesh_panel.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/math.h"
#include "core/mesh/meshing.h"

namespace wellspaced {
namespace {

constexpr double azimuth_turns = 30.0 / 360, tilt_turns = 22.0 / 360;
constexpr Vec3 light{-0.4, 0.5, 0.77};  // from the left, above and before

std::array<Vec3, 3> axes_of(const Domain& domain) {
  if (domain.dimension() == 2) return {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const CosSin a = portable_cos_sin(azimuth_turns), t = portable_cos_sin(tilt_turns);
  const Vec3 right{a.cos, a.sin, 0}, back{-a.sin, a.cos, 0};
  const Vec3 up = t.cos * Vec3{0, 0, 1} + t.sin * back;
  return {right, up, cross(right, up)};
}

Rgb shaded(Rgb color, double shade) { return {shade * color.r, shade * color.g, shade * color.b}; }

}  // namespace

MeshPanel::MeshPanel(const PointSet& points, PointsKind kind, std::optional<LocalMeasure> color,
                     double size_px, const Control& control)
    : points_(points),
      kind_(kind),
      control_(control),
      spacing_(measure_spacing(points, control)),
      mesh_(kind == PointsKind::voronoi ? voronoi_mesh(points, control) : delaunay_mesh(points, control)),
      axes_(axes_of(*points.domain)) {
  if (color) {
    scale_ = scale_of(*color);
    values_ = measure_locally(points, *color, control);
  }
  place(size_px);
  const double spacing_px = hexagonal_spacing(*points.domain, points.size()) * px_;
  sample_px_ = std::clamp(0.08 * spacing_px, 0.4, 4.0);
  for (const Vec3 v : mesh_.vertices) vertices_.push_back(seen(v));
  for (std::size_t i = 0; i < points.size(); ++i) samples_.push_back(seen(points[i]));
}

/// Planar domains fill the panel; others are in the middle of a square.
void MeshPanel::place(double size_px) {
  const Box box = points_.domain->box();
  if (points_.domain->dimension() == 2) {
    px_ = size_px / std::max(box.size.x, box.size.y);
    corner_ = {box.low.x, box.low.y + box.size.y, 0};
    width_px_ = px_ * box.size.x;
    height_px_ = px_ * box.size.y;
    return;
  }
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Vec3 v : mesh_.vertices) {
    const Vec2 at{dot(v, axes_[0]), dot(v, axes_[1])};
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  px_ = size_px / side;
  corner_ = {0.5 * (low.x + high.x) - 0.5 * side, 0.5 * (low.y + high.y) + 0.5 * side, 0};
  width_px_ = height_px_ = size_px;
}

MeshPanel::Seen MeshPanel::seen(Vec3 p) const {
  return {{px_ * (dot(p, axes_[0]) - corner_.x), px_ * (corner_.y - dot(p, axes_[1]))}, dot(p, axes_[2])};
}

void MeshPanel::draw(Canvas& canvas) const {
  const Area area{0, 0, width_px_, height_px_};
  if (points_.domain->dimension() == 3) {
    draw_space(canvas);
    return;
  }
  canvas.clip(area);
  draw_plane(canvas);
  canvas.unclip();
  draw_outline(canvas);
}

/// In the color of the end that is farther from the best.
Pen MeshPanel::edge_pen(std::uint32_t a, std::uint32_t b) const {
  const double width_px = std::clamp(0.8 * sample_px_, 0.4, 3.0);
  if (!scale_ || a == Mesh::no_point || b == Mesh::no_point) return {Rgb{120, 140, 160}, width_px};
  return {color(scale_->worse(value(a), value(b))), width_px};
}

Rgb MeshPanel::sample_color(std::uint32_t point) const {
  if (kind_ == PointsKind::points && scale_) return color(value(point));
  const bool on_dark = kind_ == PointsKind::voronoi && scale_ && scale_->is_dark();
  return on_dark ? paper : Rgb{17, 17, 17};
}

void MeshPanel::draw_edges(std::size_t face, Vec2 by, Canvas& canvas) const {
  const std::span<const std::uint32_t> corners = mesh_[face];
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::uint32_t a = corners[k], b = corners[k + 1 == corners.size() ? 0 : k + 1];
    canvas.line(by + vertices_[a].at, by + vertices_[b].at,
                edge_pen(mesh_.vertex_points[a], mesh_.vertex_points[b]));
  }
}

void MeshPanel::draw_faces(Vec2 by, Canvas& canvas) const {
  const Pen pen{paper, std::clamp(sample_px_ / 3, 0.15, 1.0)};
  std::vector<Vec2> placed;
  for (std::size_t f = 0; f < mesh_.faces(); ++f) {
    if (f % 256 == 0) control_.check();
    if (kind_ == PointsKind::delaunay) {
      draw_edges(f, by, canvas);
      continue;
    }
    placed.clear();
    for (const std::uint32_t v : mesh_[f]) placed.push_back(by + vertices_[v].at);
    canvas.polygon(placed, {color(value(mesh_.face_points[f])), pen});
  }
}

/// What goes on across a seam is drawn on both sides of it; points on top of all faces.
void MeshPanel::draw_plane(Canvas& canvas) const {
  const Box box = points_.domain->box();
  const Vec2 turn{box.periodic[0] ? width_px_ : 0, box.periodic[1] ? -height_px_ : 0};
  std::vector<Vec2> images = {{0, 0}};
  if (box.periodic[0] || box.periodic[1]) images = {-1 * turn, {0, 0}, turn};
  if (kind_ != PointsKind::points)
    for (const Vec2 by : images) draw_faces(by, canvas);
  for (const Vec2 by : images)
    for (std::uint32_t i = 0; i < samples_.size(); ++i)
      canvas.circle(by + samples_[i].at, sample_radius_px(), {sample_color(i), std::nullopt});
}

void MeshPanel::draw_outline(Canvas& canvas) const {
  const Pen pen{ink, 1};
  const Domain& domain = *points_.domain;
  const std::vector<BoundaryCurve> curves = domain.boundary();
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (curves[c].closed) {  // the side of a strip
      const Vec2 at = seen(domain.boundary_point(c, 0)).at;
      const bool across = domain.box().periodic[0];
      canvas.line(across ? Vec2{0, at.y} : Vec2{at.x, 0},
                  across ? Vec2{width_px_, at.y} : Vec2{at.x, height_px_}, pen);
      continue;
    }
    canvas.line(seen(domain.boundary_point(c, 0)).at, seen(domain.boundary_point(c, curves[c].length)).at,
                pen);
  }
}

void MeshPanel::draw_face(std::size_t face, double shade, Canvas& canvas) const {
  std::vector<Vec2> placed;
  for (const std::uint32_t v : mesh_[face]) placed.push_back(vertices_[v].at);
  if (kind_ == PointsKind::voronoi) {
    const std::uint32_t point = mesh_.face_points[face];
    const Pen pen{paper, std::clamp(sample_px_ / 3, 0.15, 1.0)};
    canvas.polygon(placed, {shaded(color(value(point)), shade), pen});
    canvas.circle(samples_[point].at, sample_radius_px(), {sample_color(point), std::nullopt});
    return;
  }
  const Rgb ground = shaded({250, 250, 250}, shade);
  canvas.polygon(placed, {ground, Pen{ground, 0.5}});
  if (kind_ == PointsKind::delaunay) draw_edges(face, {}, canvas);
}

/// From the back to the front: faces that look towards us, and with the last one around it each point.
void MeshPanel::draw_space(Canvas& canvas) const {
  struct Item {
    double depth;
    std::uint32_t face, point;  ///< no_point: a face
    double shade;
  };
  std::vector<Item> items;
  std::vector<double> depth_of(samples_.size(), -HUGE_VAL);
  for (std::uint32_t f = 0; f < mesh_.faces(); ++f) {
    const Vec3 area = area_vector(mesh_, f);
    if (!(dot(area, axes_[2]) > 0)) continue;
    const Vec3 normal = (1 / norm(area)) * area;
    const Vec3 in_view{dot(normal, axes_[0]), dot(normal, axes_[1]), dot(normal, axes_[2])};
    double depth = 0;
    for (const std::uint32_t v : mesh_[f]) depth += vertices_[v].depth / static_cast<double>(mesh_[f].size());
    items.push_back({depth, f, Mesh::no_point, 0.6 + 0.4 * std::max(0.0, dot(in_view, light))});
    if (kind_ == PointsKind::voronoi) continue;
    for (const std::uint32_t v : mesh_[f]) {
      const std::uint32_t point = mesh_.vertex_points[v];
      if (point != Mesh::no_point) depth_of[point] = std::max(depth_of[point], depth);
    }
  }
  for (std::uint32_t i = 0; i < samples_.size(); ++i)
    if (depth_of[i] > -HUGE_VAL) items.push_back({depth_of[i], 0, i, 1});
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.depth < b.depth; });
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k % 256 == 0) control_.check();
    const Item& item = items[k];
    if (item.point == Mesh::no_point)
      draw_face(item.face, item.shade, canvas);
    else
      canvas.circle(samples_[item.point].at, sample_radius_px(), {sample_color(item.point), std::nullopt});
  }
}

}  // namespace wellspaced

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/analyze/spacing.h"
#include "core/mesh/mesh.h"
#include "core/render/canvas.h"
#include "core/render/pictures/point_colors.h"

namespace wellspaced {

/// A point set on another domain than the torus with what is needed to draw it: planar ones as they are, with
/// their boundary; curved ones in parallel projection from the front, a little from above, z up, with what is
/// in front on top.
///
/// Errors of the constructor: those of measure_spacing and of the mesh that is drawn. Cost: those of these.
class MeshPanel {
 public:
  MeshPanel(const PointSet& points, PointsKind kind, std::optional<LocalMeasure> color, double size_px,
            const Control& control);

  double width_px() const { return width_px_; }
  double height_px() const { return height_px_; }
  const Spacing& spacing() const { return spacing_; }
  void draw(Canvas& canvas) const;

 private:
  struct Seen {
    Vec2 at;           ///< on the panel
    double depth = 0;  ///< larger in front
  };

  void place(double size_px);
  Seen seen(Vec3 p) const;
  Rgb color(double value) const { return scale_ ? (*scale_)(value) : Rgb{205, 216, 226}; }
  double value(std::uint32_t point) const {
    return values_.empty() || point == Mesh::no_point ? 0 : values_[point];
  }
  Pen edge_pen(std::uint32_t a, std::uint32_t b) const;
  Rgb sample_color(std::uint32_t point) const;
  double sample_radius_px() const { return kind_ == PointsKind::points ? 2.5 * sample_px_ : sample_px_; }

  void draw_faces(Vec2 by, Canvas& canvas) const;
  void draw_plane(Canvas& canvas) const;
  void draw_outline(Canvas& canvas) const;
  void draw_space(Canvas& canvas) const;
  void draw_face(std::size_t face, double shade, Canvas& canvas) const;
  void draw_edges(std::size_t face, Vec2 by, Canvas& canvas) const;

  const PointSet& points_;
  PointsKind kind_;
  const Control& control_;
  Spacing spacing_;
  Mesh mesh_;
  std::vector<Seen> vertices_, samples_;
  std::optional<ColorScale> scale_;
  std::vector<double> values_;
  std::array<Vec3, 3> axes_;  ///< right, up, towards the eye
  Vec3 corner_;               ///< of what is seen, along these: left, top
  double px_ = 1, width_px_ = 0, height_px_ = 0, sample_px_ = 1;
};

}  // namespace wellspaced

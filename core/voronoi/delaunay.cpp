// The only file that knows CGAL's two-dimensional triangulations.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include "core/parallel.h"
#include "core/voronoi/cell.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

/// Which sample a vertex is an image of, and how many periods away.
struct Image {
  std::uint32_t id = 0;
  int turns_x = 0, turns_y = 0;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Image, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase>;
using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

constexpr double most_images = 1e8;

class PeriodicDelaunay {
 public:
  explicit PeriodicDelaunay(const PointSet& points) : points_(points), box_(points.domain->box()) {}

  /// Images within `border` of the box. False if the border proves too narrow for some star.
  bool build(double border, const Control& control) {
    const int rx = static_cast<int>(std::ceil(border / box_.size.x));
    const int ry = static_cast<int>(std::ceil(border / box_.size.y));
    std::vector<std::pair<Kernel::Point_2, Image>> images;
    for (int ty = -ry; ty <= ry; ++ty)
      for (int tx = -rx; tx <= rx; ++tx) {
        control.check();
        add_images(tx, ty, border, images);
      }
    triangulation_.clear();
    insert(images, control);
    if (triangulation_.dimension() < 2) return false;  // all images so far are on one line
    originals_.assign(points_.size(), {});
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v)
      if (v->info().turns_x == 0 && v->info().turns_y == 0) originals_[v->info().id] = v;
    std::vector<Spoke> spokes;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!star(i, spokes) || 2 * outradius(spokes) > border) return false;
    return true;
  }

  /// False if the star is open (the point is on the hull).
  bool star(std::size_t i, std::vector<Spoke>& spokes) const {
    spokes.clear();
    const Vec3 center = points_[i];
    auto around = triangulation_.incident_vertices(originals_[i]);
    if (around == nullptr) return false;
    const auto first = around;
    do {
      if (triangulation_.is_infinite(around)) return false;
      const Image& image = around->info();
      const Vec3 at = points_[image.id];
      spokes.push_back(
          {{(at.x - center.x) + image.turns_x * box_.size.x, (at.y - center.y) + image.turns_y * box_.size.y},
           image.id});
    } while (++around != first);
    return true;
  }

 private:
  /// Near ones after each other, as CGAL's own insertion of a range does, which can't be interrupted.
  void insert(std::vector<std::pair<Kernel::Point_2, Image>>& images, const Control& control) {
    using Traits = CGAL::Spatial_sort_traits_adapter_2<
        Kernel, CGAL::First_of_pair_property_map<std::pair<Kernel::Point_2, Image>>>;
    CGAL::spatial_sort(images.begin(), images.end(), Traits());
    control.check();
    constexpr std::size_t between_checks = 4096;
    Triangulation::Face_handle near;
    for (std::size_t k = 0; k < images.size(); ++k) {
      if (k % between_checks == 0) control.check();
      const auto vertex = triangulation_.insert(images[k].first, near);
      vertex->info() = images[k].second;
      near = vertex->face();
    }
  }

  void add_images(int tx, int ty, double border,
                  std::vector<std::pair<Kernel::Point_2, Image>>& images) const {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec3 p = points_[i];
      const double x = p.x + tx * box_.size.x, y = p.y + ty * box_.size.y;
      if (x < -border || x > box_.size.x + border || y < -border || y > box_.size.y + border) continue;
      images.push_back({Kernel::Point_2(x, y), Image{static_cast<std::uint32_t>(i), tx, ty}});
    }
  }

  static double outradius(const std::vector<Spoke>& spokes) {
    double r2 = 0;
    for (std::size_t k = 0; k < spokes.size(); ++k)
      r2 = std::max(r2,
                    norm2(circumcenter(spokes[k].offset, spokes[k + 1 == spokes.size() ? 0 : k + 1].offset)));
    return std::sqrt(r2);
  }

  const PointSet& points_;
  Box box_;
  Triangulation triangulation_;
  std::vector<Triangulation::Vertex_handle> originals_;
};

}  // namespace

void visit_stars_by_cgal(const PointSet& points, const Control& control, const StarVisitor& visit) {
  const Box box = points.domain->box();
  const double n = static_cast<double>(points.size()), area = points.domain->area();
  const double enough = 1.01 * std::hypot(box.size.x, box.size.y);  // no outradius exceeds half the diagonal
  PeriodicDelaunay delaunay(points);
  double border = std::min(enough, 4 * hexagonal_spacing(area, points.size()));
  for (;; border = std::min(enough, 2 * border)) {
    const double images = n * (1 + 2 * border / box.size.x) * (1 + 2 * border / box.size.y);
    if (images > most_images)
      throw Error(ErrorCode::degenerate_input,
                  "the points leave so large a part of this thin torus empty that more than 10^8 periodic "
                  "images would be "
                  "needed; spread them out or use a less elongated torus");
    if (delaunay.build(border, control) || border >= enough) break;
  }
  parallel_blocks(points.size(), 4096, control, [&](std::size_t begin, std::size_t end) {
    std::vector<Spoke> spokes;
    for (std::size_t i = begin; i < end; ++i) {
      delaunay.star(i, spokes);
      visit(i, spokes);
    }
  });
}

}  // namespace wellspaced

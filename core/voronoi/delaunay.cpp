// The only file that knows CGAL's two-dimensional triangulations.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include "core/domain/point_tree.h"
#include "core/parallel.h"
#include "core/sort.h"
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

constexpr std::size_t most_images = 100'000'000;

/// Where a star is seen from matters: an image of a point keeps its exact place only near 0. So each point is
/// seen from an image in the window [-1/4, 3/4) of the period, from where the exact places go on for a
/// quarter of it on all sides: a coordinate in [1/2, 1) less 1 is not rounded, one in [0, 1) is what was
/// given. However near each other points are, on whichever side of the seam, they are triangulated as they
/// are.
class PeriodicDelaunay {
 public:
  PeriodicDelaunay(const PointSet& points, const Control& control)
      : points_(points), box_(points.domain->box()), tree_(points, control) {}

  /// The images within `border` of the window, as far as one period away, and whichever others prove to be
  /// needed. False if a wider border is better.
  bool build(double border, const Control& control) {
    border_ = {std::min(border, box_.size.x), std::min(border, box_.size.y)};
    std::vector<std::pair<Kernel::Point_2, Image>> images;
    for (int ty = -3; ty <= 2; ++ty)
      for (int tx = -3; tx <= 2; ++tx) {
        control.check();
        add_images(tx, ty, images);
      }
    triangulation_.clear();
    insert(images, control);
    if (triangulation_.dimension() < 2) return false;  // all images so far are on one line
    centers_.assign(points_.size(), {});
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v)
      if (is_in_window(v->info())) centers_[v->info().id] = v;
    const bool widest = border_.x == box_.size.x && border_.y == box_.size.y;
    return complete(widest ? most_images : images.size() / 4 + 1000, control);
  }

  /// False if the star is open (the point is on the hull).
  bool star(std::size_t i, std::vector<Spoke>& spokes) const {
    spokes.clear();
    const auto center = centers_[i]->point();
    auto around = triangulation_.incident_vertices(centers_[i]);
    if (around == nullptr) return false;
    const auto first = around;
    do {
      if (triangulation_.is_infinite(around)) return false;
      spokes.push_back(
          {{around->point().x() - center.x(), around->point().y() - center.y()}, around->info().id});
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

  void add_images(int tx, int ty, std::vector<std::pair<Kernel::Point_2, Image>>& images) const {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec3 p = points_[i];
      const double x = p.x + tx * box_.size.x, y = p.y + ty * box_.size.y;
      if (is_within_border({x, y}, 0))
        images.push_back({Kernel::Point_2(x, y), Image{static_cast<std::uint32_t>(i), tx, ty}});
    }
  }

  static int turns_into_window(double at, double period) { return at < 0.75 * period ? 0 : -1; }

  bool is_in_window(const Image& image) const {
    const Vec3 p = points_[image.id];
    return image.turns_x == turns_into_window(p.x, box_.size.x) &&
           image.turns_y == turns_into_window(p.y, box_.size.y);
  }

  /// Whether all of that around a place is where every image is in the triangulation.
  bool is_within_border(Vec2 at, double radius) const {
    return at.x - radius >= -0.25 * box_.size.x - border_.x &&
           at.x + radius <= 0.75 * box_.size.x + border_.x &&
           at.y - radius >= -0.25 * box_.size.y - border_.y &&
           at.y + radius <= 0.75 * box_.size.y + border_.y;
  }

  /// Inserts images until the circumdisks of all stars are empty. False if some star is open, or after that
  /// many images.
  bool complete(std::size_t most, const Control& control) {
    constexpr std::size_t between_checks = 256;
    std::vector<std::uint32_t> todo(points_.size());
    std::iota(todo.begin(), todo.end(), 0u);
    std::size_t inserted = 0;
    for (std::size_t turn = 0; !todo.empty(); ++turn) {
      if (turn % between_checks == 0) control.check();
      const std::uint32_t i = todo.back();
      std::optional<Image> missing;
      if (!look_for_missing(i, missing)) return false;
      if (!missing) {
        todo.pop_back();
        continue;
      }
      if (++inserted > most) return false;
      const auto vertex = triangulation_.insert(place(*missing), centers_[i]->face());
      vertex->info() = *missing;
      auto around = triangulation_.incident_vertices(vertex);
      const auto first = around;
      do
        if (!triangulation_.is_infinite(around) && is_center(around)) todo.push_back(around->info().id);
      while (++around != first);
    }
    return true;
  }

  /// False if the star is open. An image of a sample in the circumdisk of one of its triangles.
  bool look_for_missing(std::uint32_t i, std::optional<Image>& missing) const {
    auto face = triangulation_.incident_faces(centers_[i]);
    const auto first = face;
    do {
      if (triangulation_.is_infinite(face)) return false;
      missing = image_within(face, centers_[i]);
    } while (!missing && ++face != first);
    return true;
  }

  std::optional<Image> image_within(Triangulation::Face_handle face,
                                    Triangulation::Vertex_handle center) const {
    const int at = face->index(center);
    const auto &p = center->point(), &a = face->vertex(triangulation_.ccw(at))->point(),
               &b = face->vertex(triangulation_.cw(at))->point();
    const Vec2 to_middle = towards_middle({a.x() - p.x(), a.y() - p.y()}, {b.x() - p.x(), b.y() - p.y()});
    const double radius = norm(to_middle);
    const Vec2 middle{p.x() + to_middle.x, p.y() + to_middle.y};
    constexpr double slack = 1 + 1e-6;
    if (is_within_border(middle, radius * slack)) return std::nullopt;
    const Image image = nearest_image(middle);
    const bool inside = triangulation_.side_of_oriented_circle(face, place(image)) == CGAL::ON_POSITIVE_SIDE;
    return inside ? std::optional(image) : std::nullopt;
  }

  /// To the circumcenter, or as far in that direction as an empty circle may reach: one that is so large and
  /// touches there lies in the circumcircle.
  Vec2 towards_middle(Vec2 a, Vec2 b) const {
    const double most = 0.51 * std::hypot(box_.size.x, box_.size.y);
    const Vec2 middle = circumcenter(a, b);
    if (norm(middle) <= most) return middle;
    const double a2 = norm2(a), b2 = norm2(b);
    const Vec2 along{b.y * a2 - a.y * b2, a.x * b2 - b.x * a2};
    return (most / norm(along)) * along;
  }

  Image nearest_image(Vec2 at) const {
    const double turns_x = std::floor(at.x / box_.size.x), turns_y = std::floor(at.y / box_.size.y);
    const Vec2 within{at.x - turns_x * box_.size.x, at.y - turns_y * box_.size.y};
    Image nearest;
    double least2 = std::numeric_limits<double>::infinity();
    for (int ty = -1; ty <= 1; ++ty)
      for (int tx = -1; tx <= 1; ++tx) {
        const Vec2 seen_from{within.x - tx * box_.size.x, within.y - ty * box_.size.y};
        const std::size_t k = tree_.nearest(seen_from);
        const double distance2 = norm2(tree_.at(k) - seen_from);
        if (distance2 >= least2) continue;
        least2 = distance2;
        nearest = {tree_.original(k), static_cast<int>(turns_x) + tx, static_cast<int>(turns_y) + ty};
      }
    return nearest;
  }

  Kernel::Point_2 place(const Image& image) const {
    const Vec3 p = points_[image.id];
    return {p.x + image.turns_x * box_.size.x, p.y + image.turns_y * box_.size.y};
  }

  bool is_center(Triangulation::Vertex_handle v) const { return centers_[v->info().id] == v; }

  const PointSet& points_;
  Box box_;
  PointTree tree_;
  Vec2 border_;  ///< around the window
  Triangulation triangulation_;
  std::vector<Triangulation::Vertex_handle> centers_;
};

/// Of what no coordinate along an axis lies in.
double widest_gap(const PointSet& points, std::size_t axis, double period, const Control& control) {
  std::vector<double> at(points.size());
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = points.coordinates[2 * i + axis];
  sort(at.begin(), at.end(), control, std::less<>());
  double widest = at.front() + period - at.back();
  for (std::size_t k = 1; k < at.size(); ++k) widest = std::max(widest, at[k] - at[k - 1]);
  return widest;
}

}  // namespace

void visit_stars_by_cgal(const PointSet& points, const Control& control, const StarVisitor& visit) {
  const Vec3 size = points.domain->box().size;
  const double widest = std::max(size.x, size.y);
  PeriodicDelaunay delaunay(points, control);
  // The widest empty strip is a hole of that size at least.
  double border = std::max({4 * hexagonal_spacing(points.domain->area(), points.size()),
                            widest_gap(points, 0, size.x, control), widest_gap(points, 1, size.y, control)});
  while (!delaunay.build(border, control)) {
    if (border >= widest) throw hidden_triangles();
    border *= 2;
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

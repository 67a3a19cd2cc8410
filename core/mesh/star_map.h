#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/control.h"
#include "core/point_set.h"
#include "core/voronoi/moving_set.h"

namespace wellspaced {

/// The Delaunay stars of all points, as one map: every edge is known from both of its ends, and faces are
/// what is left between edges. What does without a plane to triangulate in: the torus, the sphere, surfaces.
///
/// Edges that only one of their ends sees, as rounding may have it where four points are on one circle, are
/// left out, and so is one of two that cross. Where the domain isn't the torus, so is the longer one of two
/// edges that join the same points, around a sharp vertex of a surface. So faces may have more than three
/// corners.
///
/// Guarantees: the map is a surface with as many parts and borders, and of the Euler characteristic, as the
/// domain.
/// Errors of the constructor: infeasible where it isn't, and where a border of a surface has no points:
/// the points are too few to follow it, with the radius that would do; those of visit_stars and MovingSet;
/// cancelled, deadline_exceeded. Cost: that of the stars; 120 bytes a point.
class StarMap {
 public:
  static constexpr std::uint32_t none = ~0u;

  /// The edge to a neighbor, and what lies to the left of it.
  struct Spoke {
    Vec2 way;  ///< as in DomainStar
    std::uint32_t id = 0;
    std::uint32_t twin = none;              ///< the same edge, as the neighbor sees it
    std::uint32_t face = none;              ///< none: the outside
    std::int16_t turns_x = 0, turns_y = 0;  ///< periods that the image is away from the point `id` itself
    bool closes = true;
  };

  /// A corner of a face: the spoke along which it goes on from there.
  struct Face {
    std::uint32_t first = 0;  ///< in face_spokes
    std::uint32_t corners = 0;
  };

  StarMap(const PointSet& points, const Control& control);

  std::size_t points() const { return first_.size() - 1; }
  std::uint32_t begin(std::size_t i) const { return first_[i]; }
  std::uint32_t end(std::size_t i) const { return first_[i + 1]; }
  const Spoke& operator[](std::uint32_t s) const { return spokes_[s]; }
  /// The one before and after it, counter-clockwise around the same point.
  std::uint32_t previous(std::uint32_t s) const;
  std::uint32_t next(std::uint32_t s) const;
  /// The spoke along which the face to the left of s goes on.
  std::uint32_t around_face(std::uint32_t s) const { return previous(spokes_[s].twin); }
  /// Whether some spoke of i leads to j.
  bool has_edge(std::size_t i, std::uint32_t j) const;
  /// The point whose spoke it is.
  std::uint32_t origin(std::uint32_t s) const { return spokes_[spokes_[s].twin].id; }

  std::size_t faces() const { return faces_.size(); }
  /// Its spokes, counter-clockwise, from the point with the lowest number on.
  std::span<const std::uint32_t> face(std::size_t f) const {
    return {face_spokes_.data() + faces_[f].first, faces_[f].corners};
  }

 private:
  using Stars = std::vector<std::vector<Spoke>>;

  void collect_on_torus(const PointSet& points, const Control& control, Stars& stars) const;
  void collect_elsewhere(const PointSet& points, const Control& control, Stars& stars) const;
  void keep(Stars& stars);
  void find_twins();
  void number_owners();
  std::uint32_t twin_of(std::uint32_t s) const;
  void drop_lonely(const Control& control);
  void trace();
  bool cut_surplus();
  bool cut_crossing();
  bool cut_double();
  void cut(std::uint32_t s);
  bool is_longer(std::uint32_t s, std::uint32_t other) const;

  bool is_torus_ = false;
  std::vector<std::uint32_t> first_, owner_;
  std::vector<Spoke> spokes_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> face_spokes_;
  std::size_t borders_ = 0;

  friend class TopologyCheck;
};

}  // namespace wellspaced

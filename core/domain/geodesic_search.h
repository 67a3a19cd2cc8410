#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/domain/star_region.h"
#include "core/domain/unfolding.h"
#include "core/vec.h"

namespace wellspaced {

/// The shortest ways over a mesh from one place to others, not farther than `reach`: their directions and
/// lengths. Asked once, then thrown away.
///
/// Windows (parts of an edge that one sees from the base over faces unfolded into its chart) go from face to
/// face; a vertex in sight splits one into two. Vertices with more than a whole turn around them, or half of
/// one at the border, hide what is behind them: there ways bend, and windows start anew.
///
/// Where there are many faces within reach it first tries some way to each target: windows that can't lead to
/// a shorter one, because not even the straight line through space does, are dropped. And where there are
/// more than `enough_windows`, or reach goes around the mesh several times, it starts anew with the nearest
/// window first, without those that can't be on a shortest way.
///
/// Guarantees: distances are exact but for rounding, about 1e-15 a face on the way, and 1e-10 where two ways
/// are so equally long. Chart vectors lead along the first straight part of the way, and are as long as all
/// of it. Cost: about 50 ns a window; there are about 4 a face within reach, up to 150 faces; beyond, about 1
/// us a target and face on the way. Determinism: depends on arguments only, in the order in which targets
/// were added. Reference: Mitchell, Mount and Papadimitriou 1987; Chen and Han 1990; Xin and Wang, "Improving
/// Chen and Han's algorithm on the discrete geodesic problem", 2009 (the filter).
class GeodesicSearch {
 public:
  static constexpr std::size_t enough_windows = 500000;
  static constexpr std::size_t most_aimed = 64;  ///< with more targets it looks everywhere
  static constexpr double unreached = std::numeric_limits<double>::infinity();
  static constexpr std::uint32_t none = ~0u;

  struct Target {
    MeshPlace place;
    double distance = unreached;
    Vec2 vector;             ///< in the base's chart
    std::uint32_t next = 0;  ///< of the same face
    Vec3 position{};
    double bound = unreached;    ///< length of some way, maybe not a straight one
    std::uint32_t image = none;  ///< the latest one
  };
  enum class Border { ignore, look };
  /// A target as it is seen from the base, straight ahead over unfolded faces.
  struct Image {
    std::uint32_t target = 0;
    Vec2 vector;
    std::uint32_t earlier = none;  ///< of the same target
  };
  enum class Images { ignore, collect };
  /// A vertex as it is seen from the base, straight ahead over unfolded faces.
  struct VertexView {
    std::uint32_t vertex = 0;
    Vec2 at;
  };

  /// Requires: the unfolding outlives it.
  GeodesicSearch(const Unfolding& unfolding, const MeshPlace& base, double reach);

  void add(const MeshPlace& place) { targets_.push_back({place, unreached, {}, none, {}, unreached, none}); }
  /// With Border::look and Images::collect it goes on to the end of reach even if all targets were found.
  /// `enough`: see above.
  void run(Border border = Border::ignore, std::size_t enough = enough_windows,
           Images images = Images::ignore);

  /// In the order in which they were added.
  const std::vector<Target>& targets() const { return targets_; }
  const std::vector<BorderView>& border_views() const { return views_; }
  /// With Images::collect: all straight ways within reach, not just the shortest: behind a vertex with less
  /// than a whole turn around it one sees what is there past its left and past its right. With more than
  /// `enough` windows only some of them.
  const std::vector<Image>& images() const { return images_; }
  /// Looks to the end of reach for vertices with more than `angle` missing around them; instead of `run`.
  /// Each where it is nearest.
  std::vector<VertexView> sharp_vertices(double angle);
  /// From where they are seen: the base, or, if that is on an edge, a place beside it in its face.
  Vec2 apex() const { return apex_; }

 private:
  /// How a way came to the place where it bent last: to the base itself, or over a vertex.
  struct Bend {
    double before = 0;            ///< length of the way to here
    Vec2 first;                   ///< unit vector of the way at the base
    std::uint32_t vertex = none;  ///< none: the base
    double back = 0;              ///< angle around the vertex to where the way came from
  };
  /// The part of a half-edge (from `right` to `left`, its face towards the apex) between two rays out of the
  /// apex. Positions are in the base's chart, or relative to the vertex where the way to here bent last.
  /// Without half-edge: that vertex, still to be left.
  struct Window {
    std::uint32_t half_edge = none;
    std::uint32_t bend = 0;  ///< index; 0: none, the base is in sight
    Vec2 right, left, right_ray, left_ray;
    double nearest = 0;            ///< length of the shortest way to here; nearest first only
    std::uint64_t wanted = ~0ull;  ///< targets to which the shortest way may lead through here
  };
  struct Queued {
    double nearest;
    std::uint64_t order;
    std::uint32_t slot;
    /// A heap has the largest on top.
    friend bool operator<(const Queued& a, const Queued& b) {
      return a.nearest != b.nearest ? a.nearest > b.nearest : a.order > b.order;
    }
  };
  struct Known {
    std::uint32_t vertex = none;
    double distance = unreached;
  };

  Vec2 apex_of(const Window& w) const { return w.bend == 0 ? apex_ : Vec2{}; }
  void hash_targets();
  void aim_at_targets();
  std::uint64_t still_wanted(const Window& w) const;
  void start();
  void go_on(const Window& w);
  void cross_edge(const Window& w);
  void enter(const Window& w, std::uint32_t h, const std::array<Vec2, 3>& corners);
  void collect(std::uint32_t target, Vec2 at);
  void improve(Target& target, double distance, Vec2 vector);
  void see_vertex(const Window& w, std::uint32_t h, Vec2 at, Vec2 along);
  bool is_news(std::uint32_t vertex, double distance);
  Known* find_known(std::uint32_t vertex);
  void add(const Bend& bend, std::uint64_t wanted);
  void leave(const Window& bend, double low, double high);
  void leave_through(const Window& bend, std::uint32_t h, double low, double high);
  void follow_edge(std::uint32_t vertex, double back, const Window& w, double length);
  void push(Window& w, Vec2 across);
  bool cannot_be_shortest(const Window& w, Vec2 across) const;
  void put(const Window& w);
  bool run_in_any_order(std::size_t enough);
  void run_nearest_first();

  const Unfolding* unfolding_;
  const TriangleMesh* mesh_;
  MeshPlace base_;
  double reach_, limit_;
  double slack_ = 0;  ///< from the base to the apex
  Vec2 apex_;  ///< the base, moved off edges into its face, so that what is behind an edge is beyond it
  std::array<Vec2, 3> corners_;
  Border border_ = Border::ignore;
  bool collects_images_ = false;
  double sharp_ = unreached;  ///< the angle from which on vertices are collected
  bool nearest_first_ = false, is_aimed_ = false;
  std::size_t found_ = 0;
  std::vector<Target> targets_;
  std::vector<std::array<std::uint32_t, 2>> faces_with_targets_;  ///< a hash table: face, first target
  std::vector<BorderView> views_;
  std::vector<Image> images_;
  std::vector<VertexView> sharp_vertices_;
  std::vector<Window> windows_;
  std::vector<Queued> queue_;
  std::vector<std::uint32_t> free_slots_;
  std::uint64_t pushed_ = 0;
  std::vector<Bend> bends_;
  std::vector<Known> known_;  ///< a hash table: shortest ways so far to vertices where ways bend
  std::size_t known_count_ = 0;
  std::vector<double> vertex_distance_;  ///< the same for all vertices; nearest first only
};

}  // namespace wellspaced

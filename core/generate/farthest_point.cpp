#include "core/generate/farthest_point.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <optional>
#include <tuple>
#include <vector>

#include "core/voronoi/cell.h"
#include "core/voronoi/cell_finder.h"
#include "core/voronoi/neighbors.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

constexpr std::uint32_t nobody = ~0u;

/// A corner of the Voronoi diagram, its depth the distance to the samples around it.
struct Hole {
  double depth = 0;
  Vec3 at;
};

/// For a heap with the deepest on top; a total order, so that the order of arrival does not matter.
bool comes_later(const Hole& a, const Hole& b) {
  return std::tuple(-a.depth, a.at.y, a.at.x, a.at.z) > std::tuple(-b.depth, b.at.y, b.at.x, b.at.z);
}

class Inserter {
 public:
  Inserter(PointSet& points, const FarthestPointEnd& end, Control& control)
      : points_(points), end_(end), control_(control), floor_(std::max(end.coverage, end.shallowest)) {}

  double run() {
    index();
    collect();
    const std::size_t first = points_.size();
    std::optional<Hole> hole = deepest();
    for (std::size_t k = 0; hole && points_.size() < end_.count; ++k) {
      if (k % 256 == 0) report(first, hole->depth);
      insert(*hole);
      hole = deepest();
    }
    return hole ? hole->depth : floor_;
  }

 private:
  /// Built anew whenever the points have become twice as many.
  void index() {
    const double spacing = hexagonal_spacing(points_.domain->area(), points_.size());
    indexed_ = points_.size();
    grid_.emplace(points_, spacing);
    finder_.emplace(points_, *grid_, 2.5 * spacing, control_);
  }

  /// All holes deeper than the floor.
  void collect() {
    std::mutex mutex;
    visit_stars(points_, control_, [&](std::size_t i, std::span<const Spoke> spokes) {
      for (std::size_t k = 0; k < spokes.size(); ++k) {
        const Spoke &a = spokes[k], &b = spokes[k + 1 == spokes.size() ? 0 : k + 1];
        if (a.id < i || b.id < i) continue;  // that one's star has it
        const Vec2 center = circumcenter(a.offset, b.offset);
        const double depth = points_.domain->chart_to_distance(norm(center));
        if (!(depth > floor_) || !std::isfinite(depth)) continue;
        const std::lock_guard lock(mutex);
        holes_.push_back({depth, points_.domain->step(points_[i], center)});
      }
    });
    // Stars were visited in any order; it doesn't show, since no two different holes are equal.
    std::make_heap(holes_.begin(), holes_.end(), comes_later);
  }

  void push(const Hole& hole) {
    holes_.push_back(hole);
    std::push_heap(holes_.begin(), holes_.end(), comes_later);
  }

  double depth_of(const Hole& hole) {
    around_.clear();
    grid_->gather(hole.at, nobody, hole.depth * (1 + 1e-9), around_);
    double nearest2 = hole.depth * hole.depth;
    for (const Neighbor& neighbor : around_) nearest2 = std::min(nearest2, norm2(neighbor.offset));
    return points_.domain->chart_to_distance(std::sqrt(nearest2));
  }

  /// The deepest hole above the floor, off the heap. Depths fall as points are inserted, and are looked at
  /// again when their turn comes.
  std::optional<Hole> deepest() {
    for (;;) {
      control_.check();  // a look into a crowd may take a while
      if (holes_.empty() && !lower_floor()) return std::nullopt;
      if (holes_.empty()) continue;
      std::pop_heap(holes_.begin(), holes_.end(), comes_later);
      const Hole hole = holes_.back();
      holes_.pop_back();
      const double depth = depth_of(hole);
      if (depth >= hole.depth * (1 - 1e-12)) return hole;
      // Of needle-like triangles the center is known less well: a little less deep is the same hole still. If
      // much less, the points that filled it have brought their own holes.
      if (depth > std::max(floor_, hole.depth * (1 - 1e-6))) push({depth, hole.at});
    }
  }

  /// For when the guessed floor was too high.
  bool lower_floor() {
    if (floor_ <= end_.coverage || points_.size() >= end_.count) return false;
    floor_ = end_.coverage;
    collect();
    return true;
  }

  void insert(const Hole& hole) {
    const auto i = static_cast<std::uint32_t>(points_.size());
    points_.push_back(hole.at);
    if (points_.size() > 2 * indexed_) {
      index();
    } else {
      grid_->add(i);
    }
    // No cell's outradius is above the depth of the deepest hole.
    finder_->load(i, 2 * hole.depth * (1 + 1e-9));
    for (const Cell::Corner& corner : finder_->cell_at({}).corners()) {
      const double depth = points_.domain->chart_to_distance(norm(corner.at));
      if (depth > floor_) push({depth, points_.domain->step(hole.at, corner.at)});
    }
  }

  void report(std::size_t first, double depth) {
    const double reached =
        end_.coverage / depth;  // as many points have that depth as its disk goes into the area
    double fraction = reached * reached;
    if (end_.count < std::numeric_limits<std::size_t>::max())
      fraction = std::max(
          fraction, static_cast<double>(points_.size() - first) / static_cast<double>(end_.count - first));
    control_.report({fraction});
  }

  PointSet& points_;
  const FarthestPointEnd& end_;
  Control& control_;
  double floor_;
  std::size_t indexed_ = 0;
  std::optional<NeighborGrid> grid_;
  std::optional<CellFinder> finder_;
  std::vector<Hole> holes_;
  std::vector<Neighbor> around_;
};

}  // namespace

double insert_farthest(PointSet& points, const FarthestPointEnd& end, Control& control) {
  return Inserter(points, end, control).run();
}

}  // namespace wellspaced

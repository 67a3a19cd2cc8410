#include "core/domain/mesh_extent.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace wellspaced {
namespace {

class EdgeWays {
 public:
  explicit EdgeWays(const TriangleMesh& mesh) : mesh_(mesh), distance_(mesh.vertices().size()) {}

  /// From a vertex to all of its component; returns the distance of the last one.
  double sweep_from(std::uint32_t from) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::fill(distance_.begin(), distance_.end(), std::numeric_limits<double>::infinity());
    distance_[from] = 0;
    queue.push({0, from});
    while (!queue.empty()) {
      const auto [distance, vertex] = queue.top();
      queue.pop();
      if (distance > distance_[vertex]) continue;
      last_ = vertex;
      const auto go = [&, d = distance, v = vertex](std::uint32_t next) {
        const double length = d + norm(mesh_.vertices()[next] - mesh_.vertices()[v]);
        if (!(length < distance_[next])) return;
        distance_[next] = length;
        queue.push({length, next});
      };
      const std::uint32_t first = mesh_.first_out(vertex);
      for (std::uint32_t h = first; h != TriangleMesh::none;) {
        go(mesh_.target(h));
        go(mesh_.origin(TriangleMesh::previous(h)));
        h = mesh_.turn_left(h);
        if (h == first) break;
      }
    }
    return distance_[last_];
  }

  std::uint32_t last() const { return last_; }

 private:
  const TriangleMesh& mesh_;
  std::vector<double> distance_;
  std::uint32_t last_ = 0;
};

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0;
  for (std::uint32_t h = 0; h < mesh.half_edges(); ++h)
    longest = std::max(longest, norm(mesh.vertices()[mesh.target(h)] - mesh.vertices()[mesh.origin(h)]));
  return longest;
}

}  // namespace

double mesh_extent(const TriangleMesh& mesh) {
  constexpr int sweeps = 3;  ///< each from where the one before ended
  EdgeWays ways(mesh);
  double farthest = 0;
  std::uint32_t seen = 0;  // components
  for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
    if (mesh.component_of_face()[f] < seen) continue;
    ++seen;
    ways.sweep_from(mesh.faces()[f][0]);
    for (int k = 0; k < sweeps; ++k) farthest = std::max(farthest, ways.sweep_from(ways.last()));
  }
  // No place is farther than that from the next corner of its face.
  return 1.1 * farthest + longest_edge(mesh) / std::sqrt(3.0);
}

}  // namespace wellspaced

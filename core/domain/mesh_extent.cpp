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
  explicit EdgeWays(const TriangleMesh& mesh)
      : mesh_(mesh), distance_(mesh.vertices().size()), before_(mesh.vertices().size()) {}

  /// From a vertex to all of its component; returns the farthest one.
  std::uint32_t sweep(std::uint32_t from) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::fill(distance_.begin(), distance_.end(), std::numeric_limits<double>::infinity());
    distance_[from] = 0;
    before_[from] = from;
    queue.push({0, from});
    std::uint32_t last = from;
    while (!queue.empty()) {
      const auto [distance, vertex] = queue.top();
      queue.pop();
      if (distance > distance_[vertex]) continue;
      last = vertex;
      const auto go = [&, d = distance, v = vertex](std::uint32_t next) {
        const double length = d + norm(mesh_.vertices()[next] - mesh_.vertices()[v]);
        if (!(length < distance_[next])) return;
        distance_[next] = length;
        before_[next] = v;
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
    return last;
  }

  /// Of the way to there.
  std::uint32_t middle(std::uint32_t to) const {
    const double half = distance_[to] / 2;
    while (distance_[to] > half) to = before_[to];
    return to;
  }

  double distance(std::uint32_t to) const { return distance_[to]; }

 private:
  const TriangleMesh& mesh_;
  std::vector<double> distance_;
  std::vector<std::uint32_t> before_;
};

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0;
  for (std::uint32_t h = 0; h < mesh.half_edges(); ++h)
    longest = std::max(longest, norm(mesh.vertices()[mesh.target(h)] - mesh.vertices()[mesh.origin(h)]));
  return longest;
}

}  // namespace

double mesh_extent(const TriangleMesh& mesh) {
  EdgeWays ways(mesh);
  double farthest = 0;
  std::uint32_t seen = 0;  // components
  for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
    if (mesh.component_of_face()[f] < seen) continue;
    ++seen;
    const std::uint32_t end = ways.sweep(mesh.faces()[f][0]);
    const std::uint32_t middle = ways.middle(ways.sweep(end));
    farthest = std::max(farthest, ways.distance(ways.sweep(middle)));
  }
  // No place is farther than that from the next corner of its face.
  return 2 * (farthest + longest_edge(mesh) / std::sqrt(3.0));
}

}  // namespace wellspaced

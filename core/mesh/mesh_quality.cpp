#include "core/mesh/mesh_quality.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/math.h"

namespace wellspaced {
namespace {

class SpreadOf {
 public:
  void add(double x) {
    least_ = std::min(least_, x);
    most_ = std::max(most_, x);
    sum_ += x;
    ++count_;
  }
  Spread get() const {
    if (count_ == 0) return {};
    return {least_, sum_ / static_cast<double>(count_), most_};
  }

 private:
  double least_ = HUGE_VAL, most_ = -HUGE_VAL, sum_ = 0;
  std::size_t count_ = 0;
};

template <std::size_t n>
void count_in(std::array<std::size_t, n>& bins, double at) {
  const double last = static_cast<double>(n - 1);
  ++bins[static_cast<std::size_t>(std::clamp(at, 0.0, last))];
}

/// Of the corner at b, in radians; above pi where it turns away from `up`.
double angle_at(Vec3 a, Vec3 b, Vec3 c, Vec3 up) {
  const Vec3 across = cross(c - b, a - b);
  const double angle = portable_atan2(norm(across), dot(a - b, c - b));
  return dot(across, up) < 0 ? 2 * pi - angle : angle;
}

double radius_ratio(Vec3 a, Vec3 b, Vec3 c) {
  const double ab = norm(b - a), bc = norm(c - b), ca = norm(a - c), area = 0.5 * norm(cross(b - a, c - a));
  // R = abc / 4 A, r = 2 A / (a + b + c)
  return ab * bc * ca * (ab + bc + ca) / (16 * area * area);
}

/// Longest and shortest way across, at right angles to an edge.
double width_ratio(const std::vector<Vec3>& corners, Vec3 up) {
  double longest = 0, shortest = HUGE_VAL;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 a = corners[k], way = corners[k + 1 == corners.size() ? 0 : k + 1] - a;
    const Vec3 left = cross(up, way);
    const double length = norm(left);
    double low = 0, high = 0;
    for (const Vec3 p : corners) {
      longest = std::max(longest, norm2(p - a));
      const double away = dot(left, p - a);
      low = std::min(low, away);
      high = std::max(high, away);
    }
    if (length > 0) shortest = std::min(shortest, (high - low) / length);
  }
  return std::sqrt(longest) / shortest;
}

struct DirectedEdge {
  std::uint32_t low = 0, high = 0;
  bool forward = true;  ///< from low to high
  Vec3 way;             ///< from low to high
  bool paired = false;
};

std::uint32_t original(const Mesh& mesh, std::uint32_t v) {
  return mesh.originals.empty() ? v : mesh.originals[v];
}

std::vector<DirectedEdge> directed_edges(const Mesh& mesh) {
  std::vector<DirectedEdge> edges;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh[f];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t from = face[k], to = face[k + 1 == face.size() ? 0 : k + 1];
      std::uint32_t a = original(mesh, from), b = original(mesh, to);
      Vec3 way = mesh.vertices[to] - mesh.vertices[from];
      bool forward = a < b;
      if (a == b) forward = way.x != 0 ? way.x > 0 : way.y > 0;  // to an image of its own
      if (a > b) std::swap(a, b);
      if (!forward) way = -1.0 * way;
      edges.push_back({a, b, forward, way});
    }
  }
  const auto before = [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::pair(a.low, a.high) < std::pair(b.low, b.high);
  };
  std::stable_sort(edges.begin(), edges.end(), before);
  return edges;
}

/// Edges between the same two vertices are one where they run to the same image, in opposite directions.
void pair_up(std::vector<DirectedEdge>& edges) {
  for (std::size_t k = 0; k < edges.size(); ++k) {
    DirectedEdge& edge = edges[k];
    if (edge.paired) continue;
    for (std::size_t m = k + 1; m < edges.size() && edges[m].low == edge.low && edges[m].high == edge.high;
         ++m) {
      if (edges[m].paired || edges[m].forward == edge.forward) continue;
      if (norm(edges[m].way - edge.way) > 1e-6 * norm(edge.way)) continue;
      edge.paired = edges[m].paired = true;
      break;
    }
  }
}

void measure_topology(const Mesh& mesh, MeshQuality& quality) {
  std::vector<DirectedEdge> edges = directed_edges(mesh);
  pair_up(edges);
  MeshQuality::Topology topology;
  std::vector<std::size_t> degrees(mesh.vertices.size(), 0);
  std::vector<bool> inner(mesh.vertices.size(), true);
  for (const DirectedEdge& edge : edges) {
    if (edge.paired && !edge.forward) continue;
    ++topology.edges;
    ++degrees[edge.low];
    ++degrees[edge.high];
    if (edge.paired) continue;
    ++topology.boundary_edges;
    topology.boundary_length += norm(edge.way);
    inner[edge.low] = inner[edge.high] = false;
  }
  for (std::size_t v = 0; v < degrees.size(); ++v)
    if (degrees[v] != 0 && inner[v]) ++quality.valence[degrees[v]];
  topology.euler_characteristic =
      static_cast<int>(quality.vertices) - static_cast<int>(topology.edges) + static_cast<int>(quality.faces);
  quality.topology = topology;
}

std::size_t count_vertices(const Mesh& mesh) {
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) count += original(mesh, v) == v;
  return count;
}

}  // namespace

MeshQuality measure_quality(const Mesh& mesh) {
  const bool is_delaunay = mesh.face_points.empty();
  MeshQuality quality;
  quality.faces = mesh.faces();
  quality.vertices = count_vertices(mesh);
  SpreadOf areas, lengths, angles, aspects;
  std::vector<Vec3> corners;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    corners.clear();
    for (const std::uint32_t v : mesh[f]) corners.push_back(mesh.vertices[v]);
    const Vec3 up = area_vector(mesh, f);
    const double area = norm(up);
    areas.add(area);
    quality.area += area;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 before = corners[k == 0 ? corners.size() - 1 : k - 1],
                 after = corners[k + 1 == corners.size() ? 0 : k + 1];
      lengths.add(norm(after - corners[k]));
      const double degrees = 180 / pi * angle_at(before, corners[k], after, up);
      angles.add(degrees);
      count_in(quality.angles, degrees / 5);
    }
    const double aspect = corners.size() == 3 && is_delaunay
                              ? radius_ratio(corners[0], corners[1], corners[2])
                              : width_ratio(corners, (1 / area) * up);
    aspects.add(aspect);
    count_in(quality.aspect_ratios, (aspect - 1) * 10);
    if (!is_delaunay) ++quality.valence[corners.size()];
  }
  quality.face_area = areas.get();
  quality.edge_length = lengths.get();
  quality.angle_deg = angles.get();
  quality.aspect_ratio = aspects.get();
  if (is_delaunay) measure_topology(mesh, quality);
  return quality;
}

}  // namespace wellspaced

#include "core/domain/vertex_sizing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"

namespace wellspaced {
namespace {

void require_radii(const std::vector<double>& radii, std::size_t vertices) {
  if (radii.size() != vertices)
    throw Error(ErrorCode::invalid_parameters,
                "there are " + std::to_string(radii.size()) + " radii, but the mesh has " +
                    std::to_string(vertices) + " vertices; give one for each",
                "/radii");
  for (std::size_t k = 0; k < radii.size(); ++k)
    if (!Sizing::is_radius(radii[k])) Sizing::require_radius(radii[k], "/radii/" + std::to_string(k));
}

/// Of what is linear on a triangle with edges a and b from one corner, and rises by so much along them.
double slope(Vec3 a, Vec3 b, double along_a, double along_b) {
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), det = norm2(cross(a, b));
  const double s = (bb * along_a - ab * along_b) / det, t = (aa * along_b - ab * along_a) / det;
  return std::sqrt(std::max(0.0, s * along_a + t * along_b));
}

}  // namespace

VertexSizing::VertexSizing(const SurfaceMesh& domain, std::vector<double> radii)
    : domain_(&domain), radii_(std::move(radii)) {
  const TriangleMesh& mesh = domain.mesh();
  require_radii(radii_, mesh.vertices().size());
  const auto [least, most] = std::minmax_element(radii_.begin(), radii_.end());
  least_ = *least;
  most_ = *most;
  for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
    const std::array<std::uint32_t, 3>& face = mesh.faces()[f];
    const double r = radii_[face[0]];
    lipschitz_ = std::max(lipschitz_,
                          slope(mesh.corner(f, 1) - mesh.corner(f, 0), mesh.corner(f, 2) - mesh.corner(f, 0),
                                radii_[face[1]] - r, radii_[face[2]] - r));
  }
}

double VertexSizing::at(Vec3 p) const {
  const MeshPlace place = domain_->locate(p);
  const std::array<std::uint32_t, 3>& face = domain_->mesh().faces()[place.face];
  double r = 0;
  for (std::size_t k = 0; k < 3; ++k) r += place.weights[k] * radii_[face[k]];
  return std::clamp(r, least_, most_);
}

}  // namespace wellspaced

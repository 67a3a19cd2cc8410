#pragma once

#include <memory>
#include <vector>

#include "core/domain/sizing.h"
#include "core/domain/surface_mesh.h"

namespace wellspaced {

/// A radius at each vertex of a surface mesh, linear on its faces.
///
/// Guarantees: continuous; lipschitz() is the steepest slope of any face, exact for lengths along the
/// surface. Errors of the constructor: invalid_parameters at /radii for another number of them than the mesh
/// has vertices (those that no face uses have one, too), at /radii/k for one that is not positive and finite.
/// Requires: the domain outlives it. Cost: `at` .2 us, to find the face.
class VertexSizing final : public Sizing {
 public:
  VertexSizing(const SurfaceMesh& domain, std::vector<double> radii);

  std::string_view type() const override { return "vertices"; }
  const std::vector<double>& radii() const { return radii_; }
  double at(Vec3 p) const override;
  double least() const override { return least_; }
  double most() const override { return most_; }
  double lipschitz() const override { return lipschitz_; }
  bool is_linear() const override { return true; }

 private:
  const SurfaceMesh* domain_;
  std::vector<double> radii_;
  double least_ = 0, most_ = 0, lipschitz_ = 0;
};

}  // namespace wellspaced

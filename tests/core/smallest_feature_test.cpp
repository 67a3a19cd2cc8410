#include "core/domain/smallest_feature.h"

#include <string>

#include <gmock/gmock.h>

#include "core/domain/surface_mesh.h"
#include "core/math.h"
#include "tests/support/meshes.h"

namespace wellspaced {
namespace {

using ::testing::HasSubstr;
using namespace wellspaced::testing;

TEST(SmallestFeature, IsFoundInEachShape) {
  const auto feature = [](const Triangles& triangles) {
    return SurfaceMesh{TriangleMesh(triangles)}.smallest_feature();
  };
  EXPECT_NEAR(feature(refined_sphere(icosahedron(), 3)).length, 1, 0.01);
  // A dent of curvature 40 in the middle.
  const auto dent = [](double x, double y) {
    const double r2 = (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5);
    return -0.05 * portable_exp(-400 * r2);
  };
  const SmallestFeature bottom = feature(height_field(128, 1, dent));
  EXPECT_NEAR(bottom.length, 1.0 / 40, 0.002);
  EXPECT_EQ(bottom.description, "the radius of curvature at vertex " + std::to_string(64 * 129 + 64));
  // A slab, seen from both sides, with sharp edges.
  const SmallestFeature slab = feature({{{0, 0, 0},
                                         {1, 0, 0},
                                         {1, 1, 0},
                                         {0, 1, 0},
                                         {0.5, 0.5, 0},
                                         {0, 0, 0.1},
                                         {1, 0, 0.1},
                                         {1, 1, 0.1},
                                         {0, 1, 0.1}},
                                        {{1, 0, 4},
                                         {2, 1, 4},
                                         {3, 2, 4},
                                         {0, 3, 4},
                                         {5, 6, 7},
                                         {5, 7, 8},
                                         {0, 1, 6},
                                         {0, 6, 5},
                                         {1, 2, 7},
                                         {1, 7, 6},
                                         {2, 3, 8},
                                         {2, 8, 7},
                                         {3, 0, 5},
                                         {3, 5, 8}}});
  EXPECT_NEAR(slab.length, 0.05, 1e-12);
  EXPECT_THAT(slab.description, HasSubstr("half the distance to face"));
  EXPECT_EQ(feature(flat_square(3)).length, 1);
  EXPECT_EQ(feature(flat_square(3)).description, "the extent of the border of 12 edges at vertex 0");
}

}  // namespace
}  // namespace wellspaced

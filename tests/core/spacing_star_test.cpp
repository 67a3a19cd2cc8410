#include "core/analyze/spacing_star.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/math.h"
#include "core/rng.h"
#include "tests/support/vector_widths.h"

namespace wellspaced {
namespace {

/// `degree` spokes around a point, of ids 1 to degree, at angles and lengths that scatter a little.
std::vector<Spoke> star_of(int degree, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Spoke> star;
  for (int k = 0; k < degree; ++k) {
    const double angle = 2 * pi * (k + 0.4 * rng.uniform()) / degree, length = 1 + 0.1 * rng.uniform();
    star.push_back({{length * std::cos(angle), length * std::sin(angle)}, static_cast<std::uint32_t>(k + 1)});
  }
  return star;
}

double angle_between(Vec2 a, Vec2 b) { return std::atan2(cross(a, b), dot(a, b)); }

/// Side by side, with angles as angles and corners from their bisectors' equations.
StarMeasure by_angles(std::size_t i, const std::vector<Spoke>& star) {
  StarMeasure m{1e300, 0, 0, 0, 0, 0, static_cast<int>(star.size())};
  double least = 10, most = 0;
  std::vector<Vec2> corners;
  for (std::size_t k = 0; k < star.size(); ++k) {
    const Vec2 a = star[k].offset, b = star[(k + 1) % star.size()].offset;
    const double at_center = angle_between(a, b), at_a = angle_between(b - a, -1 * a),
                 at_b = pi - at_center - at_a;
    least = std::min({least, at_center, at_a, at_b});
    most = std::max({most, at_center, at_a, at_b});
    if (star[k].id != i) m.nearest = std::min(m.nearest, std::hypot(a.x, a.y));
    m.edge_max = std::max(m.edge_max, std::hypot(a.x, a.y));
    const double radius = norm(b - a) / (2 * std::sin(at_center));
    m.outradius = std::max(m.outradius, radius);
    // From the middle of spoke a, at right angles to it, as far as the angle opposite to it says.
    corners.push_back(0.5 * a + 0.5 / std::tan(at_b) * Vec2{-a.y, a.x});
  }
  for (std::size_t k = 0; k < corners.size(); ++k)
    m.cell_area += cross(corners[k], corners[(k + 1) % corners.size()]) / 2;
  m.cotangent_max = 1 / std::tan(least);
  m.cotangent_min = 1 / std::tan(most);
  return m;
}

TEST(SpacingStar, IsWhatItsAnglesSay) {
  for (int degree = 3; degree <= 40; ++degree)
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}, static_cast<std::size_t>(degree)}) {
      SCOPED_TRACE(::testing::Message() << degree << " spokes, that to " << i << " is an own image");
      const std::vector<Spoke> star = star_of(degree, static_cast<std::uint64_t>(degree));
      const StarMeasure m = measure_star(i, star), wanted = by_angles(i, star);
      EXPECT_NEAR(m.nearest, wanted.nearest, 1e-14);
      EXPECT_NEAR(m.outradius, wanted.outradius, 1e-11);
      EXPECT_NEAR(m.cell_area, wanted.cell_area, 1e-11);
      EXPECT_NEAR(m.edge_max, wanted.edge_max, 1e-14);
      EXPECT_NEAR(m.cotangent_max, wanted.cotangent_max, 1e-11 * wanted.cotangent_max);
      EXPECT_NEAR(m.cotangent_min, wanted.cotangent_min, 1e-11);
      EXPECT_EQ(m.valence, degree);
    }
}

TEST(SpacingStar, OfImagesOfThePointAloneHasNoNearest) {
  std::vector<Spoke> star = star_of(6, 1);
  for (Spoke& spoke : star) spoke.id = 7;
  EXPECT_EQ(measure_star(7, star).nearest, std::numeric_limits<double>::infinity());
}

TEST(SpacingStar, HasTheSameBitsOnAnyVectorWidth) {
  for (int degree = 3; degree <= 40; ++degree) {
    const std::vector<Spoke> star = star_of(degree, 100);
    const StarMeasure first = measure_star(0, star);
    testing::on_every_vector_width([&](const std::string& name) {
      const StarMeasure m = measure_star(0, star);
      EXPECT_EQ(m.nearest, first.nearest) << name;
      EXPECT_EQ(m.outradius, first.outradius) << name;
      EXPECT_EQ(m.cell_area, first.cell_area) << name;
      EXPECT_EQ(m.edge_max, first.edge_max) << name;
      EXPECT_EQ(m.cotangent_max, first.cotangent_max) << name;
      EXPECT_EQ(m.cotangent_min, first.cotangent_min) << name;
    });
  }
}

}  // namespace
}  // namespace wellspaced

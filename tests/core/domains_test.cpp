// Laws that every domain obeys.
#include "tests/support/domains.h"

#include <cmath>

#include <gtest/gtest.h>

namespace wellspaced {
namespace {

using testing::domains_of_every_kind;
using testing::expect_error;
using testing::NamedDomain;

constexpr int draws = 300;

TEST(Domains, RandomPointsLieInsideAndAreFree) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    Rng rng(1);
    for (int k = 0; k < draws; ++k) {
      const Vec3 p = domain->random_point(rng);
      ASSERT_FALSE(domain->why_outside(p));
      ASSERT_EQ(domain->freedom(p).dimensions, 2);
    }
  }
}

TEST(Domains, StepsGoAsFarAsTheySayAndStayInside) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    Rng rng(2);
    for (int k = 0; k < draws; ++k) {
      const Vec3 p = domain->random_point(rng);
      const Vec2 wanted{0.6 * (rng.uniform() - 0.5), 0.6 * (rng.uniform() - 0.5)};
      const Vec2 u = domain->possible(p, wanted);
      const Vec3 q = domain->step(p, u);
      ASSERT_FALSE(domain->why_outside(q));
      ASSERT_EQ(domain->freedom(q).dimensions, 2);
      ASSERT_NEAR(domain->distance(p, q), norm(u), 1e-12);
    }
  }
}

TEST(Domains, WaysLeadToWhereStepsCameFrom) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    Rng rng(3);
    for (int k = 0; k < draws; ++k) {
      const Vec3 p = domain->random_point(rng);
      const Vec2 u = domain->possible(p, {0.2 * (rng.uniform() - 0.5), 0.2 * (rng.uniform() - 0.5)});
      const Vec3 q = domain->step(p, u);
      Vec3 offset = q - p;
      const Box box = domain->box();
      if (box.periodic[0]) offset.x = wrap_difference(offset.x, box.size.x);
      if (box.periodic[1]) offset.y = wrap_difference(offset.y, box.size.y);
      ASSERT_NEAR(norm(domain->way_to(p, {offset, 0}) - u), 0, 1e-12);
    }
  }
}

/// A bisector is where the distances to both points are the same.
TEST(Domains, BisectorsAreEquallyFarFromBothPoints) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    Rng rng(4);
    for (int k = 0; k < draws; ++k) {
      const Vec3 p = domain->place_at(domain->random_point(rng), {});
      const Vec2 to_q = domain->possible(p, {0.2 * (rng.uniform() - 0.5), 0.2 * (rng.uniform() - 0.5)});
      const Vec3 q = domain->step(p, to_q);
      Vec3 offset = q - p;
      const Box box = domain->box();
      if (box.periodic[0]) offset.x = wrap_difference(offset.x, box.size.x);
      if (box.periodic[1]) offset.y = wrap_difference(offset.y, box.size.y);
      const Neighbor neighbor{offset, 0};
      HalfPlane h;
      domain->bisectors(p, {}, {&neighbor, 1}, {&h, 1});
      const Vec2 foot = (h.c / norm2(h.n)) * h.n, along{-h.n.y, h.n.x};
      const Vec2 in_chart = foot + (0.3 * (rng.uniform() - 0.5)) * along;
      const double length = norm(in_chart), distance = domain->chart_to_distance(length);
      if (!domain->holds(p, (distance / length) * in_chart)) continue;
      const Vec3 place = domain->place_at(p, (distance / length) * in_chart);
      ASSERT_NEAR(domain->distance(place, p), domain->distance(place, q), 1e-12);
      ASSERT_NEAR(domain->distance(place, p), distance, 1e-12);
      ASSERT_NEAR(domain->distance_to_chart(distance), length, 1e-9 * length);
    }
  }
}

TEST(Domains, TrianglesAddUpToTheArea) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    double area = 0;
    for (const DomainTriangle& t : domain->triangles()) {
      const Vec3 m = domain->middle(t[0], t[1]);
      const double whole = domain->area_of(t);
      EXPECT_NEAR(domain->area_of({t[0], m, t[2]}) + domain->area_of({m, t[1], t[2]}), whole, 1e-13);
      area += whole;
    }
    EXPECT_NEAR(area, domain->area(), 1e-12);
  }
}

TEST(Domains, RandomPointsInATriangleAreUniform) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    Rng rng(5);
    const DomainTriangle t = domain->triangles().front();
    const Vec3 m = domain->middle(t[0], t[1]), normal = cross(t[2], m);
    const double part = domain->area_of({t[0], m, t[2]}) / domain->area_of(t);
    int first = 0;
    constexpr int n = 20000;
    for (int k = 0; k < n; ++k) {
      const Vec3 p = domain->random_point_in(t, rng);
      const bool flat = domain->is_flat();
      const Vec3 side = flat ? cross(m - t[2], p - t[2]) : Vec3{0, 0, dot(normal, p)};
      const Vec3 corner = flat ? cross(m - t[2], t[0] - t[2]) : Vec3{0, 0, dot(normal, t[0])};
      first += side.z * corner.z > 0 ? 1 : 0;
    }
    EXPECT_NEAR(first, part * n, 5 * std::sqrt(part * (1 - part) * n));
  }
}

TEST(Domains, MomentsAreThoseOfManyRandomPlaces) {
  const std::vector<Vec2> polygon = {{0.1, -0.2}, {0.4, -0.1}, {0.3, 0.3}, {-0.2, 0.2}};
  const Sphere sphere(0.7);
  const PolygonMoments m = sphere.moments(polygon);
  Rng rng(6);
  const Vec3 pole{0, 0, 0.7};
  double inside = 0, second = 0;
  Vec3 sum;
  constexpr int n = 400000;
  for (int k = 0; k < n; ++k) {
    const Vec3 p = sphere.random_point(rng);
    if (p.z <= 0) continue;
    // In the chart at the pole, whose frame sphere.step tells.
    const Vec2 way = sphere.way_to(pole, {p - pole, 0});
    const Vec2 u = (sphere.distance_to_chart(norm(way)) / norm(way)) * way;
    bool within = true;
    for (std::size_t e = 0; e < polygon.size(); ++e)
      within = within && cross(polygon[(e + 1) % 4] - polygon[e], u - polygon[e]) > 0;
    if (!within) continue;
    ++inside;
    sum = sum + p;
    second += norm2(p - pole);
  }
  const double area = inside / n * sphere.area(), error = 4 * std::sqrt(inside) / n * sphere.area();
  EXPECT_NEAR(m.area, area, error);
  EXPECT_NEAR(m.second, second / n * sphere.area(), 0.1 * error);
  const Vec2 to_mean = sphere.way_to(pole, {(0.7 / norm(sum)) * sum - pole, 0});
  EXPECT_NEAR(norm((1 / m.area) * m.first - to_mean), 0, 0.002);
}

TEST(BoxDomain, KnowsItsBoundaryByCoordinatesAlone) {
  const BoxDomain box(2, 1);
  EXPECT_EQ(box.freedom({0, 0, 0}).dimensions, 0);
  EXPECT_EQ(box.freedom({2, 1, 0}).dimensions, 0);
  EXPECT_EQ(box.freedom({2, 0.5, 0}).dimensions, 1);
  EXPECT_EQ(box.freedom({2, 0.5, 0}).along, (Vec2{0, 1}));
  EXPECT_EQ(box.freedom({0.5, 1, 0}).along, (Vec2{1, 0}));
  EXPECT_EQ(box.freedom({std::nextafter(0.0, 1.0), 0.5, 0}).dimensions, 2);
  EXPECT_FALSE(box.why_outside({2, 1, 0}));
  EXPECT_TRUE(box.why_outside({std::nextafter(2.0, 3.0), 1, 0}));
  EXPECT_TRUE(box.why_outside({-1e-300, 0.5, 0}));
  const BoxDomain strip(2, 1, {true, false});
  EXPECT_TRUE(strip.why_outside({2, 0.5, 0}));
  EXPECT_FALSE(strip.why_outside({0, 1, 0}));
  EXPECT_EQ(strip.freedom({0, 1, 0}).dimensions, 1);
  EXPECT_EQ(strip.freedom({0, 0.5, 0}).dimensions, 2);
}

TEST(BoxDomain, KeepsPointsOfTheBoundaryOnTheirSide) {
  const BoxDomain box(2, 1);
  EXPECT_EQ(box.possible({0, 0, 0}, {0.1, 0.1}), (Vec2{0, 0}));
  EXPECT_EQ(box.possible({2, 0.5, 0}, {-0.1, 0.1}), (Vec2{0, 0.1}));
  EXPECT_EQ(box.possible({2, 0.5, 0}, {-0.1, 3}), (Vec2{0, 0.375}));  // three quarters of the way
  EXPECT_EQ(box.step({2, 0.5, 0}, {0, 0.375}), (Vec3{2, 0.875, 0}));
  EXPECT_EQ(box.possible({1.5, 0.5, 0}, {5, 0}), (Vec2{0.375, 0}));
}

TEST(BoxDomain, CurvesGoAroundFromCornerToCorner) {
  const BoxDomain box(2, 1);
  const auto curves = box.boundary();
  ASSERT_EQ(curves.size(), 4u);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(box.freedom(box.boundary_point(c, 0)).dimensions, 0);
    EXPECT_EQ(box.boundary_point(c, curves[c].length), box.boundary_point((c + 1) % 4, 0));
    EXPECT_EQ(box.freedom(box.boundary_point(c, 0.3)).dimensions, 1);
    EXPECT_NEAR(box.distance(box.boundary_point(c, 0.3), box.boundary_point(c, 0.5)), 0.2, 1e-15);
  }
  EXPECT_EQ(box.boundary_point_at({1.3, 1e-14, 0}), (Vec3{1.3, 0, 0}));
  EXPECT_FALSE(box.boundary_point_at({1.3, 0.1, 0}));
}

TEST(BoxDomain, RefusesBadSides) {
  expect_error([] { BoxDomain(0, 1); }, ErrorCode::invalid_parameters, "/width");
  expect_error([] { BoxDomain(1, std::nan("")); }, ErrorCode::invalid_parameters, "/height");
}

TEST(Sphere, RefusesBadRadii) {
  for (const double bad : {0.0, -1.0, std::nan(""), 1e7})
    expect_error([&] { Sphere{bad}; }, ErrorCode::invalid_parameters, "/radius");
}

TEST(Sphere, KnowsTheWayToTheOtherEndOfTheWorld) {
  const Sphere sphere(2);
  EXPECT_NEAR(norm(sphere.way_to({0, 0, 2}, {{0, 0, -4}, 0})), 2 * 3.14159265358979, 1e-13);
  EXPECT_EQ(norm(sphere.way_to({0, 2, 0}, {{0, 0, 0}, 0})), 0);
}

TEST(Sphere, SaysHowFarAPointIsOff) {
  const auto why = Sphere(1).why_outside({0, 0, 1.1});
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("1.1"), std::string::npos);
  EXPECT_FALSE(Sphere(1).why_outside({0, 0, 1 + 1e-12}));
}

TEST(HexagonalSpacing, CountsHalfCellsAtTheBoundary) {
  // k rows of k points of a triangular lattice in a parallelogram-like box: 2 A / (sqrt 3 d^2) + L / (2 d)
  // + 1.
  const BoxDomain box(10, 10);
  const double d = hexagonal_spacing(box, 1000);
  EXPECT_NEAR(2 * 100 / (std::sqrt(3.0) * d * d) + 40 / (2 * d), 1000, 1e-9);
  EXPECT_EQ(hexagonal_spacing(Torus(10, 10), 1000), hexagonal_spacing(100.0, 1000));
}

}  // namespace
}  // namespace wellspaced

// Sets whose radii vary, by orders of magnitude too, against the rule itself.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/domain/box_domain.h"
#include "core/domain/grid_sizing.h"
#include "core/domain/sizing.h"
#include "core/domain/vertex_sizing.h"
#include "core/generate/disk_tree.h"
#include "core/generate/domain_darts.h"
#include "core/generate/expected_points.h"
#include "tests/support/domains.h"
#include "tests/support/meshes.h"

namespace wellspaced {
namespace {

using testing::domains_of_every_kind;

/// Anywhere, or, as that is hardly ever where radii are small, near one of the points.
Vec3 some_place(const PointSet& points, const DiskRule& rule, Rng& rng) {
  const Domain& domain = *points.domain;
  if (rng.uniform() < 0.5) return domain.random_point(rng);
  const Vec3 p = points[static_cast<std::size_t>(rng.uniform() * static_cast<double>(points.size()))];
  const double most = std::min(1.5 * rule.radius(p), 0.2 * domain.farthest());
  const Vec2 u = most * Vec2{2 * rng.uniform() - 1, 2 * rng.uniform() - 1};
  return domain.holds(p, u) ? domain.place_at(p, u) : p;
}

/// By the rule itself, pair by pair and place by place.
void expect_kept(const PointSet& points, const DiskRule& rule, int places) {
  const Domain& domain = *points.domain;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (domain.freedom(points[i]).dimensions == 0 && domain.freedom(points[j]).dimensions == 0) continue;
      const double d = domain.distance(points[i], points[j]), a = rule.radius(points[i]),
                   b = rule.radius(points[j]);
      // Which one came first is not known any more.
      const double room = rule.criterion == Criterion::bigger ? std::max(a, b) : std::min(a, b);
      ASSERT_GE(d, room * (1 - 1e-12)) << i << " " << j;
    }
  Rng rng(4);
  for (int k = 0; k < places; ++k) {
    const Vec3 p = some_place(points, rule, rng);
    double least = 1e300;
    for (std::size_t i = 0; i < points.size() && least > 1; ++i)
      least = std::min(least,
                       domain.distance(p, points[i]) / rule.distance(rule.radius(p), rule.radius(points[i])));
    ASSERT_LE(least, 1) << k;
  }
}

constexpr Criterion criteria[] = {Criterion::smaller, Criterion::bigger, Criterion::prior,
                                  Criterion::current};

/// By each criterion, at some places.
void expect_kept(const std::shared_ptr<const Domain>& domain, const Sizing& sizing, double scale,
                 int places) {
  for (const Criterion criterion : criteria) {
    SCOPED_TRACE(static_cast<int>(criterion));
    Rng rng(3);
    Control control;
    const DiskRule rule{scale, &sizing, criterion};
    expect_kept(throw_darts_over(domain, rule, rng, control), rule, places);
  }
}

TEST(ThrowDartsOver, KeepsToTheRuleWhereRadiiVary) {
  const auto box = std::make_shared<BoxDomain>();
  expect_kept(box, LinearSizing(*box, {0, 0.02, 0.08}), 1, 20000);
}

/// Steeper than any radius allows: neighbors differ by factors.
TEST(ThrowDartsOver, KeepsToTheRuleWhereRadiiAreAnImage) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    RadiusGrid grid{9, 9, std::vector<double>(81)};
    Rng values(2);
    for (double& r : grid.radii) r = values.uniform() < 0.5 ? 0.04 : 0.16;
    expect_kept(domain, GridSizing(*domain, grid), 1, 3000);
  }
}

/// From a thousandth of the domain to more than all of it.
TEST(ThrowDartsOver, KeepsToTheRuleWhereRadiiVaryAThousandfold) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    const double size = norm(domain->box().size);
    expect_kept(domain, LinearSizing(*domain, {0, 1e-3 * size, size}), 8, 2000);
  }
}

TEST(ThrowDartsOver, KeepsToTheRuleWhereRadiiOfVerticesVaryAThousandfold) {
  const auto domain = std::make_shared<const SurfaceMesh>(TriangleMesh(testing::tetrahedron()));
  expect_kept(domain, VertexSizing(*domain, {0.002, 2, 2, 2}), 1, 500);
}

TEST(ThrowDartsOver, HasTheCountThatWasAskedForWhereRadiiVaryAThousandfold) {
  for (const auto& [name, domain] : domains_of_every_kind())
    for (const Criterion criterion : criteria) {
      SCOPED_TRACE(name + " " + std::to_string(static_cast<int>(criterion)));
      const LinearSizing sizing(*domain, {0, 1, 1000});
      Rng rng(3);
      Control control;
      const PointSet points = throw_darts_over_to_count(domain, 250, {1, &sizing, criterion}, rng, control);
      EXPECT_EQ(points.size(), 250u);
    }
}

TEST(ExpectedPoints, AreAboutWhatComesHoweverMuchRadiiVary) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    for (const double ratio : {1.0, 30.0, 1000.0}) {
      SCOPED_TRACE(name + " " + std::to_string(ratio));
      const LinearSizing sizing(*domain, {0, 1, ratio});
      const DiskRule rule{scale_for_count(*domain, {1, &sizing}, 600), &sizing};
      EXPECT_NEAR(expected_points(*domain, rule), 600, 1e-6);
      Rng rng(1);
      Control control;
      const auto found = static_cast<double>(throw_darts_over(domain, rule, rng, control).size());
      EXPECT_GT(found, 600 / (ratio < 100 ? 1.3 : 2.5));
      EXPECT_LT(found, 600 * (ratio < 100 ? 1.3 : 2.5));
    }
  }
}

TEST(DiskTree, FindsWhatBruteForceFinds) {
  for (const auto& [name, domain] : domains_of_every_kind()) {
    SCOPED_TRACE(name);
    PointSet points{domain, {}};
    std::vector<double> radii;
    DiskTree tree(points, radii);
    Rng rng(5);
    const Box box = domain->box();
    for (std::uint32_t i = 0; i < 400; ++i) {
      points.push_back(i % 3 == 0 && i > 0 ? points[i - 1] : domain->random_point(rng));  // crowds, too
      radii.push_back(norm(box.size) * std::pow(10, -4 * rng.uniform()));
      tree.add(i);
      const Vec3 base = domain->random_point(rng);
      const double own = radii[rng.uniform() < 0.5 ? 0 : i];
      const auto reach = [&](double radius) { return std::min(own, radius); };
      std::vector<double> found(i + 1, HUGE_VAL);
      EXPECT_FALSE(tree.any(base, reach, [&](const Neighbor& q) {
        found[q.id] = std::min(found[q.id], norm(q.offset));
        return false;
      }));
      for (std::uint32_t k = 0; k <= i; ++k) {
        Vec3 way = points[k] - base;
        if (box.periodic[0]) way.x = std::remainder(way.x, box.size.x);
        if (box.periodic[1]) way.y = std::remainder(way.y, box.size.y);
        const double nearest = norm(way);
        if (nearest < reach(radii[k]) * (1 - 1e-12)) {
          ASSERT_NEAR(found[k], nearest, 1e-12) << i << " " << k;
        } else if (nearest > reach(radii[k]) * (1 + 1e-12)) {
          ASSERT_EQ(found[k], HUGE_VAL) << i << " " << k;
        }
      }
    }
  }
}

}  // namespace
}  // namespace wellspaced

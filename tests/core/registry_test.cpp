#include "core/registry.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "core/domain/torus.h"

namespace wellspaced {
namespace {

template <class Row>
void expect_well_described(std::span<const Row> rows) {
  std::set<std::string> names;
  for (const Row& row : rows) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(names.insert(row.name).second) << "two methods of that name";
    EXPECT_TRUE(std::regex_match(row.name, std::regex("[a-z]+(-[a-z]+)*")));
    EXPECT_FALSE(row.title.empty());
    EXPECT_TRUE(row.description.ends_with("."));
    EXPECT_NE(row.run, nullptr);
    std::set<std::string> parameters;
    for (const Parameter& p : row.parameters) {
      SCOPED_TRACE(p.name);
      EXPECT_TRUE(parameters.insert(p.name).second) << "two parameters of that name";
      EXPECT_TRUE(std::regex_match(p.name, std::regex("[a-z]+(_[a-z]+)*")));
      EXPECT_FALSE(p.description.empty());
      EXPECT_LT(p.minimum, p.maximum);
      EXPECT_FALSE(p.required && p.density) << "of density parameters any one will do";
      EXPECT_FALSE(p.required && !p.fallback.empty()) << "what must be given has no default";
      if (p.type == Parameter::Type::integer) {
        EXPECT_EQ(p.minimum, std::floor(p.minimum));
        EXPECT_EQ(p.maximum, std::floor(p.maximum));
        EXPECT_LE(p.maximum, 0x1p53);
      }
    }
  }
}

TEST(Registry, DescribesEveryMethod) {
  expect_well_described(generators());
  expect_well_described(optimizers());
}

TEST(Registry, EveryGeneratorTakesACount) {
  for (const Generator& generator : generators()) {
    const auto domain = std::make_shared<Torus>(2, 1);
    const Arguments arguments = {{"count", 200}};
    EXPECT_EQ(generator.expected_count(domain, arguments), 200) << generator.name;
    if (generator.check != nullptr) {
      EXPECT_NO_THROW(generator.check(domain, arguments)) << generator.name;
    }
    Rng rng(1);
    Control control;
    const PointSet points = generator.run(domain, arguments, rng, control);
    EXPECT_EQ(points.size(), 200u) << generator.name;
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_FALSE(domain->why_outside(points[i])) << generator.name << " " << i;
  }
}

TEST(Registry, OnlyRandomGeneratorsDependOnTheSeed) {
  for (const Generator& generator : generators()) {
    const auto made = [&](std::uint64_t seed) {
      Rng rng(seed);
      Control control;
      return generator.run(std::make_shared<Torus>(), {{"count", 100}}, rng, control).coordinates;
    };
    EXPECT_EQ(made(1), made(1)) << generator.name;
    EXPECT_EQ(generator.random, made(1) != made(2)) << generator.name;
  }
}

TEST(Registry, ExpectsAsManyPointsAsARadiusGives) {
  const Generator& poisson_disk = generators().front();
  const auto domain = std::make_shared<Torus>(3, 1);
  Rng rng(1);
  Control control;
  const Arguments arguments = {{"radius", 0.02}};
  const auto n = static_cast<double>(poisson_disk.run(domain, arguments, rng, control).size());
  EXPECT_NEAR(poisson_disk.expected_count(domain, arguments), n, 0.02 * n);
}

TEST(Registry, PoissonDiskHasItsCountOnThinToriToo) {
  const Generator& poisson_disk = generators().front();
  for (const double count : {1.0, 20.0, 200.0, 5000.0}) {
    Rng rng(1);
    Control control;
    const auto n =
        poisson_disk.run(std::make_shared<Torus>(1000, 1), {{"count", count}}, rng, control).size();
    EXPECT_EQ(static_cast<double>(n), count);
  }
}

TEST(Registry, OptimizerCostGrowsWithItsAllowance) {
  for (const Optimizer& optimizer : optimizers()) {
    const auto allowance = std::find_if(optimizer.parameters.begin(), optimizer.parameters.end(),
                                        [](const Parameter& p) { return p.name.starts_with("max_"); });
    ASSERT_NE(allowance, optimizer.parameters.end()) << optimizer.name;
    const auto seconds = [&](double most) {
      return optimizer.cost_a_point({{allowance->name, most}}).seconds;
    };
    EXPECT_GT(seconds(100), 1.2 * seconds(1)) << optimizer.name;
    EXPECT_GE(seconds(2000), seconds(1000)) << optimizer.name;  // some need no more, as a rule
    EXPECT_GT(seconds(1), 0) << optimizer.name;
  }
}

TEST(Argument, IsFoundByName) {
  const Arguments arguments = {{"count", 3}};
  EXPECT_EQ(argument(arguments, "count"), 3);
  EXPECT_FALSE(argument(arguments, "radius"));
}

}  // namespace
}  // namespace wellspaced

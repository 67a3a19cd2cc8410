#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/render/pictures/pictures.h"
#include "tests/support/oracle.h"
#include "tests/support/svg_text.h"

namespace wellspaced {
namespace {

using testing::expect_part;
using testing::occurrences;
using testing::why_malformed;

const Picture& picture_named(const std::string& name) {
  for (const Picture& picture : pictures())
    if (picture.name == name) return picture;
  throw Error(ErrorCode::internal, "no picture " + name);
}

std::string svg(const PointSet& points, const std::string& picture = "voronoi", unsigned threads = 1,
                const Arguments& arguments = {}) {
  const Control control(threads);
  const PictureGroup group{"", {&points, 1}, {}};
  return to_svg(picture_named(picture).make({&group, 1}, arguments, control), control);
}

constexpr const char* point_pictures[] = {"voronoi", "delaunay", "points"};

PointSet inline_points(double width, double height, std::vector<double> coordinates) {
  return {std::make_shared<Torus>(width, height), std::move(coordinates)};
}

std::vector<PointSet> some_point_sets() {
  Control control;
  Rng rng(1);
  const auto unit = std::make_shared<Torus>(), thin = std::make_shared<Torus>(1000, 1),
             tall = std::make_shared<Torus>(0.001, 1), tiny = std::make_shared<Torus>(1e-6, 2e-6),
             huge = std::make_shared<Torus>(1e6, 5e5);
  return {triangular_lattice(unit, 100, control),
          square_lattice(unit, 100, control),
          hexagonal_lattice(unit, 100, control),
          inline_points(1, 1, {0, 0, 0.5, 0.1, 0.2, 0.7}),
          inline_points(1000, 1, {0, 0, 500, 0.1, 20, 0.7}),
          triangular_lattice(thin, 300, control),
          poisson_disk(tall, {0.002}, rng, control),
          poisson_disk(tiny, {2e-7}, rng, control),
          poisson_disk(huge, {1e5}, rng, control),
          testing::random_points(1, 1, 1000, 1)};
}

TEST(PointPictures, WritesWellFormedXml) {
  EXPECT_EQ(why_malformed("<a b=\"1\" c=\"2\">\nx<d/>\n<e>y</e></a>\n"), "");
  for (const char* bad :
       {"", "x", "<a>", "<a></b>", "<a/><b/>", "<a b=1/>", "<a b=\"1\" b=\"2\"/>", "<a", "<a/>x"})
    EXPECT_NE(why_malformed(bad), "") << bad;
  for (const PointSet& points : some_point_sets())
    for (const char* picture : point_pictures) {
      const std::string text = svg(points, picture);
      EXPECT_EQ(why_malformed(text), "") << points.size();
      for (const char* bad : {"nan", "inf", "\"\"", "-0 "})
        EXPECT_TRUE(text.find(bad) == std::string::npos) << bad;
    }
}

TEST(PointPictures, DrawsEverySampleAtItsPlace) {
  const std::string text = svg(inline_points(2, 1, {0.5, 0.25, 1.5, 0.5, 1.25, 0.75}), "points");
  EXPECT_EQ(occurrences(text, "<circle"), 3u);
  expect_part(text, "cx=\"241\" cy=\"353.5\"");  // there is a margin of 16
  expect_part(text, "cx=\"691\" cy=\"241\"");
}

TEST(PointPictures, DrawsWhatCrossesTheBorderOnBothSides) {
  const std::string corner = svg(inline_points(1, 1, {0, 0, 0.5, 0.5, 0.25, 0.6}), "points");
  EXPECT_EQ(occurrences(corner, "<circle"), 6u);
  for (const char* place :
       {"cx=\"16\" cy=\"916\"", "cx=\"916\" cy=\"916\"", "cx=\"16\" cy=\"16\"", "cx=\"916\" cy=\"16\""})
    expect_part(corner, place);
}

/// The areas of the cells that are drawn, clipped to the panel, in square pixels; without the panel's border,
/// which begins in its corner.
double painted_area(const std::string& text, double width_px, double height_px) {
  double sum = 0;
  for (auto at = text.find(" d=\"M"); at != text.find(" d=\"M16 16 "); at = text.find(" d=\"M", at + 1)) {
    std::vector<Vec2> polygon;
    for (const char* p = text.c_str() + at + 5; *p != 'Z';) {
      char* next = nullptr;
      const double x = std::strtod(p, &next), y = std::strtod(next, &next);
      polygon.push_back({x - 16, y - 16});
      p = next + 1;
    }
    // Sutherland-Hodgman against the four sides.
    for (const auto& [normal, limit] :
         {std::pair{Vec2{-1, 0}, 0.0}, {Vec2{1, 0}, width_px}, {Vec2{0, -1}, 0.0}, {Vec2{0, 1}, height_px}}) {
      std::vector<Vec2> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        const double da = limit - dot(normal, a), db = limit - dot(normal, b);
        if (da >= 0) kept.push_back(a);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(a + (da / (da - db)) * (b - a));
      }
      polygon = kept;
    }
    double twice = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      twice += cross(polygon[k], polygon[(k + 1) % polygon.size()]);
    sum += std::abs(twice) / 2;
  }
  return sum;
}

TEST(PointPictures, PaintsTheWholeDomainOnce) {
  for (const PointSet& points :
       {testing::random_points(1, 1, 200, 3), testing::random_points(3, 1, 200, 4),
        testing::random_points(8, 1, 5, 5), inline_points(1, 1, {0, 0, 0.5, 0.1, 0.2, 0.7})}) {
    const double height = 900 / points.domain->box().size.x;
    EXPECT_NEAR(painted_area(svg(points), 900, height), 900 * height, 1e-3 * 900 * height) << points.size();
  }
}

TEST(PointPictures, DrawsEachDelaunayEdgeOfATorus) {
  // A torus has three edges a point; those that cross the border are drawn more than once.
  Rng rng(1);
  Control control;
  const PointSet points = poisson_disk(std::make_shared<Torus>(), {0.04}, rng, control);
  const std::size_t edges = occurrences(svg(points, "delaunay"), "<path ") - 1;  // and the border
  EXPECT_GE(edges, 3 * points.size());
  EXPECT_LE(edges, 3.6 * static_cast<double>(points.size()));
}

TEST(PointPictures, KeepsTheLegendInsideTheSheet) {
  for (const double width : {0.001, 0.5, 1.0, 1000.0}) {
    const std::string text = svg(inline_points(width, 1, {0, 0, width / 2, 0.1, width / 3, 0.7}));
    const double sheet = std::strtod(text.c_str() + text.find("width=\"") + 7, nullptr);
    EXPECT_GE(sheet, 300) << width;
  }
}

TEST(PointPictures, SaysWhatWasMeasured) {
  Control control;
  const std::string text = svg(square_lattice(std::make_shared<Torus>(), 100, control));
  expect_part(text, "<title>100 points, beta 0.7071</title>");
  expect_part(text, ">β = 0.7071<");
  expect_part(text, ">ρ = 0.9306<");
}

TEST(PointPictures, ColorsTheBestDarkBlueAndTheWorstAmber) {
  Control control;
  const auto box = std::make_shared<Torus>(std::sqrt(3.0), 1);
  expect_part(svg(triangular_lattice(box, 216, control)), "<g fill=\"#301c60\"");
  expect_part(svg(hexagonal_lattice(box, 200, control)), "<g fill=\"#e8a018\"");
}

TEST(PointPictures, GivesTheSameBytesOnAnyNumberOfThreads) {
  const PointSet points = testing::random_points(1, 1, 1000, 2);
  for (const char* picture : point_pictures) EXPECT_TRUE(svg(points, picture, 1) == svg(points, picture, 3));
}

TEST(PointPictures, RefusesWhatCantBeMeasured) {
  testing::expect_error([] { svg(inline_points(1, 1, {0, 0, 0.5, 0.5})); }, ErrorCode::degenerate_input, "");
  testing::expect_error(
      [] {
        svg(inline_points(1, 1, {0, 0, 0.5, 0.5, 0, 0}));
      },
      ErrorCode::degenerate_input, "/2");
}

TEST(PointPictures, StopsWhenItIsCancelled) {
  Control control;
  control.cancel();
  const PointSet points = testing::random_points(1, 1, 100, 1);
  const PictureGroup group{"", {&points, 1}, {}};
  testing::expect_error(
      [&] {
        picture_named("voronoi").make({&group, 1}, {}, control);
      },
      ErrorCode::cancelled, "");
}

TEST(PointPictures, DrawAllSetsOfAGroupAndTheFirstOfEachOfSeveral) {
  const std::vector<PointSet> sets = {testing::random_points(1, 1, 20, 1),
                                      testing::random_points(1, 1, 20, 2),
                                      testing::random_points(1, 1, 20, 3)};
  const Control control;
  const auto circles = [&](std::span<const PictureGroup> groups) {
    return occurrences(to_svg(picture_named("points").make(groups, {{"size_px", 100}}, control), control),
                       "<circle");
  };
  const PictureGroup all{"a <label> & more", sets, {}};
  EXPECT_GE(circles({&all, 1}), 60u);
  EXPECT_LT(circles({&all, 1}), 100u);
  const std::vector<PictureGroup> two = {all, {"b", {sets.data(), 2}, {}}};
  EXPECT_GE(circles(two), 40u);
  EXPECT_LT(circles(two), 60u);
  const std::string text = to_svg(picture_named("points").make(two, {}, control), control);
  EXPECT_EQ(why_malformed(text), "");
  expect_part(text, "a &lt;label&gt; &amp; more");
}

TEST(PointPictures, ColorByEveryMeasure) {
  const PointSet points = testing::random_points(1, 1, 100, 1);
  std::set<std::string> texts;
  for (int color = 0; color <= 6; ++color)
    for (const char* picture : point_pictures) {
      const std::string text = svg(points, picture, 1, {{"color", color}, {"size_px", 300}});
      EXPECT_EQ(why_malformed(text), "");
      EXPECT_TRUE(texts.insert(text).second) << color << " " << picture;
    }
}

}  // namespace
}  // namespace wellspaced

#include "core/render/svg.h"

#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

constexpr Picture all_pictures[] = {Picture::voronoi, Picture::delaunay, Picture::points};

std::string svg(const PointSet& points, Picture picture = Picture::voronoi, unsigned threads = 1) {
  return render_svg(points, {picture, 900}, Control(threads));
}

PointSet inline_points(double width, double height, std::vector<double> coordinates) {
  return {std::make_shared<Torus>(width, height), std::move(coordinates)};
}

/// The attributes of a start tag, or nothing if they aren't name="value" pairs with different names.
bool attributes_are_sound(std::string_view text) {
  std::set<std::string> names;
  while (!text.empty()) {
    if (text.front() != ' ') return false;
    text.remove_prefix(1);
    const auto equals = text.find("=\"");
    if (equals == std::string_view::npos || equals == 0) return false;
    const auto end = text.find('"', equals + 2);
    if (end == std::string_view::npos) return false;
    if (!names.insert(std::string(text.substr(0, equals))).second) return false;
    if (text.substr(0, end).find('<') != std::string_view::npos) return false;
    text.remove_prefix(end + 1);
  }
  return true;
}

/// Why a text is not well-formed XML of the simple kind that render_svg writes; empty if it is.
std::string why_malformed(std::string_view text) {
  std::vector<std::string> open;
  bool seen_root = false;
  while (!text.empty()) {
    const auto tag = text.find('<');
    if (open.empty() && text.find_first_not_of('\n') < tag) return "text outside the root";
    if (tag == std::string_view::npos) break;
    text.remove_prefix(tag + 1);
    const auto end = text.find('>');
    if (end == std::string_view::npos) return "a tag without an end";
    std::string_view inside = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (inside.starts_with('/')) {
      if (open.empty() || open.back() != inside.substr(1)) return "closes " + std::string(inside);
      open.pop_back();
      continue;
    }
    if (open.empty() && seen_root) return "two roots";
    seen_root = true;
    const bool empty = inside.ends_with('/');
    if (empty) inside.remove_suffix(1);
    const std::string name(inside.substr(0, inside.find(' ')));
    if (!attributes_are_sound(inside.substr(name.size())))
      return "attributes of <" + std::string(inside) + ">";
    if (!empty) open.push_back(name);
  }
  return open.empty() && seen_root ? "" : "not closed";
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// Without the whole picture in the message.
void expect_part(const std::string& text, const std::string& part) {
  EXPECT_TRUE(text.find(part) != std::string::npos) << "no " << part;
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

TEST(RenderSvg, WritesWellFormedXml) {
  EXPECT_EQ(why_malformed("<a b=\"1\" c=\"2\">\nx<d/>\n<e>y</e></a>\n"), "");
  for (const char* bad :
       {"", "x", "<a>", "<a></b>", "<a/><b/>", "<a b=1/>", "<a b=\"1\" b=\"2\"/>", "<a", "<a/>x"})
    EXPECT_NE(why_malformed(bad), "") << bad;
  for (const PointSet& points : some_point_sets())
    for (const Picture picture : all_pictures) {
      const std::string text = svg(points, picture);
      EXPECT_EQ(why_malformed(text), "") << points.size();
      for (const char* bad : {"nan", "inf", "\"\"", "-0 "})
        EXPECT_TRUE(text.find(bad) == std::string::npos) << bad;
    }
}

TEST(RenderSvg, DrawsEverySampleAtItsPlace) {
  const std::string text = svg(inline_points(2, 1, {0.5, 0.25, 1.5, 0.5, 1.25, 0.75}), Picture::points);
  EXPECT_EQ(occurrences(text, "<circle"), 3u);
  expect_part(text, "cx=\"225\" cy=\"337.5\"");
  expect_part(text, "cx=\"675\" cy=\"225\"");
}

TEST(RenderSvg, DrawsWhatCrossesTheBorderOnBothSides) {
  const std::string corner = svg(inline_points(1, 1, {0, 0, 0.5, 0.5, 0.25, 0.6}), Picture::points);
  EXPECT_EQ(occurrences(corner, "<circle"), 6u);
  for (const char* place :
       {"cx=\"0\" cy=\"900\"", "cx=\"900\" cy=\"900\"", "cx=\"0\" cy=\"0\"", "cx=\"900\" cy=\"0\""})
    expect_part(corner, place);
}

/// The areas of the cells that are drawn, clipped to the picture, in square pixels.
double painted_area(const std::string& text, double width_px, double height_px) {
  double sum = 0;
  for (auto at = text.find(" d=\"M"); at != std::string::npos; at = text.find(" d=\"M", at + 1)) {
    std::vector<Vec2> polygon;
    for (const char* p = text.c_str() + at + 5; *p != 'Z';) {
      char* next = nullptr;
      const double x = std::strtod(p, &next), y = std::strtod(next, &next);
      polygon.push_back({x, y});
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

TEST(RenderSvg, PaintsTheWholeDomainOnce) {
  for (const PointSet& points :
       {testing::random_points(1, 1, 200, 3), testing::random_points(3, 1, 200, 4),
        testing::random_points(8, 1, 5, 5), inline_points(1, 1, {0, 0, 0.5, 0.1, 0.2, 0.7})}) {
    const double height = 900 / points.domain->box().size.x;
    EXPECT_NEAR(painted_area(svg(points), 900, height), 900 * height, 1e-3 * 900 * height) << points.size();
  }
}

TEST(RenderSvg, DrawsEachDelaunayEdgeOfATorus) {
  // A torus has three edges a point; those that cross the border are drawn more than once.
  Rng rng(1);
  Control control;
  const PointSet points = poisson_disk(std::make_shared<Torus>(), {0.04}, rng, control);
  const std::size_t edges = occurrences(svg(points, Picture::delaunay), "<path stroke=");
  EXPECT_GE(edges, 3 * points.size());
  EXPECT_LE(edges, 3.6 * static_cast<double>(points.size()));
}

TEST(RenderSvg, KeepsTheLegendInsideTheSheet) {
  for (const double width : {0.001, 0.5, 1.0, 1000.0}) {
    const std::string text = svg(inline_points(width, 1, {0, 0, width / 2, 0.1, width / 3, 0.7}));
    const double sheet = std::strtod(text.c_str() + text.find("width=\"") + 7, nullptr);
    EXPECT_GE(sheet, 700) << width;
  }
}

TEST(RenderSvg, SaysWhatWasMeasured) {
  Control control;
  const std::string text = svg(square_lattice(std::make_shared<Torus>(), 100, control));
  expect_part(text, "<title>100 points, beta 0.7071</title>");
  expect_part(text, "β = 0.7071");
  expect_part(text, "ρ = 0.9306");
}

TEST(RenderSvg, ColorsTheBestDarkBlueAndTheWorstAmber) {
  Control control;
  const auto box = std::make_shared<Torus>(std::sqrt(3.0), 1);
  expect_part(svg(triangular_lattice(box, 216, control)), "<path fill=\"#301c60\"");
  expect_part(svg(hexagonal_lattice(box, 200, control)), "<path fill=\"#e8a018\"");
}

TEST(RenderSvg, GivesTheSameBytesOnAnyNumberOfThreads) {
  const PointSet points = testing::random_points(1, 1, 1000, 2);
  for (const Picture picture : all_pictures) EXPECT_TRUE(svg(points, picture, 1) == svg(points, picture, 3));
}

TEST(RenderSvg, RefusesWhatCantBeMeasured) {
  testing::expect_error([] { svg(inline_points(1, 1, {0, 0, 0.5, 0.5})); }, ErrorCode::degenerate_input, "");
  testing::expect_error(
      [] {
        svg(inline_points(1, 1, {0, 0, 0.5, 0.5, 0, 0}));
      },
      ErrorCode::degenerate_input, "/2");
}

TEST(RenderSvg, StopsWhenItIsCancelled) {
  Control control;
  control.cancel();
  testing::expect_error([&] { render_svg(testing::random_points(1, 1, 100, 1), {}, control); },
                        ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace wellspaced

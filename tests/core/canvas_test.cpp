#include "core/render/canvas.h"

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "core/math.h"
#include "core/render/chart.h"
#include "core/render/drawing.h"
#include "core/render/font.h"
#include "core/render/png.h"
#include "core/render/raster.h"
#include "tests/support/oracle.h"
#include "tests/support/png_image.h"
#include "tests/support/svg_text.h"

namespace wellspaced {
namespace {

using ::testing::ElementsAre;
using testing::expect_part;
using testing::PngImage;
using testing::read_png;
using testing::why_malformed;

constexpr Rgb red{200, 0, 0}, blue{0, 0, 200};

Drawing drawing(double width, double height, std::function<void(Canvas&)> draw) {
  return {width, height, "a title", std::move(draw)};
}

PngImage png(double width, double height, double scale, std::function<void(Canvas&)> draw) {
  return read_png(to_png(drawing(width, height, std::move(draw)), scale, Control()));
}

std::string svg(std::function<void(Canvas&)> draw) {
  return to_svg(drawing(50, 40, std::move(draw)), Control());
}

/// How much ink there is, in pixels of black.
double darkness(const PngImage& image) {
  double sum = 0;
  for (const std::uint8_t v : image.rgb) sum += (255 - v) / 765.0;
  return sum;
}

TEST(TextRuns, ReadSubscriptsAndSuperscripts) {
  const auto runs = [](const char* text) {
    std::string all;
    for (const TextRun& run : text_runs(text, false)) all += run.text + "|" + std::to_string(run.level) + " ";
    return all;
  };
  EXPECT_EQ(runs("r_f = 2"), "r|0 f|-1  = 2|0 ");
  EXPECT_EQ(runs("10^{-3}"), "10|0 -3|1 ");
  EXPECT_EQ(runs("_ψx"), "ψ|-1 x|0 ");
  EXPECT_EQ(runs("a_"), "a_|0 ");
  EXPECT_EQ(runs("a_{b"), "a|0 {|-1 b|0 ");
  EXPECT_EQ(text_runs("a_b", true).size(), 1u);
}

TEST(SvgCanvas, WritesWellFormedXmlWhateverTheText) {
  const std::string text = svg([](Canvas& canvas) {
    canvas.text({1, 2}, "<&\">\x01\x7f\xef\xbf\xbe", {12, ink, Align::end, true});
    canvas.text({1, 2}, "a_b", {12, ink, Align::middle, false, true});
    canvas.text({1, 2}, "", {});
    canvas.clip({0, 0, 10, 10});
    canvas.circle({5, 5}, 2, {red, Pen{blue, 1, 3}, 0.5});
    canvas.unclip();
    canvas.image({0, 0, 4, 4}, {1, 1, {1, 2, 3}});
  });
  EXPECT_EQ(why_malformed(text), "");
  expect_part(text, ">&lt;&amp;&quot;&gt;</text>");
  expect_part(text, ">a_b</text>");
  expect_part(text, "<title>a title</title>");
  EXPECT_EQ(text.find(" id="), std::string::npos);
}

TEST(SvgCanvas, GroupsWhatIsPaintedAlike) {
  const std::string text = svg([](Canvas& canvas) {
    canvas.circle({1, 1}, 1, {red, std::nullopt});
    canvas.circle({2, 1}, 1, {red, std::nullopt});
    canvas.circle({3, 1}, 1, {blue, std::nullopt});
    canvas.circle({4, 1}, 1, {std::nullopt, Pen{blue, 1}});
  });
  EXPECT_EQ(testing::occurrences(text, "<g "), 2u);
  expect_part(text, "<circle r=\"1\" cx=\"2\" cy=\"1\"/>");
  expect_part(text, "<circle fill=\"#0000c8\" r=\"1\" cx=\"3\" cy=\"1\"/>");
}

TEST(PngCanvas, FillsPolygonsByTheirCoverageOfPixels) {
  const PngImage image = png(10, 8, 2, [](Canvas& canvas) {
    canvas.rectangle({1, 1, 3.25, 2}, {red, std::nullopt});
  });
  EXPECT_EQ(image.width, 20u);
  EXPECT_EQ(image.height, 16u);
  EXPECT_THAT(image.at(2, 2), ElementsAre(200, 0, 0));
  EXPECT_THAT(image.at(7, 5), ElementsAre(200, 0, 0));
  EXPECT_THAT(image.at(1, 2), ElementsAre(255, 255, 255));
  EXPECT_THAT(image.at(2, 1), ElementsAre(255, 255, 255));
  EXPECT_THAT(image.at(2, 6), ElementsAre(255, 255, 255));
  EXPECT_NEAR(image.at(8, 3)[1], 127, 2);  // half of it
}

TEST(PngCanvas, CoversTheAreaOfItsShapes) {
  const Paint black{Rgb{0, 0, 0}, std::nullopt};
  EXPECT_NEAR(darkness(png(30, 30, 1, [&](Canvas& c) { c.circle({15.3, 14.8}, 10, black); })), pi * 100, 3);
  const std::vector<Vec2> triangle = {{2.2, 3.1}, {25.7, 8.4}, {11.3, 27.9}};
  const double area = std::abs(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) / 2;
  EXPECT_NEAR(darkness(png(30, 30, 1, [&](Canvas& c) { c.polygon(triangle, black); })), 0.995 * area, 2);
  const Paint stroke{std::nullopt, Pen{{0, 0, 0}, 2.5}};
  EXPECT_NEAR(darkness(png(30, 30, 1,
                           [&](Canvas& c) {
                             c.polyline(std::array<Vec2, 2>{Vec2{3, 4}, {27, 19}}, stroke);
                           })),
              2.5 * std::hypot(24, 15), 1);
  EXPECT_NEAR(darkness(png(30, 30, 1,
                           [&](Canvas& c) {
                             c.circle({15, 15}, 10, stroke);
                           })),
              2 * pi * 10 * 2.5, 2);
  const Paint dashed{std::nullopt, Pen{{0, 0, 0}, 2, 5}};
  EXPECT_NEAR(darkness(png(30, 30, 1,
                           [&](Canvas& c) {
                             c.polyline(std::array<Vec2, 3>{Vec2{0, 5}, {20, 5}, {20, 25}}, dashed);
                           })),
              40, 2);  // half of what a line would have
}

TEST(PngCanvas, DrawsLinesWithoutLengthAndDashesThatEndWithTheLine) {
  const std::vector<std::vector<Vec2>> lines = {
      {{5, 5}, {5, 5}}, {{5, 5}, {5, 5}, {5, 5}}, {{1, 5}, {1, 5}, {13, 5}, {13, 5}},
      {{1, 1}, {3, 1}}, {{1, 1}, {5, 1}},         {{1, 3}, {1 + 1e-9, 3}}};
  for (const double dash : {0.0, 2.0, 2.2, 7.0})
    for (const auto& line : lines) {
      const Paint paint{std::nullopt, Pen{{0, 0, 0}, 1.6, dash}};
      EXPECT_EQ(png(20, 20, 1,
                    [&](Canvas& c) {
                      c.polyline(line, paint);
                      c.polygon(line, paint);
                    })
                    .width,
                20u);
    }
}

TEST(PngCanvas, DrawsLongLinesWhole) {
  std::vector<Vec2> zigzag;
  for (int i = 0; i < 40'000; ++i) zigzag.push_back({i * 0.02, i % 2 == 0 ? 5.0 : 6.0});
  const PngImage image = png(800, 12, 1, [&](Canvas& c) {
    c.polyline(zigzag, {std::nullopt, Pen{{0, 0, 0}, 1}});
  });
  for (std::size_t x = 2; x < 798; ++x) EXPECT_LT(image.at(x, 5)[0], 60) << x;
}

TEST(PngCanvas, ShowsNothingOutsideOfItsClip) {
  const PngImage image = png(10, 10, 1, [](Canvas& canvas) {
    canvas.push({1, 1});
    canvas.clip({2, 2, 3, 3});
    canvas.rectangle({-5, -5, 30, 30}, {red, std::nullopt});
    canvas.image({0, 0, 10, 3}, {1, 1, {0, 0, 9}});
    canvas.unclip();
    canvas.pop();
    canvas.circle({0.5, 0.5}, 3, {std::nullopt, std::nullopt});
  });
  int painted = 0;
  for (std::size_t y = 0; y < 10; ++y)
    for (std::size_t x = 0; x < 10; ++x) painted += image.at(x, y)[1] != 255;
  EXPECT_EQ(painted, 9);
  EXPECT_THAT(image.at(3, 3), ElementsAre(0, 0, 9));
  EXPECT_THAT(image.at(5, 5), ElementsAre(200, 0, 0));
}

TEST(PngCanvas, BlendsByOpacity) {
  const PngImage image = png(4, 4, 1, [](Canvas& c) {
    c.rectangle({0, 0, 4, 4}, {Rgb{0, 0, 0}, std::nullopt, 0.25});
  });
  EXPECT_NEAR(image.at(1, 1)[0], 191, 1);
}

TEST(PngCanvas, DrawsEveryPixelOfAnImageAsARectangle) {
  const Image two{2, 1, {9, 9, 9, 200, 200, 200}};
  const PngImage image = png(6, 2, 2, [&](Canvas& c) { c.image({1, 0, 4, 2}, two); });
  EXPECT_THAT(image.at(2, 0), ElementsAre(9, 9, 9));
  EXPECT_THAT(image.at(5, 3), ElementsAre(9, 9, 9));
  EXPECT_THAT(image.at(6, 0), ElementsAre(200, 200, 200));
  EXPECT_THAT(image.at(9, 3), ElementsAre(200, 200, 200));
  EXPECT_THAT(image.at(1, 0), ElementsAre(255, 255, 255));
}

TEST(PngCanvas, WritesTextWhereItIsAligned) {
  const auto columns = [](const TextStyle& style) {
    const PngImage image = png(100, 40, 1, [&](Canvas& c) { c.text({50, 30}, "lβ_i", style); });
    std::size_t first = 100, last = 0;
    for (std::size_t y = 0; y < 40; ++y)
      for (std::size_t x = 0; x < 100; ++x)
        if (image.at(x, y)[0] < 128) {
          first = std::min(first, x);
          last = std::max(last, x);
        }
    return std::pair(first, last);
  };
  const auto start = columns({20, ink, Align::start}), middle = columns({20, ink, Align::middle}),
             end = columns({20, ink, Align::end}), upward = columns({20, ink, Align::start, true});
  EXPECT_GE(start.first, 50u);
  EXPECT_LE(end.second, 50u);
  EXPECT_NEAR(static_cast<double>(middle.first + middle.second), 100, 4);
  EXPECT_LE(upward.second, 56u);  // letters stand to the left of the line, what hangs below to its right
  EXPECT_GT(start.second - start.first, 15u);
}

TEST(Text, WithAHaloStandsOutFromWhatItIsWrittenOver) {
  const auto draw = [](bool halo) {
    return [halo](Canvas& canvas) {
      canvas.rectangle({0, 0, 60, 30}, {Rgb{0, 0, 0}, std::nullopt});
      TextStyle style{20, red};
      style.halo = halo;
      canvas.text({10, 20}, "l", style);
    };
  };
  const auto papers = [](const PngImage& image) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < image.rgb.size(); k += 3)
      count += image.rgb[k] == 255 && image.rgb[k + 1] == 255 && image.rgb[k + 2] == 255;
    return count;
  };
  EXPECT_EQ(papers(png(60, 30, 1, draw(false))), 0u);
  EXPECT_GT(papers(png(60, 30, 1, draw(true))), 15u);
  expect_part(svg(draw(true)), "paint-order=\"stroke\"");
  EXPECT_EQ(svg(draw(false)).find("paint-order"), std::string::npos);
}

TEST(SvgCanvas, EnlargesImagesThatViewersWouldBlur) {
  const auto columns = [](std::size_t pixels, double length_px) {
    Image image{pixels, 1, std::vector<std::uint8_t>(3 * pixels, 7)};
    const std::string text = svg([&](Canvas& canvas) { canvas.image({0, 0, length_px, 1}, image); });
    const std::string head = "base64,";
    const std::size_t begin = text.find(head) + head.size();
    return testing::read_png(testing::from_base64(text.substr(begin, text.find('"', begin) - begin))).width;
  };
  EXPECT_EQ(columns(21, 420), 840u);
  EXPECT_EQ(columns(400, 420), 400u);
  EXPECT_EQ(columns(1000, 4000), 4000u);
}

TEST(PngCanvas, IsFreeToRefuseHugePictures) {
  testing::expect_error([] { to_png(drawing(30'000, 30'000, [](Canvas&) {}), 1, Control()); },
                        ErrorCode::too_large, "/scale");
}

/// Draws so many squares and cancels after one of them; how many it came to.
int drawn_until_cancelled(int squares, int cancelled_after) {
  Control control;
  int drawn = 0;
  const Drawing many = drawing(20, 20, [&](Canvas& canvas) {
    for (int k = 0; k < squares; ++k) {
      canvas.rectangle({1, 1, 10, 10}, {red, std::nullopt});
      if (++drawn == cancelled_after) control.cancel();
    }
  });
  testing::expect_error([&] { to_png(many, 1, control); }, ErrorCode::cancelled, "");
  return drawn;
}

TEST(PngCanvas, StopsAtTheNextShapeAndWhileItIsWritten) {
  EXPECT_EQ(drawn_until_cancelled(1000, 3), 3);
  EXPECT_EQ(drawn_until_cancelled(5, 5), 5);  // nothing is left but to write it
}

TEST(PngCanvas, StopsAtItsDeadlineBeforeItBegins) {
  Control control;
  control.set_deadline(Control::Clock::now() - std::chrono::seconds(1));
  const Drawing never = drawing(20, 20, [](Canvas&) { ADD_FAILURE() << "drawn"; });
  testing::expect_error([&] { to_png(never, 1, control); }, ErrorCode::deadline_exceeded, "");
  testing::expect_error([&] { to_svg(never, control); }, ErrorCode::deadline_exceeded, "");
}

TEST(PngCanvas, StopsAmongStrokesAndInImages) {
  const Image image{1, 2, {0, 0, 0, 9, 9, 9}};
  const std::function<void(Canvas&)> ways[] = {[](Canvas& canvas) {
                                                 canvas.line({0, 0}, {9, 9}, {ink, 1});
                                               },
                                               [](Canvas& canvas) {
                                                 canvas.circle({9, 9}, 3, {std::nullopt, Pen{ink, 1}});
                                               },
                                               [](Canvas& canvas) {
                                                 canvas.text({0, 9}, "a", {});
                                               },
                                               [&](Canvas& canvas) {
                                                 canvas.image({0, 0, 9, 9}, image);
                                               }};
  for (const auto& way : ways) {
    Control control;
    const auto draw = [&](Canvas& canvas) {
      control.cancel();
      way(canvas);
      ADD_FAILURE() << "went on";
    };
    testing::expect_error([&] { to_png(drawing(20, 20, draw), 1, control); }, ErrorCode::cancelled, "");
  }
}

TEST(WritePng, StopsWhenItIsCancelled) {
  Control control;
  control.cancel();
  const Image gray{1, 1, {7, 7, 7}}, color{1, 1, {1, 2, 3}};
  for (const Image& image : {gray, color})
    testing::expect_error([&] { write_png(image, 0, control); }, ErrorCode::cancelled, "");
  Control late;
  const Drawing pictured = drawing(9, 9, [&](Canvas& canvas) {
    late.cancel();
    canvas.image({0, 0, 9, 9}, gray);
  });
  testing::expect_error([&] { to_svg(pictured, late); }, ErrorCode::cancelled, "");
}

TEST(WritePng, WritesGraysAsGraysAndTellsTheResolution) {
  const Image gray{2, 2, {0, 0, 0, 7, 7, 7, 9, 9, 9, 255, 255, 255}}, color{1, 1, {1, 2, 3}};
  EXPECT_EQ(read_png(write_png(gray, 0, Control())).rgb, gray.rgb);
  EXPECT_EQ(read_png(write_png(color, 0, Control())).rgb, color.rgb);
  EXPECT_EQ(write_png(gray, 0, Control())[25], 0);  // color types of the header
  EXPECT_EQ(write_png(color, 0, Control())[25], 2);
  EXPECT_EQ(write_png(gray, 0, Control()).find("pHYs"), std::string::npos);
  EXPECT_NE(write_png(gray, 192, Control()).find("pHYs"), std::string::npos);
}

TEST(Font, MeasuresText) {
  const Font font;
  EXPECT_EQ(font.width_px("", 20), 0);
  EXPECT_NEAR(font.width_px("ii", 20), 2 * font.width_px("i", 20), 1e-9);
  EXPECT_GT(font.width_px("W", 20), 2 * font.width_px("i", 20));
  EXPECT_GT(font.width_px("β", 20), 8);
  EXPECT_GT(font.width_px("\xff\xc3", 20), 0);  // no UTF-8
  EXPECT_NEAR(font.width_px(text_runs("a_b", false), 10),
              font.width_px("a", 10) + font.width_px("b", 10 * run_scale), 1e-9);
}

TEST(Fitted, CutsAtCharacters) {
  const Font font;
  EXPECT_EQ(fitted(font, "abc", 10, 100), "abc");
  const std::string cut = fitted(font, "αβγδεζηθ", 10, 30);
  EXPECT_LE(font.width_px(cut, 10), 30);
  EXPECT_EQ(cut, std::string("αβγδεζηθ").substr(0, cut.size() - 3) + "…");
  EXPECT_EQ(cut.size() % 2, 1u);  // whole letters of two bytes, and the dots of three
  EXPECT_EQ(fitted(font, "abc", 10, 0), "…");
}

TEST(Chart, MarksPointsThatStandAlone) {
  Chart chart;
  chart.series = {{"", {0.1, 0.2, 0.3}, {std::nan(""), 0.5, std::nan("")}}};
  EXPECT_EQ(testing::occurrences(to_svg(draw(chart), Control()), "<circle"), 1u);
}

TEST(ClassesOfCurves, CanBeToldApart) {
  for (std::size_t a = 0; a < 21; ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_FALSE(color_of_class(a) == color_of_class(b) && dash_px_of_class(a) == dash_px_of_class(b));
}

TEST(RoundTicks, AreRoundAndWithinTheRange) {
  const auto texts = [](double low, double high, int count) {
    std::string all;
    for (const Tick& tick : round_ticks(low, high, count)) all += tick.text + " ";
    return all;
  };
  EXPECT_EQ(texts(0, 1, 5), "0.0 0.2 0.4 0.6 0.8 1.0 ");
  EXPECT_EQ(texts(-2.5, 2.5, 5), "−2 −1 0 1 2 ");
  EXPECT_EQ(texts(0.87, 0.93, 3), "0.88 0.90 0.92 ");
  EXPECT_EQ(texts(0, 2000, 4), "0 500 1000 1500 2000 ");
  EXPECT_EQ(texts(0.1, 1.1, 1), "1 ");
  EXPECT_EQ(texts(1e-5, 2.1e-5, 2), "0.00001 0.00002 ");
}

TEST(RoundTicks, EndWhateverTheRange) {
  for (const auto& [low, high] : {std::pair{0.0, 0.0},
                                  {5.0, 5.0},
                                  {1e300, 1e300},
                                  {1e16, 1e16 + 2},
                                  {-1e99, 1e99},
                                  {1.0, std::nextafter(1.0, 2.0)},
                                  {0.0, 5e-324}}) {
    const std::vector<Tick> ticks = round_ticks(low, high, 5);
    EXPECT_LE(ticks.size(), 100u);
    for (const Tick& tick : ticks) {
      EXPECT_TRUE(std::isfinite(tick.value));
      EXPECT_LT(tick.text.size(), 30u) << tick.text;
      for (const char c : tick.text) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20) << tick.text;
    }
  }
}

TEST(Chart, DrawsOnlyWhatIsNearItsFrame) {
  Chart chart;
  chart.x = {0, 1, "x"};
  chart.y = {0, 1, "y"};
  Series far;
  far.dash_px = 2;
  for (int i = 0; i < 20'000; ++i) {
    far.x.push_back(i);
    far.y.push_back(i % 2 == 0 ? 1e99 : -1e99);
  }
  chart.series = {far};
  const Drawing drawn = draw(chart);
  EXPECT_LT(to_svg(drawn, Control()).size(), 20'000u);
  EXPECT_NO_THROW(to_png(drawn, 2, Control()));
}

TEST(NumberLabel, IsShort) {
  EXPECT_EQ(number_label(0.70710678, 4), "0.7071");
  EXPECT_EQ(number_label(-3, 4), "−3");
  EXPECT_EQ(number_label(-0.0, 4), "0");
  EXPECT_EQ(number_label(0.5, 4), "0.5");
}

TEST(Resampled, KeepsMeans) {
  Raster raster{3, 2, {1, 2, 3, 4, 5, 6}};
  const auto mean = [](const Raster& r) {
    double sum = 0;
    for (const double v : r.values) sum += v / static_cast<double>(r.values.size());
    return sum;
  };
  for (const std::size_t columns : {1u, 2u, 3u, 7u, 300u})
    for (const std::size_t rows : {1u, 2u, 5u})
      EXPECT_NEAR(mean(resampled(raster, 0, 3, 0, 2, columns, rows)), 3.5, 1e-12) << columns << " " << rows;
  EXPECT_EQ(resampled(raster, 0, 3, 0, 2, 3, 2).values, raster.values);
  EXPECT_NEAR(resampled(raster, 0.5, 1.5, 0, 1, 1, 1).values[0], 1.5, 1e-12);
  EXPECT_NEAR(resampled(raster, 1.2, 1.3, 1.2, 1.3, 1, 1).values[0], 5, 1e-12);
}

TEST(ColorAt, InterpolatesAndClamps) {
  EXPECT_EQ(color_at(map_gray, -1), (Rgb{0, 0, 0}));
  EXPECT_EQ(color_at(map_gray, 0.5), (Rgb{127.5, 127.5, 127.5}));
  EXPECT_EQ(color_at(map_gray, 2), (Rgb{255, 255, 255}));
  EXPECT_EQ(color_at(map_gray, std::nan("")), map_gray.front());
  for (std::size_t k = 0; k + 1 < map_sequential.size(); ++k) {  // lightness rises
    const auto luma = [](Rgb c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
    EXPECT_LT(luma(map_sequential[k]) + 10, luma(map_sequential[k + 1])) << k;
  }
}

TEST(Chart, ShowsOnlyWhatIsWithinItsRanges) {
  Chart chart;
  chart.x = {0, 1, "x"};
  chart.y = {0, 1, "y"};
  chart.series = {{"a", {0, 0.5, 1}, {0, 1e300, 0.5}},
                  {"b", {0, 0.5, 1}, {0.5, std::nan(""), 0.5}},
                  {"c", {0, 0.5, 1}, {0.5, 0.2}, Series::Kind::steps}};
  chart.references = {
      {std::nullopt, 0.3, "here"}, {0.4, std::nullopt, "there"}, {std::nullopt, 3, "not shown"}};
  const Drawing d = draw(chart);
  const std::string text = to_svg(d, Control());
  EXPECT_EQ(why_malformed(text), "");
  expect_part(text, "here");
  EXPECT_EQ(text.find("not shown"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_NO_THROW(to_png(d, 1, Control()));
  EXPECT_GT(draw(chart).height_px, chart.height_px + 60);
}

TEST(RoundHigh, IsAboveAllButTheMost) {
  const std::vector<Series> series = {{"", {0, 1, 2}, {0.2, 2.3, std::nan("")}}};
  EXPECT_GE(round_high(series, 1, 8), 2.3);
  EXPECT_LE(round_high(series, 1, 8), 3);
  EXPECT_EQ(round_high(series, 1, 2), 2);
  EXPECT_GE(round_high({}, 1.9, 8), 1.9);
}

}  // namespace
}  // namespace wellspaced

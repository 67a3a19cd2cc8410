#include "core/render/chart.h"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/support/png_image.h"
#include "tests/support/svg_text.h"

namespace wellspaced {
namespace {

Chart noise(std::size_t points, double width_px, Series::Kind kind = Series::Kind::line) {
  Rng rng(1);
  Chart chart;
  chart.width_px = width_px;
  chart.height_px = width_px / 2;
  Series series;
  series.kind = kind;
  for (std::size_t k = 0; k < points; ++k) {
    series.x.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(points));
    series.y.push_back(0.1 + 0.8 * rng.uniform());
  }
  if (kind == Series::Kind::steps) series.y.pop_back();
  chart.series = {std::move(series)};
  return chart;
}

TEST(Chart, ThinsCurvesToWhatPixelsCanShow) {
  const std::size_t few = to_svg(draw(noise(2000, 500)), Control()).size();
  const std::size_t many = to_svg(draw(noise(500000, 500)), Control()).size();
  EXPECT_LT(many, 3 * few);
  EXPECT_LT(to_svg(draw(noise(500000, 500, Series::Kind::steps)), Control()).size(), 8 * few);
}

TEST(Chart, KeepsThePeaksOfACurveThatItThins) {
  Chart chart;
  Series series;
  for (int k = 0; k < 100000; ++k) {
    series.x.push_back(k / 1e5);
    series.y.push_back(k == 31234 ? 0.97 : k == 71234 ? 0.02 : 0.5);
  }
  chart.height_px = 1000;
  chart.series = {std::move(series)};
  const std::string text = to_svg(draw(chart), Control());
  const double bottom = draw(chart).height_px - 46;
  for (const double y : {0.97, 0.02}) {
    const std::string place = " " + std::to_string(static_cast<int>(std::lround(bottom - 1000 * y)));
    EXPECT_NE(text.find(place), std::string::npos) << place;
  }
}

TEST(Chart, LeavesCurvesOfFewPointsAsTheyAre) {
  Chart chart = noise(40, 400);
  chart.series[0].marks = true;
  EXPECT_EQ(testing::occurrences(to_svg(draw(chart), Control()), "<circle"), 40u);
}

TEST(Chart, OfVeryManyPointsIsDrawnInTime) {
  Control control;
  control.set_deadline(Control::Clock::now() + std::chrono::seconds(60));
  for (const auto kind : {Series::Kind::line, Series::Kind::steps})
    EXPECT_NO_THROW(to_png(draw(noise(100000, 4000, kind)), 1, control));
}

}  // namespace
}  // namespace wellspaced

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/render/chart.h"
#include "core/render/pictures/rows.h"

namespace wellspaced {
namespace {

constexpr double width_px = 300, shape = 0.8;
constexpr std::size_t columns = 3;

/// What is drawn of a sweep, in units of `scale`.
struct Quantity {
  const char* title;
  double SweepRecord::*value;
  bool length;  ///< shown in units of d_hex
};

constexpr Quantity quantities[] = {{"β = r_c / r_f", &SweepRecord::beta, false},
                                   {"coverage radius r_c / d_{hex}", &SweepRecord::r_c, true},
                                   {"conflict radius r_f / d_{hex}", &SweepRecord::r_f, true}};

double unit_of(const Quantity& quantity, const PictureGroup& group) {
  const PointSet& set = group.sets.front();
  return quantity.length ? hexagonal_spacing(set.domain->area(), set.size()) : 1;
}

Series history_of(std::span<const PictureGroup> groups, std::size_t number, const Quantity& quantity) {
  const PictureGroup& group = groups[number];
  Series series = curve_of(groups, number);
  constexpr std::size_t most_marks = 60;
  series.marks = group.history.size() <= most_marks;
  for (const SweepRecord& sweep : group.history) {
    series.x.push_back(sweep.sweep);
    series.y.push_back(sweep.*quantity.value / unit_of(quantity, group));
  }
  return series;
}

/// Of all values that will be shown, the finite ones.
std::pair<double, double> limits_of(const std::vector<Series>& all, double last_sweep) {
  double low = 1e300, high = -1e300;
  for (const Series& s : all)
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (s.x[i] <= last_sweep && std::isfinite(s.y[i])) {
        low = std::min(low, s.y[i]);
        high = std::max(high, s.y[i]);
      }
  if (low > high) return {0, 1};  // nothing finite
  const double room = std::max(0.06 * (high - low), 0.05 * std::max(std::abs(low), 1e-3));
  return {low - room, high + room};
}

Drawing chart_of(std::span<const PictureGroup> groups, const Quantity& quantity, double last_sweep,
                 double size_px) {
  Chart chart;
  chart.width_px = size_px;
  chart.height_px = shape * size_px;
  for (std::size_t g = 0; g < groups.size(); ++g) chart.series.push_back(history_of(groups, g, quantity));
  const auto [low, high] = limits_of(chart.series, last_sweep);
  chart.legend = false;
  chart.x = {0, last_sweep, "sweep"};
  chart.y = {low, high, quantity.title};
  return draw(std::move(chart));
}

Drawing make(std::span<const PictureGroup> groups, const Arguments& arguments, const Control&) {
  double last_sweep = 1;
  for (const PictureGroup& group : groups)
    for (const SweepRecord& sweep : group.history)
      last_sweep = std::max(last_sweep, static_cast<double>(sweep.sweep));
  last_sweep = std::min(last_sweep, argument(arguments, "last_sweep").value_or(last_sweep));
  const double size_px = size_px_of(arguments, width_px);
  std::vector<Drawing> charts;
  for (const Quantity& quantity : quantities)
    charts.push_back(chart_of(groups, quantity, last_sweep, size_px));
  std::vector<Series> legend;
  for (std::size_t g = 0; g < groups.size(); ++g) legend.push_back(curve_of(groups, g));
  Drawing sheet = with_legend(grid_of(std::move(charts), columns, panel_gap_px), legend);
  sheet.title = "beta, coverage radius and conflict radius by sweep";
  return with_margin(with_caption(std::move(sheet), groups.size() == 1 ? groups[0].label : ""), 16);
}

}  // namespace

Picture convergence_picture() {
  Picture picture;
  picture.name = "convergence";
  picture.title = "Convergence";
  picture.description =
      "beta, r_c and r_f after each sweep of an optimizer; of several groups the first set of each.";
  Parameter last;
  last.name = "last_sweep";
  last.type = Parameter::Type::integer;
  last.description = "the axis ends here";
  last.minimum = 1;
  last.maximum = 1e9;
  last.fallback = "where the longest ends";
  picture.parameters = {last, size_parameter(width_px, least_chart_px)};
  picture.make = make;
  picture.cost = [](const SetsSize&, const Arguments&) { return Cost{0.01, 1e6}; };
  picture.sheet = [](std::span<const SetsSize>, const Arguments& arguments) {
    const double size_px = size_px_of(arguments, width_px);
    return sheet_of(chart_size(size_px, shape * size_px), std::size(quantities), columns);
  };
  picture.needs_history = true;
  picture.averages = false;
  return picture;
}

}  // namespace wellspaced

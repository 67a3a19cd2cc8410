#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/analyze/distributions.h"
#include "core/analyze/pair_correlation.h"
#include "core/registry_measures.h"
#include "core/render/chart.h"
#include "core/render/pictures/rows.h"

namespace wellspaced {
namespace {

constexpr double correlation_px = 560, correlation_shape = 0.5, histogram_px = 260, histogram_shape = 0.7;
constexpr std::size_t columns = 3;

PairCorrelation mean_correlation(const PictureGroup& group, const PairCorrelationOptions& options,
                                 const Control& control) {
  std::vector<PairCorrelation> all;
  for (const PointSet& set : group.sets) all.push_back(pair_correlation(set, options, control));
  return average(all);
}

Drawing make_pair_correlation(std::span<const PictureGroup> groups, const Arguments& arguments,
                              const Control& control) {
  const PairCorrelationOptions options = pair_correlation_options(arguments);
  const double width_px = size_px_of(arguments, correlation_px);
  Chart chart;
  chart.width_px = width_px;
  chart.height_px = correlation_shape * width_px;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const PairCorrelation mean = mean_correlation(groups[g], options, control);
    Series series = curve_of(groups, g);
    for (std::size_t k = 0; k < mean.g.size(); ++k) {
      series.x.push_back(mean.middle(k));
      series.y.push_back(mean.g[k]);
    }
    chart.series.push_back(std::move(series));
  }
  chart.x = {0, options.reach, "r / d_{hex}"};
  chart.y = {0, round_high(chart.series, 1.8, 12), "pair correlation g(r)"};
  chart.references = {{std::nullopt, 1, "white noise", Align::end}};
  Drawing drawing = draw(std::move(chart));
  drawing.title = "pair correlation";
  return with_margin(with_caption(std::move(drawing), groups.size() == 1 ? groups[0].label : ""), 16);
}

/// More bins than pixels may go up and down over the whole frame in each of its columns.
double drawing_seconds(double bins, double width_px) {
  return bins > width_px ? 5e-7 * width_px * correlation_shape * width_px : 0;
}

struct Quantity {
  const char* title;
  Histogram Distributions::*histogram;
  bool whole = false;  ///< values are whole numbers
};

constexpr Quantity quantities[] = {{"β_i", &Distributions::beta_i},
                                   {"Delaunay neighbors", &Distributions::valence, true},
                                   {"angle, degrees", &Distributions::angle_deg},
                                   {"edge length / d_{hex}", &Distributions::edge},
                                   {"nearest distance / d_{hex}", &Distributions::nearest},
                                   {"cell area / mean", &Distributions::cell_area}};

/// The edges of the bins between which all but `tail` of the values at each end lie.
std::pair<double, double> bulk_of(const Histogram& h, double tail) {
  const double few = tail * static_cast<double>(h.total());
  std::size_t first = 0, last = h.counts.size();
  for (double sum = 0; first + 1 < last; ++first)
    if ((sum += static_cast<double>(h.counts[first])) > few) break;
  for (auto sum = static_cast<double>(h.above); last > first + 1 && sum <= few; --last)
    if ((sum += static_cast<double>(h.counts[last - 1])) > few) break;
  return {h.low + static_cast<double>(first) * h.width, h.low + static_cast<double>(last) * h.width};
}

/// Of the values that are beyond all bins, in the group that has the most.
double share_beyond(std::span<const Distributions> all, const Quantity& quantity) {
  double most = 0;
  for (const Distributions& d : all) {
    const Histogram& h = d.*quantity.histogram;
    most = std::max(most, static_cast<double>(h.above) / static_cast<double>(h.total()));
  }
  return most;
}

/// What shows nearly all values of every group, as far as bins go.
Axis axis_of(std::span<const Distributions> all, const Quantity& quantity) {
  constexpr double tail = 0.001;
  Axis axis{1e300, -1e300, quantity.title};
  for (const Distributions& d : all) {
    const auto [low, high] = bulk_of(d.*quantity.histogram, quantity.whole ? 0 : tail);
    axis.low = std::min(axis.low, low);
    axis.high = std::max(axis.high, high);
  }
  const double share = share_beyond(all, quantity);
  if (share > 0.005) axis.title += " (" + number_label(100 * share, 2) + " % beyond)";
  if (quantity.whole) {
    const double step = std::ceil((axis.high - axis.low) / 12);
    for (double k = std::ceil(axis.low); k < axis.high; k += step)
      axis.ticks.push_back({k, number_label(k, 6)});
    return axis;
  }
  const double room = 0.04 * (axis.high - axis.low);
  axis.low = std::max(0.0, axis.low - room);
  axis.high += room;
  return axis;
}

Distributions pooled(const PictureGroup& group, const Control& control) {
  std::vector<Distributions> all;
  for (const PointSet& set : group.sets) all.push_back(distributions(set, control));
  return pool(std::span<const Distributions>(all));
}

/// As shares of all values a unit of the axis, in bins of `together` of the histogram's own.
Series steps_of(const Histogram& h, std::size_t together, Series series) {
  series.kind = Series::Kind::steps;
  const double total = static_cast<double>(h.total()), width = h.width * static_cast<double>(together);
  // Bins of all groups begin at multiples of their width.
  const auto begin = static_cast<std::size_t>(std::max(0.0, std::round(h.low / h.width))) % together;
  series.x.push_back(h.low - static_cast<double>(begin) * h.width);
  for (std::size_t k = 0; k < h.counts.size(); ++k) {
    if (k == 0 || (k + begin) % together == 0) {
      series.y.push_back(0);
      series.x.push_back(series.x.back() + width);
    }
    series.y.back() += static_cast<double>(h.counts[k]) / total / width;
  }
  return series;
}

/// How many bins are drawn as one, so that not too many are side by side.
std::size_t bins_together(const Axis& axis, double bin_width) {
  constexpr double most_bins = 70;
  return static_cast<std::size_t>(std::max(1.0, std::ceil((axis.high - axis.low) / bin_width / most_bins)));
}

Drawing make_distributions(std::span<const PictureGroup> groups, const Arguments& arguments,
                           const Control& control) {
  const double width_px = size_px_of(arguments, histogram_px);
  std::vector<Distributions> all;
  for (const PictureGroup& group : groups) all.push_back(pooled(group, control));
  constexpr std::size_t most_filled = 3;
  std::vector<Drawing> charts;
  std::vector<Series> legend;
  for (const Quantity& quantity : quantities) {
    Chart chart;
    chart.width_px = width_px;
    chart.height_px = histogram_shape * width_px;
    chart.legend = false;
    chart.x = axis_of(all, quantity);
    const std::size_t together =
        quantity.whole ? 1 : bins_together(chart.x, (all[0].*quantity.histogram).width);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      chart.series.push_back(steps_of(all[g].*quantity.histogram, together, curve_of(groups, g)));
      if (groups.size() > most_filled) chart.series.back().fill = 0;
    }
    chart.y = {0, round_high(chart.series, 1e-6, 1e6), quantity.whole ? "share" : "density"};
    legend = chart.series;
    charts.push_back(draw(std::move(chart)));
  }
  Drawing sheet = with_legend(grid_of(std::move(charts), columns, panel_gap_px), legend);
  sheet.title = "distributions of beta_i, valences, angles, edges, nearest distances and cell areas";
  return with_margin(with_caption(std::move(sheet), groups.size() == 1 ? groups[0].label : ""), 16);
}

}  // namespace

Picture pair_correlation_picture() {
  Picture picture;
  picture.name = "pair-correlation";
  picture.title = "Pair correlation";
  picture.description = "g(r), averaged over the sets of a group; one curve a group.";
  picture.parameters = pair_correlation_parameters();
  picture.parameters.push_back(size_parameter(correlation_px, least_chart_px));
  picture.make = make_pair_correlation;
  picture.cost = [](const SetsSize& size, const Arguments& arguments) {
    const PairCorrelationOptions options = pair_correlation_options(arguments);
    Cost cost = pair_correlation_cost(size, options);
    cost.seconds += drawing_seconds(options.bins, size_px_of(arguments, correlation_px));
    return cost;
  };
  picture.sheet = [](std::span<const SetsSize>, const Arguments& arguments) {
    const double width_px = size_px_of(arguments, correlation_px);
    return sheet_of(chart_size(width_px, correlation_shape * width_px), 1, 1);
  };
  picture.needs_torus = true;
  return picture;
}

Picture distributions_picture() {
  Picture picture;
  picture.name = "distributions";
  picture.title = "Distributions";
  picture.description =
      "Histograms of local ratios, valences, angles, edges, nearest distances and cell areas; one curve a "
      "group.";
  picture.parameters = {size_parameter(histogram_px, least_chart_px)};
  picture.make = make_distributions;
  picture.cost = [](const SetsSize& size, const Arguments&) {
    return Cost{3e-6 * size.n * size.sets, 500 * size.n};
  };
  picture.sheet = [](std::span<const SetsSize>, const Arguments& arguments) {
    const double width_px = size_px_of(arguments, histogram_px);
    return sheet_of(chart_size(width_px, histogram_shape * width_px), std::size(quantities), columns);
  };
  return picture;
}

}  // namespace wellspaced

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/analyze/spectrum.h"
#include "core/math.h"
#include "core/registry_measures.h"
#include "core/render/chart.h"
#include "core/render/pictures/rows.h"
#include "core/render/raster.h"

namespace wellspaced {
namespace {

constexpr double power_shape = 0.48, anisotropy_shape = 0.3;  // height over width
constexpr double image_range = 2.5, curve_range = 3, image_px = 420, curves_px = 440, overview_px = 340;
/// What the oscillations need; not worth it for the largest sets.
constexpr double full_range = 6.5, most_in_full = 3000;

Parameter shown_range(double fallback) {
  return range_parameter("largest frequency that is shown, in units of sqrt(n / A)", 0.5, 20, fallback);
}

std::string sets_text(std::size_t sets) { return std::to_string(sets) + (sets == 1 ? " set" : " sets"); }

// ---- the image

/// The whole square of frequencies, ky upwards.
Raster raster_of(const Periodogram& p) {
  const auto side = static_cast<std::size_t>(2 * p.k_max + 1);
  Raster raster{side, side, {}};
  raster.values.reserve(side * side);
  for (int ky = p.k_max; ky >= -p.k_max; --ky)
    for (int kx = -p.k_max; kx <= p.k_max; ++kx) raster.values.push_back(p.at(kx, ky));
  return raster;
}

/// The frequencies up to `range`, on as many pixels as there are or as the panel has.
Raster shown(const Periodogram& p, double range, double size_px) {
  const Raster all = raster_of(p);
  const double middle = p.k_max + 0.5, unit = std::sqrt(p.n / (p.width * p.height));
  const auto reach = [&](double side) { return std::min(middle, range * unit * side); };
  const double x = reach(p.width), y = reach(p.height);
  const auto pixels = [&](double half) {
    return static_cast<std::size_t>(std::clamp(std::round(2 * half), 1.0, std::round(size_px)));
  };
  return resampled(all, middle - x, middle + x, middle - y, middle + y, pixels(x), pixels(y));
}

Drawing periodogram_panel(const PictureGroup& group, double range, double size_px, const Control& control) {
  const Periodogram mean = mean_periodogram(group.sets, range, control);
  const Raster raster = shown(mean, range, size_px);
  const bool square = raster.columns == raster.rows;
  Chart chart;
  chart.width_px = chart.height_px =
      square ? image_side_px(size_px, static_cast<double>(raster.columns)) : size_px;
  chart.x = {-range, range, "k_x / √(n/A)"};
  chart.y = {-range, range, "k_y / √(n/A)"};
  chart.image = colored(raster, map_gray, 0, 3);
  Drawing drawing = draw(std::move(chart));
  drawing.title = "periodogram of " + std::to_string(group.sets.front().size()) + " points, " +
                  sets_text(group.sets.size());
  return with_caption(std::move(drawing), group.label);
}

Drawing make_periodogram(std::span<const PictureGroup> groups, const Arguments& arguments,
                         const Control& control) {
  const double range = range_of(arguments, image_range), size_px = size_px_of(arguments, image_px);
  std::vector<Drawing> panels;
  for (const PictureGroup& group : groups)
    panels.push_back(periodogram_panel(group, range, size_px, control));
  Drawing bar =
      color_bar(map_gray, {0, 3, "power (white noise: 1)", {{0, "0"}, {1, "1"}, {2, "2"}, {3, "≥ 3"}}}, 220);
  return with_margin(
      stack_of({grid_of(std::move(panels), columns_of(groups.size()), panel_gap_px), std::move(bar)}, 8), 16);
}

/// The largest frame of all groups.
double periodogram_side_px(std::span<const SetsSize> groups, double range, double size_px) {
  double side_px = 0;
  for (const SetsSize& group : groups) {
    const double frequencies = std::max(1.0, std::round(2 * range * std::sqrt(group.n)));
    side_px = std::max(side_px,
                       group.aspect == 1 ? image_side_px(size_px, std::min(frequencies, size_px)) : size_px);
  }
  return side_px;
}

SheetSize periodogram_sheet(std::span<const SetsSize> groups, const Arguments& arguments) {
  const double side_px =
      periodogram_side_px(groups, range_of(arguments, image_range), size_px_of(arguments, image_px));
  return sheet_of(chart_size(side_px, side_px), groups.size(), columns_of(groups.size()));
}

// ---- the curves

/// So far that the oscillations can be told, where that is not too far.
double computed_range(double n, double aspect, double range) {
  return k_max_of(n, aspect, full_range) <= most_in_full ? std::max(range, full_range) : range;
}

struct Curves {
  Spectrum spectrum;
  Series power, anisotropy;
};

Curves curves_of(const PictureGroup& group, double range, const Control& control) {
  const PointSet& first = group.sets.front();
  const Vec3 sides = first.domain->box().size;
  const double aspect = std::max(sides.x / sides.y, sides.y / sides.x);
  const double computed = computed_range(static_cast<double>(first.size()), aspect, range);
  Curves curves{
      spectrum(mean_periodogram(group.sets, computed, control), static_cast<int>(group.sets.size())), {}, {}};
  const Spectrum& s = curves.spectrum;
  for (std::size_t r = 1; r < s.power.size(); ++r) {
    const double frequency = static_cast<double>(r) / std::sqrt(s.n);
    if (frequency > range * 1.02) break;
    curves.power.x.push_back(frequency);
    curves.power.y.push_back(s.power[r]);
    curves.anisotropy.x.push_back(frequency);
    curves.anisotropy.y.push_back(s.anisotropy_db[r]);
  }
  return curves;
}

double peak_of(const Spectrum& s) {
  double peak = 0;
  for (const double power : s.power)
    if (std::isfinite(power)) peak = std::max(peak, power);
  return peak;
}

/// The end of the axis that shows all anisotropies.
double highest_db(const std::vector<Curves>& all) {
  double high = 10;
  for (const Curves& curves : all)
    for (const double db : curves.anisotropy.y)
      if (std::isfinite(db)) high = std::max(high, 10 * std::ceil(db / 10));
  return high;
}

/// The beginning of the axis that shows all anisotropies but those of the few frequencies in small rings.
double lowest_db(const std::vector<Curves>& all) {
  double low = 0;
  for (const Curves& curves : all) {
    std::vector<double> sorted;
    for (const double db : curves.anisotropy.y)
      if (std::isfinite(db)) sorted.push_back(db);
    std::sort(sorted.begin(), sorted.end());
    if (!sorted.empty()) low = std::min(low, sorted[sorted.size() / 20]);
    low = std::min(low, 0.0 - 10 * portable_log10(curves.spectrum.sets));
  }
  return 5 * std::floor(low / 5) - 5;
}

double expected_db(const PictureGroup& group) {
  return 0.0 - 10 * portable_log10(static_cast<double>(group.sets.size()));
}

/// Of axes that all panels share.
struct Limits {
  double range, power, db_low, db_high;
};

Drawing spectrum_panel(const PictureGroup& group, Curves curves, const Limits& limits, double width_px) {
  const Spectrum& s = curves.spectrum;
  const double peak = peak_of(s);
  Chart power;
  power.width_px = width_px;
  power.height_px = power_shape * width_px;
  power.x = {0, limits.range, "frequency / √(n/A)"};
  power.y = {0, limits.power, "radial mean power"};
  power.series = {std::move(curves.power)};
  power.references = {{std::nullopt, 1, "white noise"}};
  const std::optional<double> nyquist = effective_nyquist(s);
  if (nyquist) power.references.push_back({*nyquist, std::nullopt, "ν_{eff}"});
  Chart anisotropy;
  anisotropy.width_px = width_px;
  anisotropy.height_px = anisotropy_shape * width_px;
  anisotropy.x = power.x;
  const double expected = expected_db(group);
  const double lowest = limits.db_low;
  anisotropy.y = {lowest, limits.db_high, "anisotropy, dB", {}};
  const double step = limits.db_high - lowest > 25 ? 10 : 5;
  for (double db = step * std::ceil(lowest / step); db <= limits.db_high; db += step)
    anisotropy.y.ticks.push_back({db, number_label(db, 3)});
  anisotropy.series = {std::move(curves.anisotropy)};
  anisotropy.series[0].color = color_of_class(1);
  anisotropy.references = {{std::nullopt, expected, ""}};  // -10 log10 K
  std::vector<std::string> facts = {std::to_string(group.sets.front().size()) + " points",
                                    "K = " + sets_text(group.sets.size())};
  if (nyquist) facts.push_back("ν_{eff} = " + number_label(*nyquist, 3));
  if (const auto omega = oscillations(s)) facts.push_back("Ω = " + number_label(*omega, 3));
  facts.push_back("peak = " + number_label(peak, 3));
  Drawing numbers = text_rows(std::move(facts), width_px + 60, 13);
  Drawing panel = stack_of({draw(std::move(power)), draw(std::move(anisotropy)), std::move(numbers)}, 6);
  panel.title =
      "radial mean power and anisotropy of " + std::to_string(group.sets.front().size()) + " points";
  return with_caption(std::move(panel), group.label);
}

/// Of such a panel.
SheetSize curves_size(double width_px) {
  constexpr double numbers_px = 36;
  const SheetSize power = chart_size(width_px, power_shape * width_px),
                  anisotropy = chart_size(width_px, anisotropy_shape * width_px);
  return {power.width_px, power.height_px + anisotropy.height_px + numbers_px};
}

SheetSize spectrum_sheet(std::span<const SetsSize> groups, const Arguments& arguments) {
  return sheet_of(curves_size(size_px_of(arguments, curves_px)), groups.size(), columns_of(groups.size()));
}

/// The curves of all groups, on axes that all of them fit on, each drawn by panel(group, curves, limits).
template <class Panel>
Drawing drawn_alike(std::span<const PictureGroup> groups, double range, const Control& control,
                    const Panel& panel) {
  std::vector<Curves> curves;
  std::vector<Series> powers;
  for (const PictureGroup& group : groups) {
    curves.push_back(curves_of(group, range, control));
    powers.push_back(curves.back().power);
  }
  const Limits limits{range, round_high(powers, 1.9, 8), lowest_db(curves), highest_db(curves)};
  std::vector<Drawing> panels;
  for (std::size_t g = 0; g < groups.size(); ++g)
    panels.push_back(panel(groups[g], std::move(curves[g]), limits));
  return with_margin(grid_of(std::move(panels), columns_of(groups.size()), panel_gap_px), 16);
}

Drawing make_spectrum(std::span<const PictureGroup> groups, const Arguments& arguments,
                      const Control& control) {
  const double width_px = size_px_of(arguments, curves_px);
  return drawn_alike(groups, range_of(arguments, curve_range), control,
                     [&](const PictureGroup& group, Curves curves, const Limits& limits) {
                       return spectrum_panel(group, std::move(curves), limits, width_px);
                     });
}

// ---- everything at once

constexpr double narrower_px = 90;  // the curves' frames than what is above them

/// Points and periodogram side by side, the curves below: one row of both for each group.
Drawing overview_panel(const PictureGroup& group, Curves curves, const Limits& limits, double size_px,
                       const Control& control) {
  Drawing image = periodogram_panel({"", group.sets, {}}, image_range, size_px, control);
  Drawing points =
      with_margin(plain_points(group.sets.front(), image.width_px - beside_frame_px, control), 12);
  Drawing above = grid_of({std::move(points), std::move(image)}, 2, 4);
  Drawing below =
      spectrum_panel({"", group.sets, {}}, std::move(curves), limits, above.width_px - narrower_px);
  return with_caption(stack_of({std::move(above), std::move(below)}, 4), group.label);
}

Drawing make_overview(std::span<const PictureGroup> groups, const Arguments& arguments,
                      const Control& control) {
  const double size_px = size_px_of(arguments, overview_px);
  return drawn_alike(groups, curve_range, control,
                     [&](const PictureGroup& group, Curves curves, const Limits& limits) {
                       return overview_panel(group, std::move(curves), limits, size_px, control);
                     });
}

SheetSize overview_sheet(std::span<const SetsSize> groups, const Arguments& arguments) {
  const double side_px = periodogram_side_px(groups, image_range, size_px_of(arguments, overview_px));
  const SheetSize image = chart_size(side_px, side_px), below = curves_size(2 * image.width_px - narrower_px);
  return sheet_of({std::max(2 * image.width_px, below.width_px), image.height_px + below.height_px},
                  groups.size(), columns_of(groups.size()));
}

}  // namespace

Picture overview_picture() {
  Picture picture;
  picture.name = "overview";
  picture.needs_torus = true;
  picture.title = "Overview";
  picture.description =
      "The points of a group's first set, the periodogram as an image, and radial mean power and anisotropy "
      "below, the "
      "latter averaged over the group's sets.";
  picture.parameters = {size_parameter(overview_px, least_chart_px)};
  picture.make = make_overview;
  picture.cost = [](const SetsSize& size, const Arguments&) {
    const Cost curves = periodogram_cost(size, computed_range(size.n, size.aspect, curve_range)),
               image = periodogram_cost(size, image_range);
    return Cost{curves.seconds + image.seconds + 3e-5 * size.n, 2 * std::max(curves.bytes, image.bytes)};
  };
  picture.sheet = overview_sheet;
  picture.draws_each_point = true;
  picture.needs_torus = true;
  return picture;
}

Picture periodogram_picture() {
  Picture picture;
  picture.name = "periodogram";
  picture.title = "Periodogram";
  picture.description = "The power at each frequency as an image, averaged over the sets of a group.";
  picture.parameters = {shown_range(image_range), size_parameter(image_px, least_chart_px)};
  picture.make = make_periodogram;
  picture.cost = [](const SetsSize& size, const Arguments& arguments) {
    const Cost cost = periodogram_cost(size, range_of(arguments, image_range));
    return Cost{cost.seconds, 2 * cost.bytes};  // and the image
  };
  picture.sheet = periodogram_sheet;
  picture.needs_torus = true;
  return picture;
}

Picture spectrum_picture() {
  Picture picture;
  picture.name = "spectrum";
  picture.title = "Radial mean power and anisotropy";
  picture.description = "Both curves of the periodogram, averaged over the sets of a group.";
  picture.parameters = {shown_range(curve_range), size_parameter(curves_px, least_chart_px)};
  picture.make = make_spectrum;
  picture.cost = [](const SetsSize& size, const Arguments& arguments) {
    return periodogram_cost(size, computed_range(size.n, size.aspect, range_of(arguments, curve_range)));
  };
  picture.sheet = spectrum_sheet;
  picture.needs_torus = true;
  return picture;
}

}  // namespace wellspaced

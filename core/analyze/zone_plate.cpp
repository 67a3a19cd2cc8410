#include "core/analyze/zone_plate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/domain/point_tree.h"
#include "core/error.h"
#include "core/math.h"
#include "core/parallel.h"

namespace wellspaced {
namespace {

constexpr double cut = 3;  // standard deviations at which the filter ends

double mean_spacing(const Domain& domain, std::size_t n) {
  return std::sqrt(domain.area() / static_cast<double>(n));
}

/// The pixels, and where they are.
struct Raster {
  std::size_t columns, rows;
  double width, height;

  Vec2 center(std::size_t column, std::size_t row) const {
    return {(static_cast<double>(column) + 0.5) * width / static_cast<double>(columns),
            (static_cast<double>(row) + 0.5) * height / static_cast<double>(rows)};
  }
  double from_border(Vec2 p) const { return std::min({p.x, width - p.x, p.y, height - p.y}); }
};

/// Errors: invalid_parameters at /columns.
Raster raster(const Domain& domain, std::size_t n, const std::optional<int>& wanted) {
  const Vec3 sides = domain.box().size;
  const auto most = static_cast<double>(ZonePlateOptions::largest_pixels);
  double columns = 0;
  if (wanted) {
    columns = *wanted;
  } else {
    const double allowed =
        std::min<double>(ZonePlateOptions::most_columns, std::floor(std::sqrt(most * sides.x / sides.y)) - 1);
    columns = std::clamp(std::floor(sides.x / mean_spacing(domain, n) + 0.5), 1.0, std::max(1.0, allowed));
  }
  const double rows = std::max(1.0, std::floor(columns * sides.y / sides.x + 0.5));
  if (columns * rows > most)
    throw Error(ErrorCode::invalid_parameters,
                "that many pixels across make more than 2^24 of them; ask for fewer", "/columns");
  return {static_cast<std::size_t>(columns), static_cast<std::size_t>(rows), sides.x, sides.y};
}

void require_ranges(const ZonePlateOptions& options) {
  const auto refuse = [](const char* message, const char* where) {
    throw Error(ErrorCode::invalid_parameters, message, where);
  };
  if (options.columns && (*options.columns < 1 || *options.columns > ZonePlateOptions::most_columns))
    refuse("the image must be 1 to 4096 pixels wide", "/columns");
  if (!(options.frequency >= 0 && options.frequency <= 16))
    refuse("the frequency must be a number from 0 to 16", "/frequency");
  if (!(options.sigma >= 0.01 && options.sigma <= 8))
    refuse("sigma must be a number from .01 to 8", "/sigma");
}

struct RowErrors {
  double inner_squares = 0, inner_pixels = 0, border_squares = 0, border_pixels = 0;

  void add(double error, bool at_border) {
    (at_border ? border_squares : inner_squares) += error * error;
    ++(at_border ? border_pixels : inner_pixels);
  }
};

double root_mean_square(const std::vector<RowErrors>& rows) {
  RowErrors sum;
  for (const RowErrors& row : rows)
    sum = {sum.inner_squares + row.inner_squares, sum.inner_pixels + row.inner_pixels,
           sum.border_squares + row.border_squares, sum.border_pixels + row.border_pixels};
  return std::sqrt(sum.inner_pixels > 0 ? sum.inner_squares / sum.inner_pixels
                                        : sum.border_squares / sum.border_pixels);
}

class Renderer {
 public:
  Renderer(const PointSet& points, const ZonePlateField& field, double sigma, const Control& control)
      : tree_(points, control), control_(control), sigma_(sigma), values_(tree_.size()) {
    parallel_blocks(values_.size(), 4096, control, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) values_[k] = field.at(tree_.at(k));
    });
  }

  double pixel(Vec2 center) const {
    const double reach = cut * sigma_, by_variance = -1 / (2 * sigma_ * sigma_);
    const Vec2 sides{reach, reach};
    double sum = 0, weights = 0;
    std::size_t visited = 0;
    tree_.visit({center - sides, center + sides}, [&](std::size_t k) {
      if (++visited % 65536 == 0) control_.check();
      const double d2 = norm2(tree_.at(k) - center);
      if (d2 > reach * reach) return;
      const double weight = portable_exp(d2 * by_variance);
      sum += weight * values_[k];
      weights += weight;
    });
    return weights > 0 ? sum / weights : values_[tree_.nearest(center)];
  }

 private:
  const PointTree tree_;
  const Control& control_;
  const double sigma_;
  std::vector<double> values_;  ///< of the field, at the tree's places
};

}  // namespace

double ZonePlateField::at(Vec2 p) const {
  return (1 + portable_cos_sin(k * (norm2(p) / (width * width)) / 2).cos) / 2;
}

double ZonePlateField::blurred(Vec2 p, double sigma) const {
  const double a = pi * k, s = sigma / width, c = 2 * a * s * s, damping = 1 + c * c;
  const double rho2 = norm2(p) / (width * width);
  const auto [cos, sin] = portable_cos_sin(k * rho2 / damping / 2);
  return (1 + portable_exp(-a * c * rho2 / damping) * (cos - c * sin) / damping) / 2;
}

ZonePlateField zone_plate_field(const Domain& domain, std::size_t n, double frequency) {
  const double width = domain.box().size.x;
  return {width, frequency * width / mean_spacing(domain, n)};
}

void require_options(const ZonePlateOptions& options, const Domain& domain, std::size_t n) {
  require_ranges(options);
  raster(domain, std::max<std::size_t>(n, 1), options.columns);
}

ZonePlate zone_plate(const PointSet& points, const ZonePlateOptions& options, const Control& control) {
  require_ranges(options);
  if (points.size() == 0) throw Error(ErrorCode::degenerate_input, "no points show nothing of a zone plate");
  const Domain& domain = *points.domain;
  const Raster image = raster(domain, points.size(), options.columns);
  const ZonePlateField field = zone_plate_field(domain, points.size(), options.frequency);
  const double sigma = options.sigma * mean_spacing(domain, points.size());
  const double inner = cut * sigma * (1 - 1e-9);  // from a border
  const Renderer renderer(points, field, sigma, control);

  std::vector<RowErrors> errors(image.rows);
  ZonePlate result{image.columns, image.rows, std::vector<double>(image.columns * image.rows), 0};
  parallel_blocks(image.rows, 1, control, [&](std::size_t row, std::size_t) {
    for (std::size_t column = 0; column < image.columns; ++column) {
      if (column % 64 == 63) control.check();
      const Vec2 center = image.center(column, row);
      const double value = renderer.pixel(center);
      result.pixels[row * image.columns + column] = value;
      errors[row].add(value - field.blurred(center, sigma), image.from_border(center) < inner);
    }
  });
  result.rmse = root_mean_square(errors);
  return result;
}

}  // namespace wellspaced

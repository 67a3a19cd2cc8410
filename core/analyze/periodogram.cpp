#include "core/analyze/periodogram.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/analyze/periodogram_fft.h"
#include "core/analyze/periodogram_kernel.h"
#include "core/error.h"
#include "core/parallel.h"

namespace wellspaced {
namespace {

constexpr std::size_t reach = SpreadingKernel::reach;
constexpr std::size_t width = FourierTransform::side_by_side, stride = FourierTransform::stride;
constexpr std::size_t band =
    stride;  // rows that are spread and transformed together, two reals as one complex
static_assert(band >= reach);

/// Places of the grid along a side: a multiple of `band`, at least two bands, at least twice the number of
/// frequencies.
std::size_t grid_size(int k_max) {
  const std::size_t wanted = 2 * (2 * static_cast<std::size_t>(k_max) + 1);
  std::size_t bands = std::max<std::size_t>(2, (wanted + band - 1) / band);
  while (!FourierTransform::takes(bands)) ++bands;
  return bands * band;
}

/// Columns are transformed in groups.
std::size_t column_groups(int k_max) { return static_cast<std::size_t>(k_max) / width + 1; }

using Doubles = std::unique_ptr<double[]>;

Doubles doubles(std::size_t count) { return std::make_unique_for_overwrite<double[]>(count); }

/// Where a point reaches along one axis: the places first, first + 1, ..; `t` as SpreadingKernel takes it.
struct Footprint {
  std::size_t first;
  double t;
};

Footprint footprint(double place, std::size_t size) {
  const double first = std::ceil(place - reach / 2.0);
  const double t = first - (place - reach / 2.0);
  const auto wrapped = static_cast<std::ptrdiff_t>(first) + static_cast<std::ptrdiff_t>(size);
  return {static_cast<std::size_t>(wrapped) % size, t};
}

/// The points in units of the grid, band by band of the first row that they reach.
struct Binned {
  std::vector<Vec2> places;
  std::vector<std::size_t> begin;  ///< of each band, and the end
};

Binned bin(const PointSet& points, std::size_t size) {
  const Box box = points.domain->box();
  const auto side = static_cast<double>(size);
  const auto place = [&](std::size_t i) {
    return Vec2{points[i].x / box.size.x * side, points[i].y / box.size.y * side};
  };
  const auto band_of = [&](std::size_t i) { return footprint(place(i).y, size).first / band; };
  Binned binned{std::vector<Vec2>(points.size()), std::vector<std::size_t>(size / band + 1)};
  for (std::size_t i = 0; i < points.size(); ++i) ++binned.begin[band_of(i) + 1];
  for (std::size_t b = 1; b < binned.begin.size(); ++b) binned.begin[b] += binned.begin[b - 1];
  std::vector<std::size_t> next = binned.begin;
  for (std::size_t i = 0; i < points.size(); ++i) binned.places[next[band_of(i)]++] = place(i);
  return binned;
}

/// The work in two passes, between which only the frequencies along x that are wanted are kept.
class Work {
 public:
  Work(const PointSet& points, int k_max)
      : k_max_(static_cast<std::size_t>(k_max)),
        size_(grid_size(k_max)),
        transform_(size_),
        binned_(bin(points, size_)),
        columns_(doubles(column_groups(k_max) * size_ * stride)) {}

  /// Spreads the points over each band of rows and transforms it along x.
  void rows(const Control& control) {
    parallel_blocks(size_ / band, 1, control, [&](std::size_t b, std::size_t) {
      const std::size_t length = (size_ + reach) * band;
      const Doubles rows = doubles(length), scratch = doubles(size_ * stride);
      std::fill(rows.get(), rows.get() + length, 0.0);
      spread(b == 0 ? size_ / band - 1 : b - 1, b, rows.get());
      spread(b, b, rows.get());
      for (std::size_t i = 0; i < reach * band; ++i) rows[i] += rows[size_ * band + i];
      keep(transform_.run(rows.get(), scratch.get()), b);
    });
  }

  /// Transforms along y, and takes the squares.
  void columns(Periodogram& result, const Control& control) {
    const std::vector<double> scale = scales();
    parallel_blocks(column_groups(result.k_max), 1, control, [&](std::size_t group, std::size_t) {
      const Doubles scratch = doubles(size_ * stride);
      const double* found = transform_.run(columns_.get() + group * size_ * stride, scratch.get());
      for (std::size_t kx = group * width; kx < std::min((group + 1) * width, k_max_ + 1); ++kx) {
        double* power = result.power.data() + kx * (2 * k_max_ + 1);
        for (std::size_t y = 0; y <= 2 * k_max_; ++y) {
          const std::size_t ky = y < k_max_ ? k_max_ - y : y - k_max_;
          const double* f = found + (y < k_max_ ? size_ - ky : ky) * stride + kx % width;
          power[y] = (f[0] * f[0] + f[width] * f[width]) * scale[kx] * scale[ky] / result.n;
        }
      }
    });
    result.power[k_max_] = 0;
  }

 private:
  /// Adds the points whose rows begin in band `from` to the rows of band `to`, which lie side by side.
  void spread(std::size_t from, std::size_t to, double* rows) const {
    for (std::size_t i = binned_.begin[from]; i < binned_.begin[from + 1]; ++i) {
      const Footprint x = footprint(binned_.places[i].x, size_), y = footprint(binned_.places[i].y, size_);
      const SpreadingKernel::Values along_x = kernel_.at(x.t), along_y = kernel_.at(y.t);
      const std::size_t row = y.first % band;  // in its own band
      const std::size_t begin = from == to ? 0 : band - row,
                        end = from == to ? std::min(reach, band - row) : reach;
      for (std::size_t j = 0; j < reach; ++j) {
        double* places = rows + (x.first + j) * band + (from == to ? row : 0);
        for (std::size_t k = begin; k < end; ++k) places[k - begin] += along_x[j] * along_y[k];
      }
    }
  }

  /// Of the transform of band b, what is wanted: series l is row l and i times row l + width.
  void keep(const double* found, std::size_t b) {
    for (std::size_t k = 0; k <= k_max_; ++k) {
      const double *here = found + k * stride, *mirrored = found + (k == 0 ? 0 : size_ - k) * stride;
      double* to = columns_.get() + ((k / width) * size_ + b * band) * stride + k % width;
      for (std::size_t l = 0; l < width; ++l) {
        double *first = to + l * stride, *second = to + (l + width) * stride;
        first[0] = (here[l] + mirrored[l]) / 2;
        first[width] = (here[l + width] - mirrored[l + width]) / 2;
        second[0] = (here[l + width] + mirrored[l + width]) / 2;
        second[width] = (mirrored[l] - here[l]) / 2;
      }
    }
    for (std::size_t k = k_max_ + 1; k % width != 0; ++k)  // columns that nobody asked for
      for (std::size_t r = 0; r < band; ++r)
        for (const std::size_t part : {std::size_t{0}, width})
          columns_[((k / width) * size_ + b * band + r) * stride + k % width + part] = 0;
  }

  /// What spreading did to the square of each frequency, to be undone.
  std::vector<double> scales() const {
    std::vector<double> scale(k_max_ + 1);
    for (std::size_t k = 0; k <= k_max_; ++k) {
      const double spread = kernel_.transform(static_cast<double>(k) / static_cast<double>(size_));
      scale[k] = 1 / (spread * spread);
    }
    return scale;
  }

  const std::size_t k_max_, size_;
  const SpreadingKernel kernel_;
  const FourierTransform transform_;
  const Binned binned_;
  const Doubles columns_;  ///< group by group of kx, as the transform wants them
};

}  // namespace

Periodogram periodogram(const PointSet& points, int k_max, const Control& control) {
  if (k_max < 1 || k_max > largest_k_max)
    throw Error(ErrorCode::invalid_parameters,
                "the largest frequency must be between 1 and " + std::to_string(largest_k_max), "/k_max");
  if (points.size() == 0) throw Error(ErrorCode::degenerate_input, "no points have no spectrum");
  const Vec3 sides = points.domain->box().size;
  Work work(points, k_max);
  work.rows(control);
  const auto k = static_cast<std::size_t>(k_max);
  Periodogram result{k_max, static_cast<double>(points.size()), sides.x, sides.y,
                     std::vector<double>((k + 1) * (2 * k + 1))};
  work.columns(result, control);
  return result;
}

std::uint64_t periodogram_bytes(std::size_t n, int k_max, unsigned threads) {
  const std::uint64_t size = grid_size(k_max), k = static_cast<std::uint64_t>(k_max);
  const std::uint64_t columns = 8 * stride * size * column_groups(k_max), power = 8 * (k + 1) * (2 * k + 1);
  const std::uint64_t working = 8 * (2 * size + reach) * stride * threads;
  return 16 * std::uint64_t{n} + 24 * size + columns + power + working;
}

}  // namespace wellspaced

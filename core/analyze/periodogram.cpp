#include "core/analyze/periodogram.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>

#include <fftw3.h>

#include "core/analyze/periodogram_kernel.h"
#include "core/error.h"
#include "core/parallel.h"

namespace wellspaced {
namespace {

constexpr std::size_t reach = SpreadingKernel::reach;
constexpr std::size_t band = 32;  // rows that are spread and transformed together; more than a point reaches
constexpr std::size_t padding =
    16;  // places behind a row: for points that reach over its end, and FFTW's two

/// Places of the grid along a side: a multiple of `band`, at least two bands, at least twice the number of
/// frequencies, without prime factors above 5.
std::size_t grid_size(int k_max) {
  const std::size_t wanted = 2 * (2 * static_cast<std::size_t>(k_max) + 1);
  for (std::size_t bands = std::max<std::size_t>(2, (wanted + band - 1) / band);; ++bands) {
    std::size_t rest = bands;
    for (const std::size_t prime : {2, 3, 5})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return bands * band;
  }
}

using Doubles = std::unique_ptr<double[]>;

Doubles doubles(std::size_t count) { return std::make_unique_for_overwrite<double[]>(count); }

fftw_complex* as_complex(double* values) { return reinterpret_cast<fftw_complex*>(values); }

/// FFTW's transforms of one row, in place. Its planner is not thread-safe. Neither time nor vector units
/// decide on a plan, so that it's the same on every CPU.
class Transform {
 public:
  enum class Kind { of_reals, of_complex };

  Transform(Kind kind, std::size_t size) {
    constexpr unsigned flags = FFTW_ESTIMATE | FFTW_NO_SIMD | FFTW_UNALIGNED;
    const Doubles row = doubles(2 * size + 2);
    const auto n = static_cast<int>(size);
    const std::lock_guard lock(planner());
    plan_ = kind == Kind::of_reals
                ? fftw_plan_dft_r2c_1d(n, row.get(), as_complex(row.get()), flags)
                : fftw_plan_dft_1d(n, as_complex(row.get()), as_complex(row.get()), FFTW_FORWARD, flags);
    if (plan_ == nullptr) throw Error(ErrorCode::internal, "no plan for a Fourier transform");
  }
  ~Transform() {
    const std::lock_guard lock(planner());
    fftw_destroy_plan(plan_);
  }
  Transform(const Transform&) = delete;
  Transform& operator=(const Transform&) = delete;

  void reals(double* row) const { fftw_execute_dft_r2c(plan_, row, as_complex(row)); }
  void complex(double* row) const { fftw_execute_dft(plan_, as_complex(row), as_complex(row)); }

 private:
  static std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
  }

  fftw_plan plan_;
};

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
        binned_(bin(points, size_)),
        columns_(doubles(2 * size_ * (k_max_ + 1))) {}

  /// Spreads the points over each band of rows and transforms it along x.
  void rows(const Control& control) {
    const Transform transform(Transform::Kind::of_reals, size_);
    parallel_blocks(size_ / band, 1, control, [&](std::size_t b, std::size_t) {
      const Doubles rows = doubles(band * stride());
      std::fill(rows.get(), rows.get() + band * stride(), 0.0);
      spread(b == 0 ? size_ / band - 1 : b - 1, b, rows.get());
      spread(b, b, rows.get());
      for (std::size_t r = 0; r < band; ++r) {
        double* row = rows.get() + r * stride();
        for (std::size_t x = 0; x < reach; ++x) row[x] += row[size_ + x];
        transform.reals(row);
      }
      for (std::size_t k = 0; k <= k_max_; ++k)
        for (std::size_t r = 0; r < band; ++r)
          std::copy_n(rows.get() + r * stride() + 2 * k, 2, columns_.get() + 2 * (k * size_ + b * band + r));
    });
  }

  /// Transforms along y, and takes the squares.
  void columns(Periodogram& result, const Control& control) {
    constexpr std::size_t block = 4;
    const Transform transform(Transform::Kind::of_complex, size_);
    const std::vector<double> scale = scales();
    parallel_blocks(k_max_ + 1, block, control, [&](std::size_t begin, std::size_t end) {
      for (std::size_t kx = begin; kx < end; ++kx) {
        double* column = columns_.get() + 2 * kx * size_;
        transform.complex(column);
        double* power = result.power.data() + kx * (2 * k_max_ + 1);
        for (std::size_t y = 0; y <= 2 * k_max_; ++y) {
          const std::size_t ky = y < k_max_ ? size_ + y - k_max_ : y - k_max_;
          const double re = column[2 * ky], im = column[2 * ky + 1];
          power[y] = (re * re + im * im) * scale[kx] * scale[y < k_max_ ? k_max_ - y : y - k_max_] / result.n;
        }
      }
    });
    result.power[k_max_] = 0;
  }

 private:
  std::size_t stride() const { return size_ + padding; }

  /// Adds the points whose rows begin in band `from` to the rows of band `to`.
  void spread(std::size_t from, std::size_t to, double* rows) const {
    for (std::size_t i = binned_.begin[from]; i < binned_.begin[from + 1]; ++i) {
      const Footprint x = footprint(binned_.places[i].x, size_), y = footprint(binned_.places[i].y, size_);
      const SpreadingKernel::Values along_x = kernel_.at(x.t), along_y = kernel_.at(y.t);
      for (std::size_t j = 0; j < reach; ++j) {
        const std::size_t row = (y.first + j >= size_ ? y.first + j - size_ : y.first + j) - to * band;
        if (row >= band) continue;
        double* places = rows + row * stride() + x.first;
        for (std::size_t k = 0; k < reach; ++k) places[k] += along_y[j] * along_x[k];
      }
    }
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
  const Binned binned_;
  const Doubles columns_;  ///< complex, one column a kx
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
  const std::uint64_t columns = 16 * size * (k + 1), power = 8 * (k + 1) * (2 * k + 1);
  const std::uint64_t rows = 8 * band * (size + padding) * threads;
  return 16 * std::uint64_t{n} + columns + std::max(power, rows) + 64 * size;
}

}  // namespace wellspaced

#include "core/analyze/differential.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "core/domain/point_tree.h"
#include "core/error.h"
#include "core/math.h"
#include "core/parallel.h"

namespace wellspaced {
namespace {

constexpr double cut = 6;               // standard deviations at which the kernel ends
constexpr double places_a_sigma = 6.4;  // at least: how fine pairs are counted
constexpr double hexagonal_density = 2 / 1.7320508075688772;

/// Pairs, counted at the places of a fine raster: a pair counts for the four places around it, by how near it
/// is to each (as in "cloud in cell"), in whole numbers, whose sum does not depend on an order. Since d and
/// -d count alike, rows of y >= 0 suffice.
class PairRaster {
 public:
  explicit PairRaster(const DifferentialOptions& options)
      : size_(static_cast<std::size_t>(options.pixels)),
        step_(2 * options.reach / options.pixels),
        fine_(static_cast<std::size_t>(std::ceil(places_a_sigma * step_ / options.sigma))),
        spacing_(step_ / static_cast<double>(fine_)),
        weights_(kernel(options.sigma / spacing_)),
        half_(size_ / 2 * fine_ + weights_.size()),
        counts_((half_ + 1) * row_length()) {}

  /// Differences count up to this, along each axis.
  double reach() const { return static_cast<double>(half_ - 1) * spacing_; }

  /// Thread safety: from many threads. Requires: both parts of d are within the reach.
  void add(Vec2 d) {
    if (d.y < 0) d = {-d.x, -d.y};
    const auto x = static_cast<std::uint64_t>((d.x / spacing_ + static_cast<double>(half_)) * parts),
               y = static_cast<std::uint64_t>(d.y / spacing_ * parts);
    const std::uint64_t right = x % parts, left = parts - right, above = y % parts, below = parts - above;
    std::uint64_t* place = counts_.data() + y / parts * row_length() + x / parts;
    const auto count = [](std::uint64_t& to, std::uint64_t by) {
      std::atomic_ref(to).fetch_add(by, std::memory_order_relaxed);
    };
    count(place[0], left * below);
    count(place[1], right * below);
    count(place[row_length()], left * above);
    count(place[row_length() + 1], right * above);
  }

  /// The sum of kernels around all differences d and -d, at the image's pixels.
  std::vector<double> blurred(const Control& control) const {
    const std::vector<double> rows = blurred_along_x(control);
    std::vector<double> image(size_ * size_);
    const std::size_t middle = size_ / 2;
    parallel_blocks(size_ - middle, 1, control, [&](std::size_t up, std::size_t) {
      for (std::size_t column = 0; column < size_; ++column) {
        const auto row = static_cast<std::ptrdiff_t>(up * fine_);
        double sum = 0;
        for (auto k = static_cast<std::ptrdiff_t>(weights_.size()) - 1; k > 0; --k)  // from small to large
          sum +=
              weights_[static_cast<std::size_t>(k)] * (at(rows, column, row + k) + at(rows, column, row - k));
        sum += weights_[0] * at(rows, column, row);
        image[(middle + up) * size_ + column] = sum;
        image[(middle - up) * size_ + size_ - 1 - column] = sum;
      }
    });
    return image;
  }

 private:
  static constexpr std::uint64_t parts = 256;  // of the way from a place to the next

  std::size_t row_length() const { return 2 * half_ + 1; }

  /// A Gaussian's values at 0, 1, 2.., whose standard deviation is, with that of the counting (1/6 on average
  /// over where a pair may lie between places), `sigma` places. Their sum to both sides is 1.
  static std::vector<double> kernel(double sigma) {
    const double variance = sigma * sigma - 1.0 / 6;
    std::vector<double> weights(static_cast<std::size_t>(std::ceil(cut * sigma)) + 1);
    double sum = 0;
    for (std::size_t k = weights.size(); k-- > 0;) {
      const auto x = static_cast<double>(k);
      weights[k] = portable_exp(-x * x / (2 * variance));
      sum += k == 0 ? weights[k] : 2 * weights[k];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
  }

  /// Of rows that hold y >= 0, a place of any row.
  double at(const std::vector<double>& rows, std::size_t column, std::ptrdiff_t row) const {
    return row >= 0 ? rows[static_cast<std::size_t>(row) * size_ + column]
                    : rows[static_cast<std::size_t>(-row) * size_ + size_ - 1 - column];
  }

  /// The rows of y >= 0, where the image has columns.
  std::vector<double> blurred_along_x(const Control& control) const {
    std::vector<double> rows(half_ * size_);
    const double scale = 1 / (static_cast<double>(parts * parts) * spacing_ * spacing_);
    parallel_blocks(half_, 1, control, [&](std::size_t row, std::size_t) {
      const std::vector<double> line = counts_of(row);
      for (std::size_t column = 0; column < size_; ++column) {
        const double* place = line.data() + weights_.size() + column * fine_;
        double sum = 0;
        for (std::size_t k = weights_.size(); k-- > 1;) sum += weights_[k] * (place[k] + *(place - k));
        rows[row * size_ + column] = (sum + weights_[0] * place[0]) * scale;
      }
    });
    return rows;
  }

  /// Row 0 holds pairs of its own and their mirror images.
  std::vector<double> counts_of(std::size_t row) const {
    const std::uint64_t* counts = counts_.data() + row * row_length();
    std::vector<double> line(counts, counts + row_length());
    if (row == 0)
      for (std::size_t i = 0; i < line.size(); ++i)
        line[i] += static_cast<double>(counts[line.size() - 1 - i]);
    return line;
  }

  const std::size_t size_;  ///< of the image
  const double step_;
  const std::size_t fine_;  ///< places a pixel, along an axis
  const double spacing_;
  const std::vector<double> weights_;
  const std::size_t half_;  ///< places from the middle to each side
  std::vector<std::uint64_t> counts_;
};

/// Finds the pairs. Each is found once, by the sample of the larger radius: the other one lies within its own
/// reach, which is never more than twice the pair's.
class PairFinder {
 public:
  PairFinder(const PointSet& points, std::span<const double> radii, const Control& control)
      : sides_(points.domain->box().size), tree_(points, control), control_(control), radii_(radii.size()) {
    const double largest = *std::max_element(radii.begin(), radii.end());
    double sum = 0;
    for (const double r : radii) sum += (r / largest) * (r / largest);
    // The factor n of n mean(r^2) is in the sum.
    const double r_ref = std::sqrt(sum / (hexagonal_density * points.domain->area()));
    for (std::size_t k = 0; k < radii_.size(); ++k) radii_[k] = radii[tree_.original(k)] / largest / r_ref;
  }

  void count(PairRaster& raster) const {
    parallel_blocks(radii_.size(), 64, control_, [&](std::size_t begin, std::size_t end) {
      std::size_t visited = 0;
      for (std::size_t k = begin; k < end; ++k) count_around(k, raster, visited);
    });
  }

 private:
  void count_around(std::size_t k, PairRaster& raster, std::size_t& visited) const {
    const double reach = raster.reach(), window = reach * radii_[k] * (1 + 1e-9);
    const Vec2 p = tree_.at(k), half{window, window};
    for (double row = std::floor((p.y - window) / sides_.y); row * sides_.y <= p.y + window; ++row)
      for (double column = std::floor((p.x - window) / sides_.x); column * sides_.x <= p.x + window;
           ++column) {
        if (++visited % 4096 == 0) control_.check();
        const Vec2 shift{column * sides_.x, row * sides_.y}, base = p - shift;
        tree_.visit({base - half, base + half}, [&](std::size_t other) {
          if (++visited % 65536 == 0) control_.check();
          if (radii_[other] > radii_[k] || (radii_[other] == radii_[k] && other >= k)) return;
          // The difference first: coordinates of an image would be rounded.
          const Vec2 d = 2 / (radii_[k] + radii_[other]) * ((tree_.at(other) - p) + shift);
          if (std::fabs(d.x) < reach && std::fabs(d.y) < reach) raster.add(d);
        });
      }
  }

  const Vec3 sides_;
  const PointTree tree_;
  const Control& control_;
  std::vector<double> radii_;  ///< at the tree's places, over r_ref
};

void require_radii(std::span<const double> radii, std::size_t n) {
  if (radii.size() != n)
    throw Error(ErrorCode::invalid_parameters,
                "there are " + std::to_string(radii.size()) + " radii for " + std::to_string(n) +
                    " points; each point has one",
                "/radii");
  for (std::size_t i = 0; i < n; ++i)
    if (!(radii[i] > 0) || !std::isfinite(radii[i]))
      throw Error(ErrorCode::invalid_parameters, "a radius must be a finite number above 0",
                  "/radii/" + std::to_string(i));
}

/// Calls use(ring, density) for half of the pixels and the one in the middle, which is ring 0.
template <class Use>
void for_each_pixel(const DifferentialDomain& domain, std::size_t rings, const Use& use) {
  const int middle = domain.size / 2;
  for (int y = 0; y <= middle; ++y)
    for (int x = y == 0 ? 0 : -middle; x <= middle; ++x) {
      const auto ring = static_cast<std::size_t>(std::sqrt(static_cast<double>(x * x + y * y)) + 0.5);
      if (ring < rings) use(ring, domain.at(middle + x, middle + y));
    }
}

void measure_rings(DifferentialDomain& domain) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto rings = static_cast<std::size_t>(domain.size / 2) + 1;
  std::vector<double> members(rings), sums(rings), squares(rings);
  for_each_pixel(domain, rings, [&](std::size_t ring, double density) {
    sums[ring] += density;
    ++members[ring];
  });
  domain.r.resize(rings);
  domain.mean.resize(rings);
  domain.anisotropy_db.resize(rings);
  for (std::size_t k = 0; k < rings; ++k) {
    domain.r[k] = static_cast<double>(k) * 2 * domain.reach / domain.size;
    domain.mean[k] = sums[k] / members[k];
  }
  for_each_pixel(domain, rings, [&](std::size_t ring, double density) {
    squares[ring] += (density - domain.mean[ring]) * (density - domain.mean[ring]);
  });
  for (std::size_t k = 0; k < rings; ++k) {
    const double ratio = squares[k] / (members[k] - 1) / (domain.mean[k] * domain.mean[k]);
    domain.anisotropy_db[k] = ratio > 0 && std::isfinite(ratio) ? 10 * portable_log10(ratio) : unknown;
  }
}

}  // namespace

void require_options(const DifferentialOptions& options) {
  const auto refuse = [](const char* message, const char* where) {
    throw Error(ErrorCode::invalid_parameters, message, where);
  };
  if (!(options.reach >= 1 && options.reach <= 16))
    refuse("the reach must be a number from 1 to 16", "/reach");
  if (options.pixels < 3 || options.pixels > 1025 || options.pixels % 2 == 0)
    refuse("the size must be an odd number of pixels from 3 to 1025", "/pixels");
  if (!(options.sigma >= options.reach / 256 && options.sigma <= options.reach / 4))
    refuse("sigma must be from a 256th to a fourth of the reach", "/sigma");
}

DifferentialDomain differential_domain(const PointSet& points, std::span<const double> radii,
                                       const DifferentialOptions& options, const Control& control) {
  require_options(options);
  require_radii(radii, points.size());
  if (points.size() < 2)
    throw Error(ErrorCode::degenerate_input, "at least 2 points are needed for a difference between them");
  PairRaster raster(options);
  PairFinder(points, radii, control).count(raster);
  const auto n = static_cast<double>(points.size());
  DifferentialDomain result{n,  1, options.pixels, options.reach, options.sigma, raster.blurred(control), {},
                            {}, {}};
  for (double& density : result.density) density /= (n - 1) * hexagonal_density;
  measure_rings(result);
  return result;
}

DifferentialDomain average(std::span<const DifferentialDomain> sets) {
  DifferentialDomain mean = sets.front();
  for (const DifferentialDomain& set : sets.subspan(1)) {
    mean.n += set.n;
    mean.sets += set.sets;
    for (std::size_t i = 0; i < mean.density.size(); ++i) mean.density[i] += set.density[i];
  }
  const auto count = static_cast<double>(sets.size());
  mean.n /= count;
  for (double& density : mean.density) density /= count;
  measure_rings(mean);
  return mean;
}

}  // namespace wellspaced

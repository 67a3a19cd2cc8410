#include "core/analyze/certificate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "core/analyze/domain_certificate.h"
#include "core/domain/torus.h"
#include "core/large_vector.h"
#include "core/parallel.h"
#include "core/sort.h"

namespace wellspaced {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double ulp = 0x1p-52;

// Every computed value here is a few roundings (of relative size ulp / 2) away from the true one. These
// factors are worth sixteen of them, more than any chain of operations below needs.
constexpr double up = 1 + 8 * ulp, down = 1 - 8 * ulp;

/// An image of a difference, and a bound on how far each component is off.
struct Image {
  Vec2 at;
  double error;
};

/// The sides of a torus.
class Periods {
 public:
  explicit Periods(const Domain& domain) : size_{domain.box().size.x, domain.box().size.y} {}

  /// The image of a difference that is nearest to `hint`: any image is one, so the hint needs no trust. The
  /// difference, the multiple of the period and their sum were rounded, each once, the last two only if the
  /// multiple is not 0.
  Image image(Vec2 difference, Vec2 hint) const {
    const double x = shift(difference.x, hint.x, size_.x), y = shift(difference.y, hint.y, size_.y);
    const Vec2 at{difference.x + x, difference.y + y};
    const auto error = [](double d, double s, double sum) {
      return s == 0 ? ulp * std::fabs(d) : ulp * (std::fabs(d) + std::fabs(s) + std::fabs(sum));
    };
    return {at, std::max(error(difference.x, x, at.x), error(difference.y, y, at.y))};
  }

  Vec2 size() const { return size_; }

 private:
  static double shift(double difference, double hint, double period) {
    return std::nearbyint((hint - difference) / period) * period;
  }

  Vec2 size_;
};

/// An image of a neighbor, seen from its star's center.
struct Side {
  Vec2 at;
  double length_upper;
  double error;
};

class CoverageProof {
 public:
  explicit CoverageProof(const PointSet& points)
      : points_(points), periods_(*points.domain), bounds_(points.size(), infinity) {}

  void add(std::size_t i, std::span<const Spoke> spokes) {
    if (spokes.empty()) return;
    double bound = 0;
    Side before = side(i, spokes.back());
    for (const Spoke& spoke : spokes) {
      const Side next = side(i, spoke);
      bound = std::max(bound, circumradius_upper(before, next));
      before = next;
    }
    bounds_[i] = bound;
  }

  /// Infinite if some star is not proven to turn around its center.
  double r_c_upper() const { return *std::max_element(bounds_.begin(), bounds_.end()); }

 private:
  Side side(std::size_t i, const Spoke& spoke) const {
    const Vec3 from = points_[i], to = points_[spoke.id];
    const Image image = periods_.image({to.x - from.x, to.y - from.y}, spoke.offset);
    return {image.at, (norm(image.at) + 2 * image.error) * up, image.error};
  }

  /// Of the triangle of the center, a and b, b to the left of a; infinite if that is not proven.
  static double circumradius_upper(const Side& a, const Side& b) {
    const double error = std::max(a.error, b.error);
    // |cross(a', b') - cross(a, b)| <= |a' - a| |b'| + |a| |b' - b|, and the roundings of the cross product.
    const double doubt =
        2 * error * (a.length_upper + b.length_upper) + 4 * ulp * a.length_upper * b.length_upper;
    const double twice_area = (cross(a.at, b.at) - doubt) * down;
    if (!(twice_area > 0)) return infinity;
    const double across_upper = (norm(b.at - a.at) + 4 * error) * up;
    return a.length_upper * b.length_upper * across_upper / (2 * twice_area) * up;
  }

  const PointSet& points_;
  const Periods periods_;
  LargeVector<double> bounds_;
};

/// Looks at all pairs of points that may be at most `reach` apart: rows at least that high, each sorted along
/// x.
class PairSweep {
 public:
  PairSweep(const PointSet& points, double reach, const Control& control)
      : points_(points), periods_(*points.domain), reach_(reach), control_(control) {
    constexpr double most_rows = 1 << 22, slack = 1e-6;  // the slack outweighs the rounding of a row's number
    const double rows = std::floor(periods_.size().y / (reach * (1 + slack)));
    rows_ = static_cast<std::uint32_t>(
        std::clamp(rows, 1.0, std::min(most_rows, static_cast<double>(points.size()))));
    sort_into_rows();
  }

  /// Proven: no two points are nearer than this.
  double r_f_lower() const {
    constexpr std::size_t block = 256;
    std::vector<double> nearest2((rows_ + block - 1) / block, infinity);
    parallel_blocks(rows_, block, control_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row)
        nearest2[begin / block] = std::min(
            {nearest2[begin / block], nearest2_between(row, row), nearest2_between(row, (row + 1) % rows_)});
    });
    const double found2 = std::max(0.0, *std::min_element(nearest2.begin(), nearest2.end()));
    return std::min(std::sqrt(found2), reach_) * down;
  }

 private:
  void sort_into_rows() {
    const auto n = static_cast<std::uint32_t>(points_.size());
    constexpr std::uint32_t between_checks = 1 << 16;
    LargeVector<std::uint32_t> row(n);
    start_.assign(rows_ + 1, 0);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (i % between_checks == 0) control_.check();
      row[i] = std::min(rows_ - 1, static_cast<std::uint32_t>(points_[i].y * (rows_ / periods_.size().y)));
      ++start_[row[i] + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    sorted_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (i % between_checks == 0) control_.check();
      sorted_[next[row[i]]++] = {points_[i].x, points_[i].y};
    }
    parallel_blocks(rows_, 256, control_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r)
        sort(sorted_.begin() + start_[r], sorted_.begin() + start_[r + 1], control_,
             [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    });
  }

  /// Lower bound of the least squared distance between a point of one row and one of another (or the same)
  /// one, if it is within reach; else anything above that, or infinity.
  double nearest2_between(std::size_t row, std::size_t other) const {
    const std::span<const Vec2> a = points_of(row), b = points_of(other);
    const double width = periods_.size().x, window = reach_ * up + 4 * ulp * width;
    double least = infinity;
    std::size_t first = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      while (first < b.size() && b[first].x < a[k].x - window) ++first;
      std::size_t seen = first;
      for (; seen < b.size() && b[seen].x <= a[k].x + window; ++seen)
        if (&a[k] != &b[seen]) least = std::min(least, distance2(a[k], b[seen]));
      // Around the seam.
      for (std::size_t s = 0; s < first && b[s].x + width <= a[k].x + window; ++s)
        least = std::min(least, distance2(a[k], b[s]));
      for (std::size_t s = b.size(); s-- > seen && b[s].x - width >= a[k].x - window;)
        least = std::min(least, distance2(a[k], b[s]));
    }
    return least;
  }

  std::span<const Vec2> points_of(std::size_t row) const {
    return {sorted_.data() + start_[row], sorted_.data() + start_[row + 1]};
  }

  /// Lower bound of the squared distance.
  double distance2(Vec2 a, Vec2 b) const {
    const Image image = periods_.image(b - a, {});
    return norm2(image.at) * down - 4 * image.error * (std::fabs(image.at.x) + std::fabs(image.at.y));
  }

  const PointSet& points_;
  const Periods periods_;
  const double reach_;
  const Control& control_;
  std::uint32_t rows_ = 1;
  std::vector<std::uint32_t> start_;
  LargeVector<Vec2> sorted_;
};

}  // namespace

std::optional<Certificate> certify(const PointSet& points, const Control& control, const StarSource& source) {
  if (!can_be_certified(points)) return std::nullopt;
  if (!is_torus(*points.domain)) return certify_domain(points, control);
  CoverageProof coverage(points);
  LargeVector<double> nearest(points.size(), infinity);  // only says how far it is worth to look for pairs
  source(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
    coverage.add(i, spokes);
    for (const Spoke& spoke : spokes)
      if (spoke.id != i) nearest[i] = std::min(nearest[i], norm(spoke.offset));
  });
  Certificate c;
  c.r_c_upper = coverage.r_c_upper();
  const double reach = *std::min_element(nearest.begin(), nearest.end()) * (1 + 1e-9);
  if (!std::isfinite(c.r_c_upper) || !std::isfinite(reach)) return std::nullopt;
  c.r_f_lower = PairSweep(points, reach, control).r_f_lower();
  if (!(c.r_f_lower > 0)) return std::nullopt;
  c.beta_upper = c.r_c_upper / c.r_f_lower * up;
  return c;
}

}  // namespace wellspaced

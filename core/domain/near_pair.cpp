#include "core/domain/near_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "core/domain/torus.h"
#include "core/large_vector.h"
#include "core/sort.h"
#include "core/voronoi/grid_order.h"

namespace wellspaced {
namespace {

constexpr std::size_t between_checks = 1 << 14;

/// Rows of the height that is looked for, each sorted along x.
///
/// A cube of that side holds at most eight samples of which no two are near: cut in eight, two of nine would
/// share a part, whose diagonal is shorter. So it is enough to compare each sample with the next eight of its
/// row, and with twice as many around it in rows beside; where there are more, others of them are near.
class PairSearch {
 public:
  PairSearch(const PointSet& points, double limit, const Control& control)
      : points_(points), limit_(limit), control_(control), box_(points.domain->box()) {
    const double size[2] = {box_.size.y, box_.size.z};
    for (std::size_t a = 0; a < 2; ++a) rows_[a] = std::max(1.0, std::floor(size[a] / (limit * (1 + 1e-6))));
    places_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 p = points[i];
      places_.push_back({row(p.y - box_.low.y, box_.size.y, rows_[0]),
                         row(p.z - box_.low.z, box_.size.z, rows_[1]), p.x, static_cast<std::uint32_t>(i)});
    }
    sort(places_.begin(), places_.end(), control,
         [](const Place& a, const Place& b) { return a.key() < b.key(); });
  }

  std::optional<NearPair> find() {
    for (std::size_t k = 0; k < places_.size(); ++k) {
      if (k % between_checks == 0) control_.check();
      const Place& p = places_[k];
      for (std::size_t next = k + 1; next < places_.size() && next <= k + most_in_row; ++next) {
        if (!same_row(places_[next], p) || places_[next].x > p.x + reach()) break;
        compare(p, places_[next]);
      }
      look_around_seam(p, p.y, p.z);
      // Half of the rows beside: the other half looks here.
      look(p, p.y + 1, p.z);
      if (rows_[1] > 1)
        for (const double dy : {-1, 0, 1}) look(p, p.y + dy, p.z + 1);
    }
    return found_;
  }

 private:
  static constexpr std::size_t most_in_row = 8;

  struct Place {
    double y, z;  ///< number of its row
    double x;
    std::uint32_t i;
    std::tuple<double, double, double, std::uint32_t> key() const { return {z, y, x, i}; }
  };

  static bool same_row(const Place& a, const Place& b) { return a.y == b.y && a.z == b.z; }

  static double row(double at, double size, double rows) {
    return size > 0 ? std::clamp(std::floor(at / size * rows), 0.0, rows - 1) : 0;
  }

  /// With room for roundings; what is near is decided by the distance.
  double reach() const { return limit_ * (1 + 1e-6) + 1e-15 * box_.size.x; }

  void look(const Place& p, double y, double z) {
    if (box_.periodic[1]) y = y < 0 ? y + rows_[0] : y >= rows_[0] ? y - rows_[0] : y;
    look(p, y, z, p.x);
    look_around_seam(p, y, z);
  }

  void look_around_seam(const Place& p, double y, double z) {
    if (!box_.periodic[0]) return;
    if (p.x - box_.low.x < reach()) look(p, y, z, p.x + box_.size.x);
    if (box_.low.x + box_.size.x - p.x < reach()) look(p, y, z, p.x - box_.size.x);
  }

  /// The samples of a row around x.
  void look(const Place& p, double y, double z, double x) {
    const Place first{y, z, x - reach(), 0};
    auto at = std::lower_bound(places_.begin(), places_.end(), first,
                               [](const Place& a, const Place& b) { return a.key() < b.key(); });
    for (std::size_t k = 0; k <= 3 * most_in_row && at != places_.end(); ++k, ++at) {
      if (!same_row(*at, first) || at->x > x + reach()) return;
      if (at->i != p.i) compare(p, *at);
    }
  }

  void compare(const Place& a, const Place& b) {
    const double distance = points_.domain->distance(points_[a.i], points_[b.i]);
    const std::uint32_t later = std::max(a.i, b.i), earlier = std::min(a.i, b.i);
    if (distance < limit_ && (!found_ || std::tie(later, earlier) < std::tie(found_->later, found_->earlier)))
      found_ = NearPair{later, earlier, distance};
  }

  const PointSet& points_;
  const double limit_;
  const Control& control_;
  const Box box_;
  std::array<double, 2> rows_;  ///< along y and z
  LargeVector<Place> places_;
  std::optional<NearPair> found_;
};

/// Whether samples of an even set on a torus are near each other: such ones lie in the same cell of a grid,
/// or both at its sides. Nothing is known of sets with crowded cells.
class CellSearch {
 public:
  CellSearch(const PointSet& points, double limit, const Control& control)
      : torus_(*points.domain),
        control_(control),
        order_(grid_order(points, hexagonal_spacing(points.domain->area(), points.size()), control)),
        cell_{order_.width / order_.columns, order_.height / order_.rows},
        limit_(limit),
        at_side_(limit + 1e-12 * std::max(order_.width, order_.height)) {}

  std::optional<bool> any() const {
    constexpr std::uint32_t crowd = 32;
    if (order_.fullest() > crowd || at_side_ > std::min(cell_.x, cell_.y)) return std::nullopt;
    for (std::uint32_t row = 0; row < order_.rows; ++row)
      for (std::uint32_t column = 0; column < order_.columns; ++column) {
        const std::uint32_t cell = row * order_.columns + column;
        if (cell % between_checks == 0) control_.check();
        for (std::uint32_t a = order_.start[cell]; a < order_.start[cell + 1]; ++a)
          if (any_near(a, column, row)) return true;
      }
    return false;
  }

 private:
  bool any_near(std::uint32_t a, std::uint32_t column, std::uint32_t row) const {
    const double x = order_.x[a] - column * cell_.x, y = order_.y[a] - row * cell_.y;
    const std::uint32_t left = x < at_side_, right = cell_.x - x < at_side_, below = y < at_side_,
                        above = cell_.y - y < at_side_;
    for (std::uint32_t r = row + order_.rows - below; r <= row + order_.rows + above; ++r)
      for (std::uint32_t c = column + order_.columns - left; c <= column + order_.columns + right; ++c)
        if (near_one_of(a, r % order_.rows * order_.columns + c % order_.columns)) return true;
    return false;
  }

  bool near_one_of(std::uint32_t a, std::uint32_t cell) const {
    for (std::uint32_t b = order_.start[cell]; b < order_.start[cell + 1]; ++b)
      if (b != a && torus_.distance({order_.x[a], order_.y[a], 0}, {order_.x[b], order_.y[b], 0}) < limit_)
        return true;
    return false;
  }

  const Domain& torus_;
  const Control& control_;
  const GridOrder order_;
  const Vec2 cell_;
  const double limit_, at_side_;
};

}  // namespace

std::optional<NearPair> find_near_pair(const PointSet& points, double limit, const Control& control) {
  if (is_torus(*points.domain) && CellSearch(points, limit, control).any() == false) return std::nullopt;
  return PairSearch(points, limit, control).find();
}

}  // namespace wellspaced

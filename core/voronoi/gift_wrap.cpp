#include "core/voronoi/gift_wrap.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/parallel.h"
#include "core/vec.h"

// This file is compiled once for every kind of vector unit; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/voronoi/gift_wrap.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Words = hn::CappedTag<std::uint32_t, 16>;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t widest = 8;  ///< lanes of doubles, at most

/// The place of v among a star's neighbors, or at least `degree` if it is none of them.
inline int place_of(const Star& star, std::uint32_t v) {
  const Words d;
  const auto wanted = hn::Set(d, v);
  for (std::size_t k = 0; k < 16; k += hn::Lanes(d)) {
    const auto found = hn::FindFirstTrue(d, hn::Eq(hn::Load(d, star.neighbor + k), wanted));
    if (found >= 0) return static_cast<int>(k) + static_cast<int>(found);
  }
  return 16;
}

/// Points around the one whose star is wrapped, as offsets from it.
class Candidates {
 public:
  /// All points of the cells at most `ring` away from that of place i. Returns how far that surely reaches.
  double gather(const GridOrder& order, std::size_t i, int ring) {
    const double qx = order.x[i], qy = order.y[i];
    const auto column = static_cast<int>(order.column_of(qx)), row = static_cast<int>(order.row_of(qy));
    if (column != column_ || row != row_ || ring != ring_) collect(order, column, row, ring);
    look_from({qx, qy});
    self_ = i - before_own_;
    h_[self_] = infinite;  // it may never be met
    const double cell_x = order.width / static_cast<double>(order.columns),
                 cell_y = order.height / static_cast<double>(order.rows);
    const double x = qx - column * cell_x, y = qy - row * cell_y;
    const double inside = std::min({x, cell_x - x, y, cell_y - y});
    return (inside + ring * std::min(cell_x, cell_y)) * (1 - 1e-9);
  }

  /// The nearest one.
  std::size_t nearest() const {
    const Doubles d;
    auto best = hn::Set(d, infinite), at = hn::Set(d, 0.0), index = hn::Iota(d, 0);
    for (std::size_t k = 0; k < size_; k += hn::Lanes(d)) {
      const auto h = hn::LoadU(d, &h_[k]);
      const auto less = hn::Lt(h, best);
      best = hn::IfThenElse(less, h, best);
      at = hn::IfThenElse(less, index, at);
      index = hn::Add(index, hn::Set(d, static_cast<double>(hn::Lanes(d))));
    }
    return least(best, at).place;
  }

  struct Touch {
    double cotangent = infinite;  ///< of the angle at which the third corner sees the edge
    std::size_t place = 0;
  };

  /// The candidate that a circle through the center and u meets first on the left of u. Two at the same time:
  /// the one that was gathered first.
  Touch first_left_of(Vec2 u, double collinear) const {
    const Doubles d;
    const auto ux = hn::Set(d, u.x), uy = hn::Set(d, u.y), least_area = hn::Set(d, collinear);
    const auto never = hn::Set(d, infinite), step = hn::Set(d, static_cast<double>(hn::Lanes(d)));
    auto best = never, at = hn::Set(d, 0.0), index = hn::Iota(d, 0);
    for (std::size_t k = 0; k < size_; k += hn::Lanes(d)) {
      const auto x = hn::LoadU(d, &x_[k]), y = hn::LoadU(d, &y_[k]), h = hn::LoadU(d, &h_[k]);
      const auto area = hn::Sub(hn::Mul(ux, y), hn::Mul(uy, x));
      const auto rest = hn::Sub(h, hn::Add(hn::Mul(ux, x), hn::Mul(uy, y)));
      const auto t = hn::IfThenElse(hn::Gt(area, least_area), hn::Div(rest, area), never);
      const auto less = hn::Lt(t, best);
      best = hn::IfThenElse(less, t, best);
      at = hn::IfThenElse(less, index, at);
      index = hn::Add(index, step);
    }
    return least(best, at);
  }

  std::uint32_t id(std::size_t k) const { return id_[k]; }
  Vec2 offset(std::size_t k) const { return {x_[k], y_[k]}; }

 private:
  /// The points around a cell. Several points of it are looked at one after the other.
  void collect(const GridOrder& order, int column, int row, int ring) {
    column_ = column, row_ = row, ring_ = ring;
    size_ = 0;
    const int columns = static_cast<int>(order.columns), rows = static_cast<int>(order.rows);
    for (int r = row - ring; r <= row + ring; ++r) {
      const double shift_y = r < 0 ? -order.height : r >= rows ? order.height : 0;
      const int line = (r < 0 ? r + rows : r >= rows ? r - rows : r) * columns;
      const int low = column - ring, high = column + ring, first = line + std::max(low, 0);
      if (low < 0) add(order, line + low + columns, line + columns, {-order.width, shift_y});
      if (r == row) before_own_ = order.start[static_cast<std::size_t>(first)] - size_;
      add(order, first, line + std::min(high + 1, columns), {0, shift_y});
      if (high >= columns) add(order, line, line + high + 1 - columns, {order.width, shift_y});
    }
  }

  /// Appends the points of a run of cells.
  void add(const GridOrder& order, int first_cell, int end_cell, Vec2 shift) {
    const std::size_t begin = order.start[static_cast<std::size_t>(first_cell)];
    const std::size_t n = order.start[static_cast<std::size_t>(end_cell)] - begin;
    reserve(size_ + n + widest);
    std::copy_n(&order.x[begin], n, &place_x_[size_]);
    std::copy_n(&order.y[begin], n, &place_y_[size_]);
    std::fill_n(&shift_x_[size_], n, shift.x);
    std::fill_n(&shift_y_[size_], n, shift.y);
    for (std::size_t k = 0; k < n; ++k) id_[size_ + k] = static_cast<std::uint32_t>(begin + k);
    size_ += n;
  }

  /// Offsets and their squares. The padding may never be met.
  void look_from(Vec2 center) {
    const Doubles d;
    const auto cx = hn::Set(d, center.x), cy = hn::Set(d, center.y);
    for (std::size_t k = 0; k < size_; k += hn::Lanes(d)) {
      const auto x = hn::Add(hn::Sub(hn::LoadU(d, &place_x_[k]), cx), hn::LoadU(d, &shift_x_[k]));
      const auto y = hn::Add(hn::Sub(hn::LoadU(d, &place_y_[k]), cy), hn::LoadU(d, &shift_y_[k]));
      hn::StoreU(x, d, &x_[k]);
      hn::StoreU(y, d, &y_[k]);
      hn::StoreU(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), d, &h_[k]);
    }
    for (std::size_t k = size_; k < size_ + widest; ++k) x_[k] = 0, y_[k] = 0, h_[k] = infinite;
  }

  void reserve(std::size_t n) {
    if (n <= x_.size()) return;
    n = (2 * n + widest) / widest * widest;
    for (auto* values : {&place_x_, &place_y_, &shift_x_, &shift_y_, &x_, &y_, &h_}) values->resize(n);
    id_.resize(n);
  }

  /// The least of all lanes; of equals, that which came first.
  template <class V>
  static Touch least(V best, V at) {
    const Doubles d;
    const auto value = hn::MinOfLanes(d, best);
    const auto place = hn::MinOfLanes(d, hn::IfThenElse(hn::Eq(best, value), at, hn::Set(d, infinite)));
    return {hn::GetLane(value), static_cast<std::size_t>(hn::GetLane(place))};
  }

  std::vector<double> place_x_, place_y_, shift_x_, shift_y_;  // around a cell
  std::vector<std::uint32_t> id_;
  int column_ = -1, row_ = -1, ring_ = 0;
  std::size_t before_own_ = 0;     // subtracted from a place of the cell itself, its index here
  std::vector<double> x_, y_, h_;  // seen from one point
  std::size_t size_ = 0, self_ = 0;
};

/// The stars of the places from `begin` on, one after the other.
class Wrapper {
 public:
  Wrapper(const GridOrder& order, std::size_t begin, std::size_t end, Star* stars)
      : order_(order),
        begin_(begin),
        stars_(stars),
        seen_by_(end - begin, nobody),
        collinear_(1e-12 * (order.width / order.columns) * (order.height / order.rows)) {}

  /// False: this way doesn't suit the point set.
  bool wrap(std::size_t i) {
    constexpr int most_rings = 4;
    for (int ring = 1; ring <= most_rings; ++ring) {
      // Beyond, an edge could reach half around the torus.
      if (2 * ring + 2 > static_cast<int>(std::min(order_.columns, order_.rows))) return false;
      const double reach = candidates_.gather(order_, i, ring);
      switch (wrap_within(i, reach)) {
        case Outcome::closed:
          return true;
        case Outcome::open:
          continue;
        case Outcome::crowded:
          return false;
      }
    }
    return false;
  }

 private:
  enum class Outcome { closed, open, crowded };
  static constexpr int most = Star::most;
  static constexpr std::uint32_t nobody = ~0u;

  Outcome wrap_within(std::size_t i, double reach) {
    const std::uint32_t known = seen_by_[i - begin_];
    std::uint32_t ring[2 * most + 1];
    int first = most, last = most;
    ring[most] = known == nobody ? candidates_.id(candidates_.nearest()) : known;
    // Clockwise as far as earlier stars know the way.
    for (int at; (at = place_in_earlier(ring[first], i)) >= 0;) {
      const Star& star = stars_[ring[first]];
      const std::uint32_t next = star.neighbor[star.after(at)];
      if (next == ring[last]) return store(i, ring + first, last - first + 1);
      if (last - first + 1 == most) return Outcome::crowded;
      ring[--first] = next;
    }
    // Counter-clockwise for the rest.
    for (;;) {
      std::uint32_t next;
      if (const int at = place_in_earlier(ring[last], i); at >= 0) {
        const Star& star = stars_[ring[last]];
        next = star.neighbor[star.before(at)];
      } else {
        const Vec2 u = order_.offset(i, ring[last]);
        const auto touch = candidates_.first_left_of(u, collinear_);
        const double diameter2 = (1 + touch.cotangent * touch.cotangent) * norm2(u);
        if (!(diameter2 <= reach * reach)) return Outcome::open;
        next = candidates_.id(touch.place);
      }
      if (next == ring[first]) return store(i, ring + first, last - first + 1);
      if (last - first + 1 == most) return Outcome::crowded;
      ring[++last] = next;
    }
  }

  static std::uint32_t here(std::size_t i) { return static_cast<std::uint32_t>(i); }

  /// Where a star that was wrapped before has i; -1 if nowhere.
  int place_in_earlier(std::uint32_t neighbor, std::size_t i) const {
    if (neighbor < begin_ || neighbor >= i) return -1;
    const int at = place_of(stars_[neighbor], here(i));
    return at < stars_[neighbor].degree ? at : -1;
  }

  Outcome store(std::size_t i, const std::uint32_t* ring, int degree) {
    if (degree < 3) return Outcome::crowded;
    Star& star = stars_[i];
    star.degree = degree;
    for (int k = 0; k < most; ++k) star.neighbor[k] = ring[k < degree ? k : 0];
    for (int k = 0; k < degree; ++k)
      if (ring[k] > i && ring[k] - begin_ < seen_by_.size()) seen_by_[ring[k] - begin_] = here(i);
    return Outcome::closed;
  }

  const GridOrder& order_;
  const std::size_t begin_;
  Star* const stars_;
  std::vector<std::uint32_t> seen_by_;  // of each place, the latest earlier one that has it in its star
  const double collinear_;
  Candidates candidates_;
};

bool wrap_block(const GridOrder& order, std::size_t begin, std::size_t end, Star* stars) {
  Wrapper wrapper(order, begin, end, stars);
  for (std::size_t i = begin; i < end; ++i)
    if (!wrapper.wrap(i)) return false;
  return true;
}

bool mutual_block(const Star* stars, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const Star& star = stars[i];
    for (int k = 0; k < star.degree; ++k) {
      const Star& other = stars[star.neighbor[k]];
      const int back = place_of(other, static_cast<std::uint32_t>(i));
      if (back >= other.degree || other.neighbor[other.before(back)] != star.neighbor[star.after(k)])
        return false;
    }
  }
  return true;
}

}  // namespace
}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wellspaced {

HWY_EXPORT(wrap_block);
HWY_EXPORT(mutual_block);

std::optional<LargeVector<Star>> wrap_stars(const GridOrder& order, const Control& control) {
  constexpr std::size_t block = 8192;
  constexpr std::uint32_t overfull = 64;
  if (order.fullest() > overfull) return std::nullopt;
  LargeVector<Star> stars(order.size());
  std::atomic<bool> suits = true;
  const auto on_every_block = [&](const auto& work) {
    parallel_blocks(order.size(), block, control, [&](std::size_t begin, std::size_t end) {
      if (suits && !work(begin, end)) suits = false;
    });
  };
  on_every_block([&](std::size_t begin, std::size_t end) {
    return HWY_DYNAMIC_DISPATCH(wrap_block)(order, begin, end, stars.data());
  });
  on_every_block([&](std::size_t begin, std::size_t end) {
    return HWY_DYNAMIC_DISPATCH(mutual_block)(stars.data(), begin, end);
  });
  if (!suits) return std::nullopt;
  return stars;
}

}  // namespace wellspaced
#endif  // HWY_ONCE

#include "core/voronoi/candidate_star.h"

#include <algorithm>
#include <bit>
#include <limits>

// This file is compiled once for every kind of vector unit; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/voronoi/candidate_star.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

#include "core/vector_row-inl.h"

#ifndef WELLSPACED_CANDIDATE_STAR
#define WELLSPACED_CANDIDATE_STAR
namespace wellspaced {

enum class StarState { delaunay, not_delaunay, not_a_star };

constexpr double touching = 1e-13;  ///< so little into a circle, in units of its radius, is rounding
constexpr double needle2 = 1e-6;    ///< the least square of a sine whose triangle has an exact enough corner

}  // namespace wellspaced
#endif

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {
namespace {

/// The corners of the cell of the candidate at u, and whether its star is Delaunay.
template <int W>
StarState look(CandidateStar::Table& t, Vec2 u, CandidateStar::Squares& squares) {
  using R = Row<double, W>;
  const R ux = R::all(u.x), uy = R::all(u.y);
  const R ax = R::load(t.spoke_x) - ux, ay = R::load(t.spoke_y) - uy, a2 = ax * ax + ay * ay;
  const R bx = R::load(t.spoke_x + 1) - ux, by = R::load(t.spoke_y + 1) - uy, b2 = bx * bx + by * by;
  const R area = ax * by - ay * bx;
  if (!all_less(R::all(0), area) || !all_less(R::all(needle2) * (a2 * b2), area * area))
    return StarState::not_a_star;
  const R half = R::all(0.5) / area;
  const R cx = half * (by * a2 - ay * b2), cy = half * (ax * b2 - bx * a2);
  const R r2 = cx * cx + cy * cy;
  squares = {a2.smallest(), r2.largest()};

  // q is in the circle around c if 2 q.c > q.q, all seen from u; here seen from where the chart begins.
  const R gx = cx + ux, gy = cy + uy;
  const R most = (ux * cx + uy * cy) + (R::all(0.5 * norm2(u)) + R::all(touching) * r2);
  const auto depth = [&](R qx, R qy, R q_half2) { return (qx * gx + qy * gy) - q_half2; };
  R deepest = depth(R::load(t.spoke_x + 2), R::load(t.spoke_y + 2), R::load(t.spoke_half2 + 2));
  for (int q = 0; q < t.outers; ++q)
    deepest = larger(deepest, depth(R::all(t.outer_x[q]), R::all(t.outer_y[q]), R::all(t.outer_half2[q])));
  if (all_less(deepest, most)) return StarState::delaunay;
  cx.store(t.corner_x);
  cy.store(t.corner_y);
  return StarState::not_delaunay;
}

StarState look_here(CandidateStar::Table& t, Vec2 u, CandidateStar::Squares& squares) {
  return t.degree <= 8 ? look<8>(t, u, squares) : look<16>(t, u, squares);
}

/// Neighbors seen from a candidate, to wrap a star around it.
class Wrapping {
  using D = hn::CappedTag<double, 8>;
  static constexpr std::size_t lanes = hn::MaxLanes(D());
  static constexpr double infinite = std::numeric_limits<double>::infinity();

 public:
  HWY_ATTR Wrapping(const CandidateStar::Table& t, Vec2 u) : size_(static_cast<std::size_t>(t.size)) {
    const D d;
    for (std::size_t k = 0; k < size_; k += lanes) {
      const auto x = hn::Sub(hn::Load(d, t.x + k), hn::Set(d, u.x));
      const auto y = hn::Sub(hn::Load(d, t.y + k), hn::Set(d, u.y));
      hn::Store(x, d, x_ + k);
      hn::Store(y, d, y_ + k);
      hn::Store(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), d, h_ + k);
    }
    for (std::size_t k = size_; k < size_ + lanes; ++k) x_[k] = y_[k] = 0, h_[k] = infinite;
  }

  HWY_ATTR int nearest() const {
    const D d;
    auto best = hn::Set(d, infinite), at = hn::Set(d, 0.0), index = hn::Iota(d, 0);
    for (std::size_t k = 0; k < size_; k += lanes) {
      const auto h = hn::Load(d, h_ + k);
      const auto less = hn::Lt(h, best);
      best = hn::IfThenElse(less, h, best);
      at = hn::IfThenElse(less, index, at);
      index = hn::Add(index, hn::Set(d, static_cast<double>(lanes)));
    }
    return least(best, at);
  }

  /// The next spoke, counter-clockwise: the neighbor that a circle through the candidate and that spoke meets
  /// first. -1: there is none.
  HWY_ATTR int after(int spoke) const {
    const D d;
    const auto ux = hn::Set(d, x_[spoke]), uy = hn::Set(d, y_[spoke]), zero = hn::Zero(d);
    auto best = hn::Set(d, infinite), at = hn::Set(d, 0.0), index = hn::Iota(d, 0);
    for (std::size_t k = 0; k < size_; k += lanes) {
      const auto x = hn::Load(d, x_ + k), y = hn::Load(d, y_ + k), h = hn::Load(d, h_ + k);
      const auto area = hn::Sub(hn::Mul(ux, y), hn::Mul(uy, x));
      const auto rest = hn::Sub(h, hn::Add(hn::Mul(ux, x), hn::Mul(uy, y)));
      const auto t = hn::Div(rest, area);  // the cotangent of the angle at which the spoke is seen from there
      const auto less = hn::And(hn::Gt(area, zero), hn::Lt(t, best));
      best = hn::IfThenElse(less, t, best);
      at = hn::IfThenElse(less, index, at);
      index = hn::Add(index, hn::Set(d, static_cast<double>(lanes)));
    }
    return least(best, at);
  }

 private:
  /// Where the least of all lanes was found; of equals, the first place. -1: nowhere.
  template <class V>
  static HWY_ATTR int least(V best, V at) {
    const D d;
    const auto value = hn::MinOfLanes(d, best);
    if (!(hn::GetLane(value) < infinite)) return -1;
    return static_cast<int>(
        hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(hn::Eq(best, value), at, hn::Set(d, infinite)))));
  }

  std::size_t size_;
  alignas(64) double x_[CandidateStar::Table::padded], y_[CandidateStar::Table::padded],
      h_[CandidateStar::Table::padded];
};

/// False: there is no star, or not of so few spokes.
bool wrap_here(CandidateStar::Table& t, Vec2 u) {
  const Wrapping around(t, u);
  const int first = around.nearest();
  t.degree = 0;
  for (int next = first; next >= 0;) {
    if (t.degree == CandidateStar::most) return false;
    t.spoke[t.degree++] = next;
    next = around.after(next);
    if (next == first) return t.degree >= 3;
  }
  return false;
}

}  // namespace
}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wellspaced {

HWY_EXPORT(look_here);
HWY_EXPORT(wrap_here);

void CandidateStar::load(std::span<const Neighbor> neighbors) {
  Table& t = table_;
  t.degree = 0;
  t.size = static_cast<int>(neighbors.size());
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    t.x[k] = neighbors[k].offset.x;
    t.y[k] = neighbors[k].offset.y;
  }
}

std::optional<CandidateStar::Squares> CandidateStar::squares_at(Vec2 u) {
  if (table_.degree > 0)
    if (const auto squares = mended_squares_at(u)) return squares;
  if (wrap(u))
    if (const auto squares = mended_squares_at(u)) return squares;
  table_.degree = 0;
  return std::nullopt;
}

std::optional<CandidateStar::Squares> CandidateStar::mended_squares_at(Vec2 u) {
  constexpr int most_mends = 32;
  for (int mends = 0; mends < most_mends; ++mends) {
    Squares squares;
    switch (HWY_DYNAMIC_DISPATCH(look_here)(table_, u, squares)) {
      case StarState::delaunay:
        return squares;
      case StarState::not_a_star:
        return std::nullopt;
      case StarState::not_delaunay:
        if (!drop_spoke(u) && !take_outer(u)) return std::nullopt;
    }
  }
  return std::nullopt;
}

bool CandidateStar::wrap(Vec2 u) {
  Table& t = table_;
  if (!HWY_DYNAMIC_DISPATCH(wrap_here)(t, u)) return false;
  bool is_spoke[most_neighbors] = {};
  for (int k = 0; k < t.degree; ++k) is_spoke[t.spoke[k]] = true;
  t.outers = 0;
  for (int k = 0; k < t.size; ++k)
    if (!is_spoke[k]) put_outer(t.outers++, k);
  put_spokes();
  return true;
}

namespace {

/// Whether the neighbor q reaches into the circle around corner k.
bool is_inside(const CandidateStar::Table& t, Vec2 u, int k, Vec2 q, double half2) {
  const Vec2 c{t.corner_x[k], t.corner_y[k]};
  return dot(q, c + u) - half2 >= dot(u, c) + (0.5 * norm2(u) + touching * norm2(c));
}

}  // namespace

/// Removes a spoke whose ends the Voronoi edge has passed. As long as there is one, the corners don't bound a
/// convex cell.
bool CandidateStar::drop_spoke(Vec2 u) {
  const Table& t = table_;
  for (int k = 0; k < t.degree; ++k)
    if (is_inside(t, u, k, {t.spoke_x[k + 2], t.spoke_y[k + 2]}, t.spoke_half2[k + 2]))
      return replace(k, 1, -1);
  return false;
}

/// Makes a spoke of a neighbor that cuts corners off, of which there is one run: the cell is convex.
bool CandidateStar::take_outer(Vec2 u) {
  const Table& t = table_;
  for (int q = 0; q < t.outers; ++q) {
    std::uint32_t cut = 0;
    for (int k = 0; k < t.degree; ++k)
      if (is_inside(t, u, k, {t.outer_x[q], t.outer_y[q]}, t.outer_half2[q])) cut |= 1u << k;
    if (cut == 0) continue;
    const std::uint32_t all = (1u << t.degree) - 1, shifted = (cut << 1 | cut >> (t.degree - 1)) & all;
    const std::uint32_t first = cut & ~shifted;
    if (std::popcount(first) != 1) return false;
    return replace(std::countr_zero(first), std::popcount(cut) - 1, q);
  }
  return false;
}

/// Removes spokes after the one at `first`, and puts an outer neighbor in their place if it is not -1.
bool CandidateStar::replace(int first, int removed, int outer) {
  Table& t = table_;
  const int degree = t.degree - removed + (outer < 0 ? 0 : 1);
  if (degree < 3 || degree > most) return false;
  std::rotate(t.spoke, t.spoke + (first + 1) % t.degree, t.spoke + t.degree);
  std::int32_t gone[most];
  std::copy(t.spoke, t.spoke + removed, gone);
  std::copy(t.spoke + removed, t.spoke + t.degree, t.spoke);
  t.degree = degree;
  if (outer >= 0) {
    t.spoke[degree - 1] = t.outer[outer];
    put_outer(outer, t.outer[--t.outers]);
  }
  for (int k = 0; k < removed; ++k) put_outer(t.outers++, gone[k]);
  put_spokes();
  return true;
}

void CandidateStar::put_spokes() {
  Table& t = table_;
  const int slots = (t.degree <= 8 ? 8 : 16) + 2;
  for (int k = 0, m = 0; k < slots; ++k, m = m + 1 == t.degree ? 0 : m + 1) {
    const double x = t.x[t.spoke[m]], y = t.y[t.spoke[m]];
    t.spoke_x[k] = x;
    t.spoke_y[k] = y;
    t.spoke_half2[k] = 0.5 * (x * x + y * y);
  }
}

void CandidateStar::put_outer(int at, std::int32_t place) {
  Table& t = table_;
  const double x = t.x[place], y = t.y[place];
  t.outer[at] = place;
  t.outer_x[at] = x;
  t.outer_y[at] = y;
  t.outer_half2[at] = 0.5 * (x * x + y * y);
}

}  // namespace wellspaced
#endif  // HWY_ONCE

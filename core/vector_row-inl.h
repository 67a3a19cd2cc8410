// Included once for every kind of vector unit, by files that hwy/foreach_target.h compiles so.
#if defined(WELLSPACED_VECTOR_ROW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WELLSPACED_VECTOR_ROW_INL_H
#undef WELLSPACED_VECTOR_ROW_INL_H
#else
#define WELLSPACED_VECTOR_ROW_INL_H
#endif

#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// For each degree, the place before each place.
struct BeforeTable {
  alignas(64) std::int32_t place[17][16];

  constexpr BeforeTable() : place() {
    for (int degree = 1; degree <= 16; ++degree)
      for (int k = 0; k < 16; ++k) place[degree][k] = k == 0 ? degree - 1 : k - 1;
  }
};
inline constexpr BeforeTable before_of_degree;

/// W numbers of type T, 8 or 16, in as many vectors as that takes. Plain IEEE arithmetic, place by place: the
/// same bits on every vector unit.
template <class T, int W>
struct Row {
  using D = hn::CappedTag<T, W>;
  using V = hn::Vec<D>;
  static constexpr int lanes = static_cast<int>(hn::MaxLanes(D())), vectors = W / lanes;

  V v[vectors];

  template <class F>
  static HWY_INLINE Row of(const F& f) {
    Row row;
    for (int m = 0; m < vectors; ++m) row.v[m] = f(m);
    return row;
  }
  static HWY_INLINE Row load(const T* from) {
    return of([&](int m) { return hn::LoadU(D(), from + m * lanes); });
  }
  static HWY_INLINE Row all(T value) {
    const V same = hn::Set(D(), value);
    return of([&](int) { return same; });
  }
  HWY_INLINE void store(T* to) const {
    for (int m = 0; m < vectors; ++m) hn::StoreU(v[m], D(), to + m * lanes);
  }

  friend HWY_INLINE Row operator+(Row a, Row b) {
    return of([&](int m) { return hn::Add(a.v[m], b.v[m]); });
  }
  friend HWY_INLINE Row operator-(Row a, Row b) {
    return of([&](int m) { return hn::Sub(a.v[m], b.v[m]); });
  }
  friend HWY_INLINE Row operator*(Row a, Row b) {
    return of([&](int m) { return hn::Mul(a.v[m], b.v[m]); });
  }
  friend HWY_INLINE Row operator/(Row a, Row b) {
    return of([&](int m) { return hn::Div(a.v[m], b.v[m]); });
  }
  friend HWY_INLINE Row larger(Row a, Row b) {
    return of([&](int m) { return hn::Max(a.v[m], b.v[m]); });
  }
  HWY_INLINE Row root() const {
    return of([&](int m) { return hn::Sqrt(v[m]); });
  }

  friend HWY_INLINE bool all_less(Row a, Row b) {
    auto less = hn::Lt(a.v[0], b.v[0]);
    for (int m = 1; m < vectors; ++m) less = hn::And(less, hn::Lt(a.v[m], b.v[m]));
    return hn::AllTrue(D(), less);
  }
  /// 0 where a is not below b.
  HWY_INLINE Row where_less(Row a, Row b) const {
    return of([&](int m) { return hn::IfThenElseZero(hn::Lt(a.v[m], b.v[m]), v[m]); });
  }
  /// One bit a place where a < b.
  static HWY_INLINE std::uint32_t less(Row a, Row b) {
    std::uint32_t found = 0;
    for (int m = 0; m < vectors; ++m) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(D(), hn::Lt(a.v[m], b.v[m]), bits);
      found |= (bits[0] | static_cast<std::uint32_t>(bits[1]) << 8) << (m * lanes);
    }
    return found;
  }

  HWY_INLINE T largest() const {
    V all = v[0];
    for (int m = 1; m < vectors; ++m) all = hn::Max(all, v[m]);
    return hn::GetLane(hn::MaxOfLanes(D(), all));
  }
  HWY_INLINE T smallest() const {
    V all = v[0];
    for (int m = 1; m < vectors; ++m) all = hn::Min(all, v[m]);
    return hn::GetLane(hn::MinOfLanes(D(), all));
  }
  /// In an order that does not depend on the width of vectors.
  HWY_INLINE T sum() const {
    alignas(64) T places[W];
    store(places);
    for (int half = W / 2; half > 0; half /= 2)
      for (int k = 0; k < half; ++k) places[k] += places[k + half];
    return places[0];
  }

  /// The same, one place on: the first comes last.
  HWY_INLINE Row next() const {
    static_assert(sizeof(T) == sizeof(std::int32_t));
    if constexpr (vectors == 1) {
      alignas(64) static constexpr std::int32_t on[16] = {1, 2,  3,  4,  5,  6,  7,  W == 8 ? 0 : 8,
                                                          9, 10, 11, 12, 13, 14, 15, 0};
      return {{hn::TableLookupLanes(v[0], hn::SetTableIndices(D(), on))}};
    } else {
      alignas(64) T places[W + 1];
      store(places);
      places[W] = places[0];
      return load(places + 1);
    }
  }
  /// One place back; the first one gets the last of `degree` places.
  HWY_INLINE Row before(int degree) const {
    static_assert(sizeof(T) == sizeof(std::int32_t));
    if constexpr (vectors == 1) {
      return {{hn::TableLookupLanes(v[0], hn::SetTableIndices(D(), before_of_degree.place[degree]))}};
    } else {
      alignas(64) T places[W + 1];
      store(places + 1);
      places[0] = places[degree];
      return load(places);
    }
  }
};

}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

// Included once for every kind of vector unit, by files that hwy/foreach_target.h compiles so.
#if defined(WELLSPACED_STAR_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WELLSPACED_STAR_LANES_INL_H
#undef WELLSPACED_STAR_LANES_INL_H
#else
#define WELLSPACED_STAR_LANES_INL_H
#endif

#include "core/vector_row-inl.h"
#include "core/voronoi/star_mesh.h"

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {

/// The star of one point: places past its degree repeat the first neighbor.
template <int W>
struct StarLanes {
  using Floats = Row<float, W>;
  using D = typename Floats::D;

  Floats x, y, d2;          // neighbors: offset and squared distance
  Floats cx, cy, r2, area;  // triangle k, between neighbors k and k + 1

  HWY_INLINE void load(const StarMesh& mesh, std::size_t i) {
#if HWY_TARGET != HWY_SCALAR
    if constexpr (W == 8) return load_by_pairs(mesh, i);
#endif
    load_one_by_one(mesh, i);
  }

  HWY_INLINE void shift_from(const StarLanes& other, float dx, float dy) {
    x = other.x - Floats::all(dx);
    y = other.y - Floats::all(dy);
  }

  HWY_INLINE void evaluate() {
    d2 = x * x + y * y;
    const Floats bx = x.next(), by = y.next(), b2 = bx * bx + by * by;
    area = x * by - y * bx;
    const Floats h = Floats::all(0.5f) / area;
    cx = h * (by * d2 - y * b2);
    cy = h * (x * b2 - bx * d2);
    r2 = cx * cx + cy * cy;
  }

 private:
  void load_one_by_one(const StarMesh& mesh, std::size_t i) {
    const Star& star = mesh.star(i);
    const FixedPoint here = mesh.at(i);
    alignas(64) std::int32_t dx[W], dy[W];
    for (int k = 0; k < W; ++k) {
      const FixedPoint there = mesh.at(star.neighbor[k < Star::most ? k : 0]);
      dx[k] = static_cast<std::int32_t>(there.x - here.x);
      dy[k] = static_cast<std::int32_t>(there.y - here.y);
    }
    const auto scaled = [](const std::int32_t* steps, double scale) {
      return Floats::of([&](int m) {
        const hn::RebindToSigned<D> whole;
        return hn::Mul(hn::ConvertTo(D(), hn::Load(whole, steps + m * Floats::lanes)),
                       hn::Set(D(), static_cast<float>(scale)));
      });
    };
    x = scaled(dx, mesh.scale().x);
    y = scaled(dy, mesh.scale().y);
  }

#if HWY_TARGET != HWY_SCALAR
  /// The same without a way through memory, which would have to wait for the last of so small stores.
  HWY_INLINE void load_by_pairs(const StarMesh& mesh, std::size_t i) requires(W == 8) {
    const hn::FixedTag<std::uint32_t, 4> four;
    const hn::FixedTag<std::uint64_t, 2> two;
    const Star& star = mesh.star(i);
    const auto pair = [&](int k) {  // x, x, y, y
      const hn::FixedTag<std::uint32_t, 2> place;
      const FixedPoint &a = mesh.at(star.neighbor[k]), &b = mesh.at(star.neighbor[k + 1]);
      return hn::BitCast(two, hn::InterleaveLower(four, hn::ZeroExtendVector(four, hn::LoadU(place, &a.x)),
                                                  hn::ZeroExtendVector(four, hn::LoadU(place, &b.x))));
    };
    const auto p0 = pair(0), p2 = pair(2), p4 = pair(4), p6 = pair(6);
    const auto x0 = hn::BitCast(four, hn::InterleaveLower(two, p0, p2)),
               y0 = hn::BitCast(four, hn::InterleaveUpper(two, p0, p2)),
               x4 = hn::BitCast(four, hn::InterleaveLower(two, p4, p6)),
               y4 = hn::BitCast(four, hn::InterleaveUpper(two, p4, p6));
    const FixedPoint here = mesh.at(i);
    x = scaled(x0, x4, here.x, mesh.scale().x);
    y = scaled(y0, y4, here.y, mesh.scale().y);
  }

  template <class V>
  static HWY_INLINE Floats scaled(V first, V second, std::uint32_t here, double scale) {
    const hn::RebindToUnsigned<D> steps;
    const hn::RebindToSigned<D> whole;
    const auto length = [&](auto there) {
      const auto way = hn::BitCast(whole, hn::Sub(there, hn::Set(steps, here)));
      return hn::Mul(hn::ConvertTo(D(), way), hn::Set(D(), static_cast<float>(scale)));
    };
    if constexpr (Floats::vectors == 1)
      return {{length(hn::Combine(steps, second, first))}};
    else
      return {{length(first), length(second)}};
  }
#endif
};

}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

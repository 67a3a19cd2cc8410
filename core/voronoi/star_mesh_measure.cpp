#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "core/voronoi/star_mesh.h"

#ifndef WELLSPACED_STAR_MESH_MEASURE
#define WELLSPACED_STAR_MESH_MEASURE
namespace wellspaced {

/// The extremes of what was seen.
struct Extremes {
  double shortest2 = std::numeric_limits<double>::infinity(), outermost2 = 0;

  void see(const StarMesh& mesh, std::size_t i) {
    const Star& star = mesh.star(i);
    Vec2 a = mesh.offset(i, star.neighbor[star.degree - 1]);
    for (int k = 0; k < star.degree; ++k) {
      const Vec2 b = mesh.offset(i, star.neighbor[k]);
      shortest2 = std::min(shortest2, norm2(b));
      // Each triangle once a corner: the circumradius is |a| |b| |a - b| / (2 cross(a, b)).
      const double area2 = cross(a, b);
      outermost2 = std::max(outermost2, norm2(a) * norm2(b) * norm2(a - b) / (4 * area2 * area2));
      a = b;
    }
  }
};

}  // namespace wellspaced
#endif

// This file is compiled once for every kind of vector unit; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/voronoi/star_mesh_measure.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

#include "core/voronoi/star_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {
namespace {

/// What a star evaluated in float can't rule out: an error of 180 units in the last place where no angle's
/// sine is below 1/4, four times that here.
struct Doubtful {
  float shortest2, outermost2;

  explicit Doubtful(const Extremes& e) {
    constexpr double error = 4e-5;
    shortest2 = static_cast<float>(e.shortest2 * (1 + error));
    outermost2 = static_cast<float>(e.outermost2 * (1 - error));
  }
};

template <int W>
bool may_extend(const StarMesh& mesh, std::size_t i, const Doubtful& known) {
  using Floats = Row<float, W>;
  StarLanes<W> star;
  star.load(mesh, i);
  star.evaluate();
  const Floats b2 = star.d2.next();
  const std::uint32_t doubtful = Floats::less(star.d2, Floats::all(known.shortest2)) |
                                 Floats::less(Floats::all(known.outermost2), star.r2) |
                                 Floats::less(Floats::all(16) * (star.area * star.area), star.d2 * b2);
  return (doubtful & ((1u << mesh.star(i).degree) - 1)) != 0;
}

/// The same bits as if every star were seen in double: only those are that may matter.
void see_block(const StarMesh& mesh, std::size_t begin, std::size_t end, Extremes& extremes) {
  Doubtful known(extremes);
  for (std::size_t i = begin; i < end; ++i) {
    const bool matters =
        mesh.star(i).degree <= 8 ? may_extend<8>(mesh, i, known) : may_extend<16>(mesh, i, known);
    if (!matters) continue;
    extremes.see(mesh, i);
    known = Doubtful(extremes);
  }
}

}  // namespace
}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wellspaced {

HWY_EXPORT(see_block);

MeshRadii StarMesh::measure(const Control& control) const {
  constexpr std::size_t block = 16384;
  std::vector<Extremes> parts((size() + block - 1) / block);
  parallel_blocks(size(), block, control, [&](std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(see_block)(*this, begin, end, parts[begin / block]);
  });
  Extremes all;
  for (const Extremes& part : parts)
    all = {std::min(all.shortest2, part.shortest2), std::max(all.outermost2, part.outermost2)};
  return {std::sqrt(all.shortest2), std::sqrt(all.outermost2)};
}

}  // namespace wellspaced
#endif  // HWY_ONCE

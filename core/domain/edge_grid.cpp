#include "core/domain/edge_grid.h"

#include <cmath>
#include <utility>

#include "core/error.h"

namespace wellspaced {

EdgeGrid::EdgeGrid(const PolygonRings& rings, double squares) : low_(rings.low()) {
  const Vec2 size = rings.size();
  side_ = std::sqrt(size.x * size.y / squares);
  columns_ = std::max(1, static_cast<int>(std::ceil(size.x / side_)));
  rows_ = std::max(1, static_cast<int>(std::ceil(size.y / side_)));
  fill(rings);
}

EdgeGrid::EdgeGrid(const PolygonRings& rings, const EdgeGrid& finer)
    : low_(rings.low()),
      side_(2 * finer.side_),
      columns_((finer.columns_ + 1) / 2),
      rows_((finer.rows_ + 1) / 2) {
  fill(rings);
}

void EdgeGrid::fill(const PolygonRings& rings) {
  constexpr double most_entries = 0x1p27;
  per_side_ = 1 / side_;
  margin_ = 1e-9 * side_ + 8 * rings.ulp();
  begin_.assign(squares() + 1, 0);
  double entries = 0;
  const auto each = [&](std::uint32_t e, const auto& visit) {
    visit_squares(rings.local(rings.edges()[e].from), rings.local(rings.edges()[e].to), visit);
  };
  for (std::uint32_t e = 0; e < rings.edges().size(); ++e) {
    each(e, [&](std::size_t square) { ++begin_[square], ++entries; });
    if (entries > most_entries)
      throw Error(ErrorCode::degenerate_input,
                  "the edges are too many for their length: more than 10^8 of them would be looked at; "
                  "simplify the rings",
                  "/rings");
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& count : begin_) {
    pairs_ += static_cast<double>(count) * count;
    sum += std::exchange(count, sum);
  }
  edges_.resize(sum);
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t e = 0; e < rings.edges().size(); ++e)
    each(e, [&](std::size_t square) { edges_[next[square]++] = e; });
}

}  // namespace wellspaced

#include "core/voronoi/neighbors.h"

#include <algorithm>
#include <cmath>

namespace wellspaced {

struct NeighborGrid::Window {
  Vec3 base;
  std::uint32_t self;
  double reach2;
};

NeighborGrid::NeighborGrid(const PointSet& points, double cell, std::size_t expected)
    : points_(&points), has_hints_(points.domain->has_hints()) {
  const Box box = points.domain->box();
  const double low[3] = {box.low.x, box.low.y, box.low.z};
  const double size[3] = {box.size.x, box.size.y, box.size.z};
  // More than a few cells a sample only costs memory: a thin box may ask for that.
  const double most = std::max(64.0, 4.0 * static_cast<double>(expected));
  double wanted = 1;
  for (double s : size) wanted *= std::max(1.0, s / cell);
  if (wanted > most)
    cell *= points.domain->dimension() == 3 ? std::cbrt(wanted / most) : std::sqrt(wanted / most);

  std::size_t cells = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    Axis& axis = axes_[a];
    axis.low = low[a];
    axis.size = size[a];
    axis.cells = std::max<std::int64_t>(1, static_cast<std::int64_t>(size[a] / cell));
    axis.per_length = size[a] > 0 ? static_cast<double>(axis.cells) / size[a] : 0;
    axis.periodic = box.periodic[a];
    cells *= static_cast<std::size_t>(axis.cells);
  }
  first_.assign(cells, none);
  next_.assign(points.size(), none);
  for (std::size_t i = points.size(); i-- > 0;) {  // backwards, so that each cell lists its samples in order
    const std::size_t c = cell_of(points[i]);
    next_[i] = first_[c];
    first_[c] = static_cast<std::uint32_t>(i);
  }
  for (std::size_t i = 0; i < points.size() && has_hints_; ++i)
    hints_.push_back(points.domain->hint(points[i]));
}

std::size_t NeighborGrid::cell_of(Vec3 p) const {
  const double c[3] = {p.x, p.y, p.z};
  std::size_t index = 0;
  for (std::size_t a = 3; a-- > 0;) {
    const Axis& axis = axes_[a];
    const auto k = static_cast<std::int64_t>(std::floor((c[a] - axis.low) * axis.per_length));
    index = index * static_cast<std::size_t>(axis.cells) +
            static_cast<std::size_t>(std::clamp<std::int64_t>(k, 0, axis.cells - 1));
  }
  return index;
}

void NeighborGrid::gather(Vec3 base, std::uint32_t self, double reach, std::vector<Neighbor>& out) const {
  const double c[3] = {base.x, base.y, base.z};
  const double slack = reach * 1e-9;  // cells are found by rounded arithmetic, distances decide
  std::array<std::int64_t, 3> from{}, to{};
  for (std::size_t a = 0; a < 3; ++a) {
    const Axis& axis = axes_[a];
    from[a] = static_cast<std::int64_t>(std::floor((c[a] - reach - slack - axis.low) * axis.per_length));
    to[a] = static_cast<std::int64_t>(std::floor((c[a] + reach + slack - axis.low) * axis.per_length));
    if (axis.periodic) continue;
    from[a] = std::clamp<std::int64_t>(from[a], 0, axis.cells - 1);
    to[a] = std::clamp<std::int64_t>(to[a], 0, axis.cells - 1);
  }
  const auto turns = [](std::int64_t k, std::int64_t n) { return k >= 0 ? k / n : -((n - 1 - k) / n); };
  const Window window{base, self, reach * reach};
  for (std::int64_t z = from[2]; z <= to[2]; ++z) {
    const std::int64_t tz = turns(z, axes_[2].cells);
    for (std::int64_t y = from[1]; y <= to[1]; ++y) {
      const std::int64_t ty = turns(y, axes_[1].cells);
      const auto row = static_cast<std::size_t>(
          ((z - tz * axes_[2].cells) * axes_[1].cells + y - ty * axes_[1].cells) * axes_[0].cells);
      for (std::int64_t x = from[0]; x <= to[0]; ++x) {
        const std::int64_t tx = turns(x, axes_[0].cells);
        const Vec3 shift{static_cast<double>(tx) * axes_[0].size, static_cast<double>(ty) * axes_[1].size,
                         static_cast<double>(tz) * axes_[2].size};
        gather_cell(row + static_cast<std::size_t>(x - tx * axes_[0].cells), window, shift, out);
      }
    }
  }
}

void NeighborGrid::gather_cell(std::size_t cell, const Window& window, Vec3 shift,
                               std::vector<Neighbor>& out) const {
  for (std::uint32_t i = first_[cell]; i != none; i = next_[i]) {
    // The difference first, then the shift: q + period would round away the last bits of q.
    const Vec3 offset = ((*points_)[i] - window.base) + shift;
    if (norm2(offset) > window.reach2) continue;
    if (i == window.self && shift == Vec3{}) continue;
    out.push_back({offset, i, has_hints_ ? hints_[i] : Neighbor::no_hint});
  }
}

void NeighborGrid::move(std::uint32_t i, Vec3 from, Vec3 to) {
  if (has_hints_) hints_[i] = points_->domain->hint(to);
  const std::size_t old_cell = cell_of(from), new_cell = cell_of(to);
  if (old_cell == new_cell) return;
  take_out(i, from);
  put_back(i, to);
}

void NeighborGrid::take_out(std::uint32_t i, Vec3 at) {
  std::uint32_t* link = &first_[cell_of(at)];
  while (*link != i) link = &next_[*link];
  *link = next_[i];
}

void NeighborGrid::put_back(std::uint32_t i, Vec3 at) {
  if (has_hints_) hints_[i] = points_->domain->hint(at);
  std::uint32_t& first = first_[cell_of(at)];
  next_[i] = first;
  first = i;
}

void NeighborGrid::add(std::uint32_t i) {
  const Vec3 at = (*points_)[i];
  if (has_hints_) hints_.push_back(points_->domain->hint(at));
  std::uint32_t& first = first_[cell_of(at)];
  next_.push_back(first);
  first = i;
}

std::size_t NeighborGrid::fullest_cell() const {
  std::size_t most = 0;
  for (std::uint32_t i : first_) {
    std::size_t count = 0;
    for (; i != none; i = next_[i]) ++count;
    most = std::max(most, count);
  }
  return most;
}

std::size_t NeighborGrid::empty_cells() const {
  return static_cast<std::size_t>(std::count(first_.begin(), first_.end(), none));
}

}  // namespace wellspaced

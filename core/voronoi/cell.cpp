#include "core/voronoi/cell.h"

#include <algorithm>

namespace wellspaced {

void Cell::reset(double reach) {
  corners_.clear();
  corners_.push_back({{-reach, -reach}, -1});
  corners_.push_back({{reach, -reach}, -1});
  corners_.push_back({{reach, reach}, -1});
  corners_.push_back({{-reach, reach}, -1});
  outradius2_ = 2 * reach * reach;
}

void Cell::reset(std::span<const Vec2> polygon) {
  corners_.clear();
  outradius2_ = 0;
  for (const Vec2 at : polygon) {
    corners_.push_back({at, -1});
    outradius2_ = std::max(outradius2_, norm2(at));
  }
}

void Cell::clip(const HalfPlane& h, std::int32_t label) {
  const double n2 = norm2(h.n);
  if (h.c > 0 && h.c * h.c >= outradius2_ * n2) return;  // the bisector passes outside the farthest corner

  const std::size_t m = corners_.size();
  side_.resize(m);
  const double touch2 = 1e-24 * outradius2_ * n2;  // (1e-12 of the cell's size)^2, in units of side^2
  bool cuts = false;
  for (std::size_t k = 0; k < m; ++k) {
    double s = dot(h.n, corners_[k].at) - h.c;
    if (s * s <= touch2) s = 0;
    side_[k] = s;
    cuts = cuts || s > 0;
  }
  if (!cuts) return;

  scratch_.resize(2 * m);  // one more than m would do, if rounding never made a cell concave
  Corner* out = scratch_.data();
  for (std::size_t k = 0; k < m; ++k) {
    const std::size_t next = k + 1 == m ? 0 : k + 1;
    const bool here = side_[k] <= 0, there = side_[next] <= 0;
    const Corner& a = corners_[k];
    if (here && (there || side_[k] < 0)) *out++ = a;
    if (here == there) continue;
    if (here && side_[k] == 0) {  // leaves exactly at a corner: the new edge starts there
      *out++ = {a.at, label};
      continue;
    }
    if (there && side_[next] == 0) continue;  // enters at a corner, which closes the new edge in its turn
    const double t = side_[k] / (side_[k] - side_[next]);
    *out++ = {a.at + t * (corners_[next].at - a.at), here ? label : a.label};
  }
  scratch_.resize(static_cast<std::size_t>(out - scratch_.data()));
  corners_.swap(scratch_);
  outradius2_ = 0;
  for (const Corner& corner : corners_) outradius2_ = std::max(outradius2_, norm2(corner.at));
}

bool Cell::closed() const {
  return std::none_of(corners_.begin(), corners_.end(), [](const Corner& c) { return c.label < 0; });
}

Vec2 circumcenter(Vec2 a, Vec2 b) {
  const double a2 = norm2(a), b2 = norm2(b);
  const double scale = 0.5 / cross(a, b);
  return {scale * (b.y * a2 - a.y * b2), scale * (a.x * b2 - b.x * a2)};
}

}  // namespace wellspaced

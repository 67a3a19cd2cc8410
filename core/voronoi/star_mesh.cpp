#include "core/voronoi/star_mesh.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>

#include "core/error.h"
#include "core/rng.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

constexpr double turn = 4294967296.0;  // 2^32 fixed-point steps around the torus

std::uint32_t to_fixed(double x, double period) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(x / period * turn + 0.5));
}

double to_length(std::uint32_t x, double period) {
  const double length = static_cast<double>(x) / turn * period;
  return length < period ? length : 0.0;
}

void require_room(const PointSet& points, double spacing) {
  constexpr std::size_t fewest = 20;
  constexpr double thinnest = 4;
  if (points.size() < fewest)
    throw Error(ErrorCode::degenerate_input, "this method needs at least 20 points; the set has " +
                                                 std::to_string(points.size()) +
                                                 " (opt-beta-local takes fewer)");
  const Box box = points.domain->box();
  if (std::min(box.size.x, box.size.y) < thinnest * spacing)
    throw Error(
        ErrorCode::degenerate_input,
        "the torus is thinner than four times the mean spacing of its points, so that cells wrap around "
        "it; use more points or opt-beta-local");
}

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorCode::degenerate_input,
              why +
                  "; start from a point set that is spread over its domain, such as "
                  "poisson-disk gives, fill them with enrich, or use opt-beta-local");
}

}  // namespace

int Star::find(std::uint32_t v) const {
  int k = 0;
  while (k < degree && neighbor[k] != v) ++k;
  return k;
}

void Star::erase(int k) {
  --degree;
  for (int j = k; j < degree; ++j) neighbor[j] = neighbor[j + 1];
  for (int j = degree; j < most; ++j) neighbor[j] = neighbor[0];
}

void Star::insert_after(int k, std::uint32_t v) {
  for (int j = degree; j > k + 1; --j) neighbor[j] = neighbor[j - 1];
  neighbor[k + 1] = v;
  ++degree;
  for (int j = degree; j < most; ++j) neighbor[j] = neighbor[0];
}

StarMesh::StarMesh(const PointSet& points, const Control& control) {
  require_usable(points, control);
  const Box box = points.domain->box();
  width_ = box.size.x;
  height_ = box.size.y;
  spacing_ = hexagonal_spacing(points.domain->area(), points.size());
  require_room(points, spacing_);
  scale_ = {width_ / turn / spacing_, height_ / turn / spacing_};
  place_in_grid_order(points);
  build_stars(points, control);
  marks_.assign((size() + 63) / 64, 0);
}

void StarMesh::place_in_grid_order(const PointSet& points) {
  const auto cells = [&](double side) {
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(side / (1.6 * spacing_)));
  };
  const std::uint64_t columns = cells(width_), rows = cells(height_);
  std::vector<FixedPoint> at(points.size());
  std::vector<std::uint64_t> cell(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    at[i] = {to_fixed(points[i].x, width_), to_fixed(points[i].y, height_)};
    cell[i] = ((at[i].y * rows) >> 32) * columns + ((at[i].x * columns) >> 32);
  }
  std::vector<std::uint32_t> start(columns * rows + 1, 0);
  for (const std::uint64_t c : cell) ++start[c + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  at_.resize(points.size());
  original_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t k = start[cell[i]]++;
    at_[k] = at[i];
    original_[k] = static_cast<std::uint32_t>(i);
  }
}

Vec2 StarMesh::offset(std::size_t i, std::size_t j) const {
  return {static_cast<double>(static_cast<std::int32_t>(at_[j].x - at_[i].x)) * scale_.x,
          static_cast<double>(static_cast<std::int32_t>(at_[j].y - at_[i].y)) * scale_.y};
}

PointSet StarMesh::places_as_points(const std::shared_ptr<const Domain>& domain) const {
  PointSet points{domain, {}};
  points.coordinates.reserve(2 * size());
  for (const FixedPoint& p : at_) points.push_back({to_length(p.x, width_), to_length(p.y, height_), 0});
  return points;
}

void StarMesh::build_stars(const PointSet& input, const Control& control) {
  // Cocircular neighbors have no one triangulation: they are nudged, by far less than any target's margin.
  constexpr double nudges[] = {0, 1e-7, 1e-6, 1e-5};
  const std::vector<FixedPoint> exact = at_;
  for (const double nudge : nudges) {
    at_ = exact;
    if (nudge > 0) shake(nudge);
    const PointSet rounded = places_as_points(input.domain);
    try {
      require_usable(rounded, control);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::degenerate_input) throw;
      refuse("two of the points are nearer to each other than a 2^32nd of the torus");
    }
    collect_stars(rounded, control);
    if (is_mutual()) return;
  }
  refuse("the points have no clear Delaunay triangulation");
}

void StarMesh::shake(double amount) {
  Rng rng(0x5ba5e);
  const auto step = [&](double scale) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>((2 * rng.uniform() - 1) * amount / scale));
  };
  for (FixedPoint& p : at_) {
    p.x += step(scale_.x);
    p.y += step(scale_.y);
  }
}

void StarMesh::collect_stars(const PointSet& points, const Control& control) {
  stars_.resize(size());
  std::atomic<bool> crowded = false, wrapped = false;
  visit_stars(points, control, [&](std::size_t i, std::span<const Spoke> spokes) {
    Star& star = stars_[i];
    star.degree = static_cast<std::int32_t>(std::min<std::size_t>(spokes.size(), Star::most));
    if (spokes.size() > Star::most) crowded = true;
    for (int k = 0; k < Star::most; ++k) {
      const Spoke& spoke = spokes[static_cast<std::size_t>(k < star.degree ? k : 0)];
      star.neighbor[k] = spoke.id;
      const Vec2 seen = spacing_ * offset(i, spoke.id);
      if (spoke.id == i || norm(seen - spoke.offset) > 1e-6 * spacing_) wrapped = true;
    }
  });
  if (crowded) refuse("a point has more than 15 Delaunay neighbors");
  if (wrapped) refuse("there are empty regions as wide as the torus");
}

bool StarMesh::is_mutual() const {
  for (std::size_t i = 0; i < size(); ++i) {
    const Star& star = stars_[i];
    if (star.degree < 3) return false;
    for (int k = 0; k < star.degree; ++k) {
      const Star& other = stars_[star.neighbor[k]];
      const int back = other.find(static_cast<std::uint32_t>(i));
      if (back == other.degree || other.neighbor[other.before(back)] != star.neighbor[star.after(k)])
        return false;
    }
  }
  return true;
}

// ---- flips

bool StarMesh::try_flip(std::uint32_t a, std::uint32_t b) {
  Star& star = stars_[a];
  const int k = star.find(b);
  if (k == star.degree) return false;  // the edge is gone
  const std::uint32_t left = star.neighbor[star.after(k)], right = star.neighbor[star.before(k)];
  const Vec2 to_b = offset(a, b), to_left = offset(a, left), to_right = offset(a, right);
  const double b2 = norm2(to_b), left2 = norm2(to_left), right2 = norm2(to_right);
  // Negative: `right` lies inside the circle through a, b, left.
  const double in_circle = right2 * cross(to_b, to_left) - to_right.x * (to_left.y * b2 - to_b.y * left2) -
                           to_right.y * (to_b.x * left2 - to_left.x * b2);
  if (!(in_circle < -1e-9 * b2 * b2)) return false;
  if (stars_[left].degree >= Star::most || stars_[right].degree >= Star::most) return false;
  if (star.degree <= 3 || stars_[b].degree <= 3) return false;
  if (!(cross(to_right, to_left) > 0)) return false;  // the quadrilateral is not convex
  if (!(cross(to_right - to_b, to_left - to_b) < 0)) return false;
  star.erase(k);
  stars_[b].erase(stars_[b].find(a));
  stars_[left].insert_after(stars_[left].find(a), right);
  stars_[right].insert_after(stars_[right].find(b), left);
  ++flips_;
  for (const std::uint32_t v : {a, b, left, right}) mark(v);
  suspect(a, left);
  suspect(a, right);
  suspect(b, left);
  suspect(b, right);
  return true;
}

std::size_t StarMesh::legalize() {
  std::size_t flips = 0;
  while (!suspects_.empty()) {
    const auto [a, b] = suspects_.back();
    suspects_.pop_back();
    flips += try_flip(a, b) ? 1 : 0;
  }
  return flips;
}

std::size_t StarMesh::legalize_all(const Control& control) {
  std::size_t flips = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (i % 65536 == 0) control.check();
    for (int k = 0; k < stars_[i].degree; ++k)
      if (stars_[i].neighbor[k] > i) suspect(static_cast<std::uint32_t>(i), stars_[i].neighbor[k]);
    flips += legalize();
  }
  return flips;
}

// ---- marks

void StarMesh::mark_all() {
  std::fill(marks_.begin(), marks_.end(), ~std::uint64_t{0});
  if (size() % 64 != 0) marks_.back() = (std::uint64_t{1} << (size() % 64)) - 1;
}

bool StarMesh::any_marked() const {
  return std::any_of(marks_.begin(), marks_.end(), [](std::uint64_t word) { return word != 0; });
}

std::size_t StarMesh::take_marked(std::size_t from) {
  std::size_t word = from / 64;
  if (word >= marks_.size()) return size();
  std::uint64_t bits = marks_[word] >> (from % 64) << (from % 64);
  while (bits == 0) {
    if (++word == marks_.size()) return size();
    bits = marks_[word];
  }
  const int bit = std::countr_zero(bits);
  marks_[word] &= ~(std::uint64_t{1} << bit);
  return word * 64 + static_cast<std::size_t>(bit);
}

// ---- results

MeshRadii StarMesh::measure() const {
  double shortest2 = std::numeric_limits<double>::infinity(), outermost2 = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const Star& star = stars_[i];
    Vec2 a = offset(i, star.neighbor[star.degree - 1]);
    for (int k = 0; k < star.degree; ++k) {
      const Vec2 b = offset(i, star.neighbor[k]);
      shortest2 = std::min(shortest2, norm2(b));
      // Each triangle once a corner: the circumradius is |a| |b| |a - b| / (2 cross(a, b)).
      const double area2 = cross(a, b);
      outermost2 = std::max(outermost2, norm2(a) * norm2(b) * norm2(a - b) / (4 * area2 * area2));
      a = b;
    }
  }
  return {std::sqrt(shortest2), std::sqrt(outermost2)};
}

PointSet StarMesh::points(const PointSet& input) const {
  PointSet out = input;
  for (std::size_t i = 0; i < size(); ++i) {
    const Vec3 from = input[original_[i]];
    if (at_[i] == FixedPoint{to_fixed(from.x, width_), to_fixed(from.y, height_)}) continue;
    out.set(original_[i], {to_length(at_[i].x, width_), to_length(at_[i].y, height_), 0});
  }
  return out;
}

void StarMesh::restore(const Snapshot& snapshot) {
  at_ = snapshot.at;
  stars_ = snapshot.stars;
  std::fill(marks_.begin(), marks_.end(), 0);
  suspects_.clear();
}

}  // namespace wellspaced

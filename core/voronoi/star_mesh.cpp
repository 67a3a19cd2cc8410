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
#include "core/parallel.h"
#include "core/rng.h"
#include "core/voronoi/gift_wrap.h"
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

/// Every index on its own, on all threads.
template <class Work>
void for_each(std::size_t n, const Control& control, const Work& work) {
  constexpr std::size_t block = 1 << 16;
  parallel_blocks(n, block, control, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(i);
  });
}

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorCode::degenerate_input,
              why +
                  "; start from a point set that is spread over its domain, such as "
                  "poisson-disk gives, fill them with enrich, or use opt-beta");
}

}  // namespace

StarMesh::StarMesh(const PointSet& points, const Control& control) {
  require_usable(points, control);
  const Box box = points.domain->box();
  width_ = box.size.x;
  height_ = box.size.y;
  spacing_ = hexagonal_spacing(points.domain->area(), points.size());
  if (const auto why = why_too_small(*points.domain, points.size()))
    throw Error(ErrorCode::degenerate_input, *why);
  scale_ = {width_ / turn / spacing_, height_ / turn / spacing_};
  steps_ = {1 / scale_.x, 1 / scale_.y};
  build_stars(points, control);
  marks_ = Marks(size());
}

// Cocircular neighbors have no one triangulation: points are nudged, by far less than any target's margin.
constexpr double nudges[] = {0, 1e-7, 1e-6, 1e-5};

void StarMesh::build_stars(const PointSet& input, const Control& control) {
  LargeVector<FixedPoint> exact(input.size());
  const double* coordinates = input.coordinates.data();
  for_each(exact.size(), control, [&](std::size_t i) {
    exact[i] = {to_fixed(coordinates[2 * i], width_), to_fixed(coordinates[2 * i + 1], height_)};
  });
  for (const double nudge : nudges) {
    const bool mutual = place_in_grid_order(nudge > 0 ? shaken(exact, nudge) : exact, input.domain, control);
    if (mutual) return;
  }
  refuse("the points have no clear Delaunay triangulation");
}

/// Sets places and stars. Whether those are mutual.
bool StarMesh::place_in_grid_order(const LargeVector<FixedPoint>& points,
                                   const std::shared_ptr<const Domain>& domain, const Control& control) {
  GridOrder order = grid_order(to_points(points, domain, control), wrap_cell * spacing_, control);
  original_ = std::move(order.original);
  at_.resize(points.size());
  for_each(at_.size(), control, [&](std::size_t k) { at_[k] = points[original_[k]]; });
  cut_strips(order);
  if (auto wrapped = wrap_stars(order, control)) {
    stars_ = std::move(*wrapped);
    return true;
  }
  collect_stars(to_points(at_, domain, control), control);
  return is_mutual();
}

void StarMesh::rebuild(const PointSet& input, const Control& control) {
  Snapshot before = snapshot();
  try {
    for (const double nudge : nudges) {
      at_ = nudge > 0 ? shaken(before.at, nudge) : before.at;
      triangulate_places(input.domain, control);
      if (is_mutual()) return;
    }
    refuse("the points have no clear Delaunay triangulation");
  } catch (const Error&) {
    restore(before);
    throw;
  }
}

/// Sets the stars of places that have left their grid order.
void StarMesh::triangulate_places(const std::shared_ptr<const Domain>& domain, const Control& control) {
  const PointSet points = to_points(at_, domain, control);
  const GridOrder order = grid_order(points, wrap_cell * spacing_, control);
  const auto wrapped = wrap_stars(order, control);
  if (!wrapped) return collect_stars(points, control);
  for (std::size_t p = 0; p < wrapped->size(); ++p) {
    Star star = (*wrapped)[p];
    for (std::uint32_t& neighbor : star.neighbor) neighbor = order.original[neighbor];
    stars_[order.original[p]] = star;
  }
}

PointSet StarMesh::to_points(const LargeVector<FixedPoint>& places,
                             const std::shared_ptr<const Domain>& domain, const Control& control) const {
  PointSet points = points_to_set(domain, places.size(), control);
  for_each(places.size(), control, [&](std::size_t i) {
    points.coordinates[2 * i] = to_length(places[i].x, width_);
    points.coordinates[2 * i + 1] = to_length(places[i].y, height_);
  });
  return points;
}

std::optional<std::string> StarMesh::why_too_small(const Domain& domain, std::size_t n) {
  constexpr std::size_t fewest = 20;
  constexpr double thinnest = 4;
  if (n < fewest)
    return "this method needs at least 20 points; the set has " + std::to_string(n) +
           " (opt-beta takes fewer)";
  const Box box = domain.box();
  if (std::min(box.size.x, box.size.y) < thinnest * hexagonal_spacing(domain.area(), n))
    return "the torus is thinner than four times the mean spacing of its points, so that cells wrap around "
           "it; "
           "use more points or opt-beta";
  return std::nullopt;
}

Territory StarMesh::everywhere() const {
  const auto n = static_cast<std::uint32_t>(size());
  return {0, n, n};
}

void StarMesh::cut_strips(const GridOrder& order) {
  constexpr std::uint32_t rows_a_half = 2, most_strips = 64, word = 64;  // strips share no word of marks
  const auto n = static_cast<std::uint32_t>(order.size());
  const std::uint32_t strips = std::min(order.rows / (2 * rows_a_half), most_strips) / 2 * 2,
                      halves = 2 * strips;
  strips_ = {{0, n, everywhere()}};
  if (strips < 2) return;
  std::vector<std::uint32_t> at(halves + 1);
  for (std::uint32_t h = 0; h <= halves; ++h) {
    const std::uint64_t row = std::uint64_t{h} * order.rows / halves;
    at[h] = std::min(n, (order.start[row * order.columns] + word - 1) / word * word);
    if (h > 0 && at[h] == at[h - 1]) return;
  }
  at[0] = 0;
  strips_.clear();
  for (std::uint32_t h = 0; h < halves; h += 2) {
    const std::uint32_t low = at[(h + halves - 1) % halves], high = at[h + 2 == halves ? 1 : h + 3];
    strips_.push_back({at[h], at[h + 2], {low, high > low ? high - low : high + n - low, n}});
  }
}

LargeVector<FixedPoint> StarMesh::shaken(LargeVector<FixedPoint> points, double amount) const {
  Rng rng(0x5ba5e);
  const auto step = [&](double scale) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>((2 * rng.uniform() - 1) * amount / scale));
  };
  for (FixedPoint& p : points) {
    p.x += step(scale_.x);
    p.y += step(scale_.y);
  }
  return points;
}

/// The stars of points that are in grid order already, however they lie.
void StarMesh::collect_stars(const PointSet& points, const Control& control) {
  try {
    require_usable(points, control);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::degenerate_input) throw;
    refuse("two of the points are nearer to each other than a 2^32nd of the torus");
  }
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

bool StarMesh::is_positive() const {
  for (std::size_t i = 0; i < size(); ++i) {
    const Star& star = stars_[i];
    Vec2 a = offset(i, star.neighbor[star.degree - 1]);
    for (int k = 0; k < star.degree; ++k) {
      const Vec2 b = offset(i, star.neighbor[k]);
      if (!(cross(a, b) > 0)) return false;
      a = b;
    }
  }
  return true;
}

// ---- flips

/// Whether an edge can be told from its images: less than half around the torus.
bool StarMesh::is_short_way(Vec2 edge) const {
  return std::abs(edge.x) < turn / 2 * scale_.x && std::abs(edge.y) < turn / 2 * scale_.y;
}

namespace {

/// Whether `right` lies inside the circle through the point itself, b and `left`, counter-clockwise, by more
/// than rounding.
bool is_illegal(Vec2 b, Vec2 left, Vec2 right) {
  const double b2 = norm2(b), left2 = norm2(left), right2 = norm2(right);
  const double in_circle =
      right2 * cross(b, left) - right.x * (left.y * b2 - b.y * left2) - right.y * (b.x * left2 - left.x * b2);
  return in_circle < -1e-9 * b2 * b2;
}

}  // namespace

bool StarMesh::try_flip(std::uint32_t a, std::uint32_t b, Suspects& suspects) {
  Star& star = stars_[a];
  const int k = star.find(b);
  if (k == star.degree) return false;  // the edge is gone
  const std::uint32_t left = star.neighbor[star.after(k)], right = star.neighbor[star.before(k)];
  for (const std::uint32_t v : {b, left, right}) {
    if (suspects.territory.holds(v)) continue;
    suspects.put_off.push_back({a, b});
    return false;
  }
  const Vec2 to_b = offset(a, b), to_left = offset(a, left), to_right = offset(a, right);
  if (!is_illegal(to_b, to_left, to_right)) return false;
  if (stars_[left].degree >= Star::most || stars_[right].degree >= Star::most) return false;
  if (star.degree <= 3 || stars_[b].degree <= 3) return false;
  if (!(cross(to_right, to_left) > 0)) return false;  // the quadrilateral is not convex
  if (!(cross(to_right - to_b, to_left - to_b) < 0)) return false;
  if (!is_short_way(to_left - to_right)) return false;
  flip(a, k, suspects);
  return true;
}

/// Replaces the edge from a to its neighbor k by the other diagonal.
void StarMesh::flip(std::uint32_t a, int k, Suspects& suspects) {
  Star& star = stars_[a];
  const std::uint32_t b = star.neighbor[k], left = star.neighbor[star.after(k)],
                      right = star.neighbor[star.before(k)];
  star.erase(k);
  stars_[b].erase(stars_[b].find(a));
  stars_[left].insert_after(stars_[left].find(a), right);
  stars_[right].insert_after(stars_[right].find(b), left);
  ++suspects.flips;
  for (const std::uint32_t v : {a, b, left, right}) mark(v);
  suspects.add(a, left);
  suspects.add(a, right);
  suspects.add(b, left);
  suspects.add(b, right);
}

std::size_t StarMesh::legalize(Suspects& suspects) {
  std::size_t flips = 0;
  while (!suspects.edges.empty()) {
    const auto [a, b] = suspects.edges.back();
    suspects.edges.pop_back();
    flips += try_flip(a, b, suspects) ? 1 : 0;
  }
  return flips;
}

void StarMesh::legalize_strip(const Strip& strip, Suspects& suspects, const Control& control) {
  for (std::uint32_t i = strip.begin; i < strip.end; ++i) {
    if (i % 65536 == 0) control.check();
    const Star& star = stars_[i];
    Vec2 right = offset(i, star.neighbor[star.degree - 1]), middle = offset(i, star.neighbor[0]);
    for (int k = 0; k < star.degree; ++k) {
      const Vec2 left = offset(i, star.neighbor[star.after(k)]);
      if (star.neighbor[k] > i && is_illegal(middle, left, right)) suspects.add(i, star.neighbor[k]);
      right = middle;
      middle = left;
    }
    legalize(suspects);
  }
}

std::size_t StarMesh::legalize_all(const Control& control) {
  std::vector<Suspects> work;
  for (const Strip& strip : strips_) work.push_back({strip.territory});
  for (std::size_t color = 0; color < 2; ++color)
    parallel_blocks((strips_.size() + 1 - color) / 2, 1, control, [&](std::size_t k, std::size_t) {
      const std::size_t s = 2 * k + color;
      legalize_strip(strips_[s], work[s], control);
    });
  Suspects rest{everywhere()};
  for (const Suspects& suspects : work) {
    rest.edges.insert(rest.edges.end(), suspects.put_off.begin(), suspects.put_off.end());
    rest.flips += suspects.flips;
  }
  legalize(rest);
  return rest.flips;
}

// ---- results

PointSet StarMesh::points(const PointSet& input, const Control& control) const {
  PointSet out = input;
  for_each(size(), control, [&](std::size_t i) {
    const Vec3 from = input[original_[i]];
    if (at_[i] == FixedPoint{to_fixed(from.x, width_), to_fixed(from.y, height_)}) return;
    out.set(original_[i], {to_length(at_[i].x, width_), to_length(at_[i].y, height_), 0});
  });
  return out;
}

void StarMesh::restore(const Snapshot& snapshot) {
  at_ = snapshot.at;
  stars_ = snapshot.stars;
  marks_.clear();
}

}  // namespace wellspaced

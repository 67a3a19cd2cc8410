#include "core/mesh/star_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/domain/sphere.h"
#include "core/domain/surface_mesh.h"
#include "core/domain/torus.h"
#include "core/mesh/border_chains.h"
#include "core/mesh/too_coarse.h"
#include "core/voronoi/domain_star.h"
#include "core/voronoi/stars.h"

namespace wellspaced {
namespace {

std::int16_t whole_turns(double difference, double period) {
  return static_cast<std::int16_t>(std::lround(difference / period));
}

/// The points before and after each point of the border along it, as far as a curve's chain tells.
struct BorderNeighbors {
  std::uint32_t before = BorderChain::none, after = BorderChain::none;
};

std::vector<BorderNeighbors> border_neighbors(const PointSet& points) {
  std::vector<BorderNeighbors> all;
  for (const BorderChain& chain : border_chains(points)) {
    all.resize(points.size());
    const std::size_t count = chain.links.size();
    for (std::size_t k = 0; k + (chain.closed ? 0 : 1) < count; ++k) {
      const std::uint32_t a = chain.links[k].point, b = chain.links[(k + 1) % count].point;
      if (a == BorderChain::none || b == BorderChain::none || a == b) continue;
      all[a].after = b;
      all[b].before = a;
    }
  }
  return all;
}

/// The star of a point of the border begins with the point after it and ends with the one before it; what
/// lies between these is outside.
void bound_by_border(const MovingSet& set, std::size_t i, const BorderNeighbors& beside,
                     std::vector<StarMap::Spoke>& star) {
  if (beside.before == BorderChain::none || beside.after == BorderChain::none) return;
  for (const std::uint32_t j : {beside.after, beside.before}) {
    const auto is_it = [j](const StarMap::Spoke& s) { return s.id == j; };
    if (std::any_of(star.begin(), star.end(), is_it)) continue;
    std::vector<Neighbor> seen(1);
    seen[0].id = j;
    seen[0].offset = set[j] - set[i];
    set.domain().localize(set[i], HUGE_VAL, seen);
    StarMap::Spoke spoke;
    spoke.id = j;
    if (!seen.empty()) spoke.way = set.domain().way_to(set[i], seen.front());
    const auto gap =
        std::find_if(star.begin(), star.end(), [](const StarMap::Spoke& s) { return !s.closes; });
    star.insert(gap == star.end() ? gap : gap + 1, spoke);
  }
  for (std::size_t k = 0; k < star.size(); ++k) star[k].closes = star[k].id != beside.before;
}

}  // namespace

/// Whether a map is a surface like the domain's.
class TopologyCheck {
 public:
  TopologyCheck(const StarMap& map, const PointSet& points, const Control& control)
      : map_(map), points_(points), control_(control) {}

  void require() const {
    const auto* const mesh = dynamic_cast<const SurfaceMesh*>(points_.domain.get());
    const std::size_t parts = mesh != nullptr ? mesh->mesh().facts().components : 1;
    const std::size_t borders = mesh != nullptr ? mesh->mesh().facts().boundaries : 0;
    if (euler_characteristic() == points_.domain->euler_characteristic() && components() == parts &&
        map_.borders_ == borders && !has_slivers() && !is_turned_in())
      return;
    throw too_coarse(points_, control_);
  }

 private:
  int euler_characteristic() const {
    return static_cast<int>(map_.points()) - static_cast<int>(map_.spokes_.size() / 2) +
           static_cast<int>(map_.faces());
  }

  std::size_t components() const {
    std::vector<std::uint32_t> parents(map_.points());
    std::iota(parents.begin(), parents.end(), 0u);
    const auto root = [&](std::uint32_t v) {
      while (parents[v] != v) v = parents[v] = parents[parents[v]];
      return v;
    };
    std::size_t count = map_.points();
    for (std::uint32_t s = 0; s < map_.spokes_.size(); ++s) {
      const std::uint32_t a = root(map_.origin(s)), b = root(map_[s].id);
      if (a == b) continue;
      parents[std::max(a, b)] = std::min(a, b);
      --count;
    }
    return count;
  }

  bool has_slivers() const {
    for (std::size_t f = 0; f < map_.faces(); ++f)
      if (map_.face(f).size() < 3) return true;
    return map_.faces() == 0;
  }

  /// A face of a sphere whose circle is a quarter turn wide or more: all points are on one side of a plane
  /// through the center.
  bool is_turned_in() const {
    if (dynamic_cast<const Sphere*>(points_.domain.get()) == nullptr) return false;
    for (std::size_t f = 0; f < map_.faces(); ++f) {
      const auto at = [&](std::size_t k) { return points_[map_.origin(map_.face(f)[k])]; };
      if (!(dot(cross(at(1) - at(0), at(2) - at(0)), at(0)) > 0)) return true;
    }
    return false;
  }

  const StarMap& map_;
  const PointSet& points_;
  const Control& control_;
};

StarMap::StarMap(const PointSet& points, const Control& control) : is_torus_(is_torus(*points.domain)) {
  require_usable(points, control);
  Stars stars(points.size());
  if (is_torus_)
    collect_on_torus(points, control, stars);
  else
    collect_elsewhere(points, control, stars);
  keep(stars);
  find_twins();
  drop_lonely(control);
  for (trace(); cut_surplus(); trace()) drop_lonely(control);
  TopologyCheck(*this, points, control).require();
}

void StarMap::collect_on_torus(const PointSet& points, const Control& control, Stars& stars) const {
  const Vec3 size = points.domain->box().size;
  visit_stars(points, control, [&](std::size_t i, std::span<const wellspaced::Spoke> spokes) {
    for (const wellspaced::Spoke& s : spokes) {
      const Vec3 from = points[i], to = points[s.id];
      Spoke spoke;
      spoke.way = s.offset;
      spoke.id = s.id;
      spoke.turns_x = whole_turns(from.x + s.offset.x - to.x, size.x);
      spoke.turns_y = whole_turns(from.y + s.offset.y - to.y, size.y);
      stars[i].push_back(spoke);
    }
  });
}

void StarMap::collect_elsewhere(const PointSet& points, const Control& control, Stars& stars) const {
  const MovingSet set(points, control);
  const std::vector<BorderNeighbors> beside = border_neighbors(points);
  parallel_blocks(points.size(), 256, control, [&](std::size_t begin, std::size_t end) {
    CellFinder finder = set.finder(control);
    DomainStar star;
    for (std::size_t i = begin; i < end; ++i) {
      if (i % 16 == 0) control.check();
      star.load(set, i, finder);
      for (const DomainStar::Spoke& s : star.spokes()) {
        Spoke spoke;
        spoke.way = s.way;
        spoke.id = s.id;
        spoke.closes = s.closes;
        stars[i].push_back(spoke);
      }
      if (!beside.empty() && set.freedom(i).dimensions < 2) bound_by_border(set, i, beside[i], stars[i]);
    }
  });
}

void StarMap::keep(Stars& stars) {
  first_.assign(1, 0);
  for (std::vector<Spoke>& star : stars) {
    spokes_.insert(spokes_.end(), star.begin(), star.end());
    first_.push_back(static_cast<std::uint32_t>(spokes_.size()));
    std::vector<Spoke>().swap(star);
  }
  number_owners();
}

void StarMap::number_owners() {
  owner_.resize(spokes_.size());
  for (std::size_t i = 0; i < points(); ++i)
    std::fill(owner_.begin() + begin(i), owner_.begin() + end(i), static_cast<std::uint32_t>(i));
}

bool StarMap::has_edge(std::size_t i, std::uint32_t j) const {
  return std::any_of(spokes_.begin() + begin(i), spokes_.begin() + end(i),
                     [j](const Spoke& spoke) { return spoke.id == j; });
}

std::uint32_t StarMap::previous(std::uint32_t s) const {
  const std::uint32_t i = owner_[s];
  return s == begin(i) ? end(i) - 1 : s - 1;
}

std::uint32_t StarMap::next(std::uint32_t s) const {
  const std::uint32_t i = owner_[s];
  return s + 1 == end(i) ? begin(i) : s + 1;
}

/// The neighbor may know several ways back: on the torus the image tells, else what lies beside it, and how
/// long it is.
std::uint32_t StarMap::twin_of(std::uint32_t s) const {
  const Spoke& spoke = spokes_[s];
  const std::uint32_t i = owner_[s];
  std::uint32_t best = none;
  double least = HUGE_VAL;
  for (std::uint32_t t = begin(spoke.id); t < end(spoke.id); ++t) {
    const Spoke& back = spokes_[t];
    if (back.id != i) continue;
    if (is_torus_) {
      if (back.turns_x == -spoke.turns_x && back.turns_y == -spoke.turns_y && t != s) return t;
      continue;
    }
    const double length = norm(spoke.way), other = norm(back.way);
    double badness = std::fabs(length - other) / std::max(length, other);
    if (badness > 1e-6) badness += 4;
    badness += spokes_[next(s)].id != spokes_[previous(t)].id;
    badness += spokes_[previous(s)].id != spokes_[next(t)].id;
    if (badness >= least) continue;
    least = badness;
    best = t;
  }
  return best;
}

void StarMap::find_twins() {
  for (std::uint32_t s = 0; s < spokes_.size(); ++s) spokes_[s].twin = twin_of(s);
  for (std::uint32_t s = 0; s < spokes_.size(); ++s)
    if (spokes_[s].twin != none && spokes_[spokes_[s].twin].twin != s) spokes_[s].twin = none;
}

/// Of spokes without a twin; the wedges on both of their sides become one.
void StarMap::drop_lonely(const Control& control) {
  std::vector<std::uint32_t> numbers(spokes_.size(), none);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < points(); ++i) {
    if (i % 4096 == 0) control.check();
    for (std::uint32_t s = begin(i); s < end(i); ++s) {
      if (spokes_[s].twin != none) {
        numbers[s] = kept++;
        continue;
      }
      if (spokes_[s].closes) continue;
      for (std::uint32_t before = previous(s); before != s; before = previous(before)) {
        spokes_[before].closes = false;
        if (spokes_[before].twin != none) break;
      }
    }
  }
  if (kept == spokes_.size()) return;
  std::vector<std::uint32_t> first(1, 0);
  for (std::size_t i = 0; i < points(); ++i) {
    std::uint32_t count = first.back();
    for (std::uint32_t s = begin(i); s < end(i); ++s)
      if (numbers[s] != none) {
        spokes_[numbers[s]] = spokes_[s];
        ++count;
      }
    first.push_back(count);
  }
  spokes_.resize(kept);
  first_ = std::move(first);
  for (Spoke& spoke : spokes_) spoke.twin = numbers[spoke.twin];
  number_owners();
}

bool StarMap::is_longer(std::uint32_t s, std::uint32_t other) const {
  const double a = norm2(spokes_[s].way), b = norm2(spokes_[other].way);
  return a != b ? a > b : s < other;
}

void StarMap::cut(std::uint32_t s) {
  spokes_[spokes_[s].twin].twin = none;
  spokes_[s].twin = none;
}

bool StarMap::cut_surplus() { return cut_crossing() || (!is_torus_ && cut_double()); }

/// Where four points are about on one circle, both pairs that lie across may take themselves for neighbors.
/// Then the face between the four goes along these edges in both directions. The longer one is cut, and so is
/// one of two edges with nothing between them.
bool StarMap::cut_crossing() {
  bool any = false;
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    std::uint32_t longest = none;
    for (const std::uint32_t s : face(f)) {
      if (spokes_[s].twin == none) continue;  // cut just now
      const bool is_too_many = spokes_[spokes_[s].twin].face == f || face(f).size() == 2;
      if (is_too_many && (longest == none || is_longer(s, longest))) longest = s;
    }
    if (longest == none) continue;
    cut(longest);
    any = true;
  }
  return any;
}

/// Around a vertex with less than half a turn, two points that are joined past both sides of it have one more
/// behind it, which sees only the two.
bool StarMap::cut_double() {
  bool any = false;
  for (std::uint32_t i = 0; i < points(); ++i)
    for (std::uint32_t s = begin(i); s < end(i); ++s)
      for (std::uint32_t t = s + 1; t < end(i); ++t) {
        if (spokes_[s].id != spokes_[t].id || spokes_[s].twin == none || spokes_[t].twin == none) continue;
        cut(is_longer(s, t) ? s : t);
        any = true;
      }
  return any;
}

void StarMap::trace() {
  faces_.clear();
  face_spokes_.clear();
  borders_ = 0;
  for (Spoke& spoke : spokes_) spoke.face = none;
  std::vector<bool> seen(spokes_.size(), false);
  std::vector<std::uint32_t> around;
  for (std::uint32_t s = 0; s < spokes_.size(); ++s) {
    if (seen[s]) continue;
    around.clear();
    bool closes = true;
    std::uint32_t at = s;
    do {
      seen[at] = true;
      closes = closes && spokes_[at].closes;
      around.push_back(at);
      at = around_face(at);
    } while (at != s);
    if (!closes) {
      ++borders_;
      continue;
    }
    const auto f = static_cast<std::uint32_t>(faces_.size());
    for (const std::uint32_t spoke : around) spokes_[spoke].face = f;
    faces_.push_back(
        {static_cast<std::uint32_t>(face_spokes_.size()), static_cast<std::uint32_t>(around.size())});
    face_spokes_.insert(face_spokes_.end(), around.begin(), around.end());
  }
}

}  // namespace wellspaced

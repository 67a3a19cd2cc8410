#include "core/domain/geodesic_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/domain/straight_way.h"
#include "core/math.h"

namespace wellspaced {
namespace {

constexpr double nudge = 1e-9;  ///< how far, as weights, the apex keeps from the edges of its face
constexpr double grazing =
    1e-12;  ///< of a ray's length: passing a vertex or a target so closely is hitting it
constexpr double no_angle = 1e-13;  ///< radians
constexpr double many_faces = 150;  ///< within reach: to look everywhere takes longer than to aim
constexpr double windows_a_face = 4;
constexpr double many_times = 4;  ///< the area of the mesh, within reach
constexpr double proof = 1e-10;   ///< relative: how much shorter a way would have to be to be worth a look
constexpr double improvement = 1e-14;  ///< relative, of a way that only rounding makes shorter

double size1(Vec2 v) { return std::fabs(v.x) + std::fabs(v.y); }

/// Where the ray from `apex` meets the line through a in direction e.
Vec2 meet(Vec2 apex, Vec2 ray, Vec2 a, Vec2 e) { return apex + (cross(a - apex, e) / cross(ray, e)) * ray; }

/// Squared distance from the apex to the part of an edge between two rays.
double nearest2(Vec2 apex, Vec2 right, Vec2 edge, Vec2 right_ray, Vec2 left_ray) {
  const double area = cross(right - apex, edge);
  const Vec2 normal{edge.y, -edge.x};
  if (cross(right_ray, normal) < 0) {
    const double t = area / cross(right_ray, edge);
    return t * t * norm2(right_ray);
  }
  if (cross(normal, left_ray) < 0) {
    const double t = area / cross(left_ray, edge);
    return t * t * norm2(left_ray);
  }
  return area * area / norm2(edge);
}

inline bool between(Vec2 right_ray, Vec2 left_ray, Vec2 v) {
  const double slack = -grazing * size1(v);
  return cross(right_ray, v) >= slack * size1(right_ray) && cross(v, left_ray) >= slack * size1(left_ray);
}

std::size_t hash(std::uint32_t face, std::size_t mask) { return (face * 2654435761u >> 7) & mask; }

}  // namespace

GeodesicSearch::GeodesicSearch(const Unfolding& unfolding, const MeshPlace& base, double reach)
    : unfolding_(&unfolding),
      mesh_(&unfolding.mesh()),
      base_(base),
      reach_(reach),
      limit_(reach),
      corners_(unfolding.corners_around(base)) {
  if (*std::min_element(base.weights.begin(), base.weights.end()) < nudge)
    apex_ = nudge * (corners_[0] + corners_[1] + corners_[2]);
  slack_ = norm(apex_);
}

void GeodesicSearch::run(Border border, std::size_t enough, Images images) {
  border_ = border;
  collects_images_ = images == Images::collect;
  if (targets_.empty() && border == Border::ignore) return;
  hash_targets();
  const Vec3 a = mesh_->corner(base_.face, 0);
  const double face = norm(cross(mesh_->corner(base_.face, 1) - a, mesh_->corner(base_.face, 2) - a)) / 2;
  if (border == Border::ignore && !collects_images_ && targets_.size() <= most_aimed &&
      pi * reach_ * reach_ > many_faces * face)
    aim_at_targets();
  const double times = pi * limit_ * limit_ / mesh_->facts().area;
  const bool winds_around = times > many_times && border == Border::ignore && !collects_images_;
  const double windows = windows_a_face * times * static_cast<double>(mesh_->faces().size());
  if (winds_around || windows > static_cast<double>(enough)) enough = 0;
  if (!run_in_any_order(enough)) run_nearest_first();
}

std::vector<GeodesicSearch::VertexView> GeodesicSearch::sharp_vertices(double angle) {
  sharp_ = angle;
  run(Border::look);
  std::sort(sharp_vertices_.begin(), sharp_vertices_.end(), [](const VertexView& a, const VertexView& b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex : norm2(a.at) < norm2(b.at);
  });
  const auto same = [](const VertexView& a, const VertexView& b) { return a.vertex == b.vertex; };
  sharp_vertices_.erase(std::unique(sharp_vertices_.begin(), sharp_vertices_.end(), same),
                        sharp_vertices_.end());
  return std::move(sharp_vertices_);
}

/// Ways that are found so are no proof that there is no shorter one, but few windows can still lead to one.
void GeodesicSearch::aim_at_targets() {
  is_aimed_ = true;
  double longest = 0;
  for (Target& target : targets_) {
    target.position = unfolding_->position(target.place);
    if (const auto way = aim(*unfolding_, base_, target.place)) {
      target.bound = way->length;
      if (way->vector) improve(target, way->length, *way->vector);
    }
    longest = std::max(longest, target.bound);
  }
  limit_ = std::min(limit_, longest * (1 + proof));
}

void GeodesicSearch::hash_targets() {
  const std::size_t size = std::bit_ceil(2 * targets_.size() + 2), mask = size - 1;
  faces_with_targets_.assign(size, {none, none});
  for (std::uint32_t k = 0; k < targets_.size(); ++k) {
    const std::uint32_t face = targets_[k].place.face;
    std::size_t at = hash(face, mask);
    while (faces_with_targets_[at][0] != none && faces_with_targets_[at][0] != face) at = (at + 1) & mask;
    faces_with_targets_[at][0] = face;
    targets_[k].next = faces_with_targets_[at][1];
    faces_with_targets_[at][1] = k;
  }
}

bool GeodesicSearch::run_in_any_order(std::size_t enough) {
  windows_.reserve(32);
  known_.assign(32, {});
  start();
  for (std::size_t count = 0; !windows_.empty(); ++count) {
    if (count == enough) return false;
    const Window w = windows_.back();
    windows_.pop_back();
    go_on(w);
  }
  return true;
}

void GeodesicSearch::run_nearest_first() {
  nearest_first_ = true;
  windows_.clear();
  views_.clear();
  images_.clear();
  for (Target& target : targets_) target.image = none;
  sharp_vertices_.clear();
  vertex_distance_.assign(mesh_->vertices().size(), unreached);
  start();
  while (!queue_.empty() && queue_.front().nearest <= limit_ + slack_) {
    std::pop_heap(queue_.begin(), queue_.end());
    const std::uint32_t slot = queue_.back().slot;
    queue_.pop_back();
    const Window w = windows_[slot];
    free_slots_.push_back(slot);
    const bool outdated = w.half_edge == none && w.nearest > vertex_distance_[bends_[w.bend].vertex];
    if (!outdated) go_on(w);
  }
}

void GeodesicSearch::start() {
  const std::uint32_t h = 3 * base_.face;
  bends_.assign(1, {});
  Window w;
  for (std::uint32_t k = 0; k < 3; ++k)
    see_vertex(w, h + k, corners_[k], corners_[(k + 1) % 3] - corners_[k]);
  enter(w, h, corners_);  // without rays, so all of it
  for (std::uint32_t k = 0; k < 3; ++k) {
    w = {};
    w.half_edge = h + k;
    w.right = corners_[k];
    w.left = corners_[(k + 1) % 3];
    w.right_ray = w.right - apex_;
    w.left_ray = w.left - apex_;
    push(w, corners_[(k + 2) % 3]);
  }
}

void GeodesicSearch::go_on(const Window& w) {
  if (w.half_edge != none) {
    cross_edge(w);
    return;
  }
  const auto [before, first, vertex, back] = bends_[w.bend];
  const double around = unfolding_->angle_around(vertex);
  if (mesh_->at_border(vertex)) {
    leave(w, 0, back - pi);
    leave(w, back + pi, around);
  } else {
    leave(w, back + pi, back + around - pi);
    leave(w, back + pi - around, back - pi);
  }
}

void GeodesicSearch::cross_edge(const Window& w) {
  const std::uint32_t h = mesh_->twin(w.half_edge);  // from left to right
  if (h == none) {
    if (border_ == Border::look && w.bend == 0) {
      const Vec2 edge = w.left - w.right;
      views_.push_back({meet(apex_, w.right_ray, w.right, edge), meet(apex_, w.left_ray, w.right, edge)});
    }
    return;
  }
  const Vec2 tip = unfolding_->tip(h, w.left, w.right), to = tip - apex_of(w);
  enter(w, h, {w.left, w.right, tip});
  if (between(w.right_ray, w.left_ray, to)) see_vertex(w, TriangleMesh::previous(h), tip, w.left - tip);
  const bool right_of_tip = cross(w.right_ray, to) > 0, left_of_tip = cross(to, w.left_ray) > 0;
  if (right_of_tip) {
    Window child{TriangleMesh::next(h),         w.bend, w.right, tip, w.right_ray,
                 left_of_tip ? to : w.left_ray, 0,      w.wanted};
    push(child, w.left);
  }
  if (left_of_tip) {
    Window child{TriangleMesh::previous(h),       w.bend,     tip, w.left,
                 right_of_tip ? to : w.right_ray, w.left_ray, 0,   w.wanted};
    push(child, w.right);
  }
}

/// Looks for targets in the face of h, whose corners lie like that from the origin of h on.
void GeodesicSearch::enter(const Window& w, std::uint32_t h, const std::array<Vec2, 3>& corners) {
  const std::uint32_t face = TriangleMesh::face_of(h);
  const std::size_t mask = faces_with_targets_.size() - 1;
  std::size_t slot = hash(face, mask);
  while (faces_with_targets_[slot][0] != face) {
    if (faces_with_targets_[slot][0] == none) return;
    slot = (slot + 1) & mask;
  }
  const Bend& bend = bends_[w.bend];
  for (std::uint32_t k = faces_with_targets_[slot][1]; k != none; k = targets_[k].next) {
    const auto& weights = targets_[k].place.weights;
    const std::size_t first = h % 3;
    const Vec2 at = weights[first] * corners[0] + weights[(first + 1) % 3] * corners[1] +
                    weights[(first + 2) % 3] * corners[2];
    if (!between(w.right_ray, w.left_ray, at - apex_of(w))) continue;
    const double distance = bend.before + norm(at);
    if (collects_images_ && w.bend == 0 && distance <= reach_) collect(k, at);
    improve(targets_[k], distance, w.bend == 0 ? at : distance * bend.first);
  }
}

/// Two windows that meet at a target both see it.
void GeodesicSearch::collect(std::uint32_t target, Vec2 at) {
  constexpr double same = 1e-9;
  for (std::uint32_t k = targets_[target].image; k != none; k = images_[k].earlier)
    if (size1(images_[k].vector - at) <= same * size1(at)) return;
  images_.push_back(
      {target, at, std::exchange(targets_[target].image, static_cast<std::uint32_t>(images_.size()))});
}

void GeodesicSearch::improve(Target& target, double distance, Vec2 vector) {
  if (distance > reach_ || distance >= target.distance * (1 - improvement)) return;
  if (target.distance == unreached) ++found_;
  target.distance = distance;
  target.bound = std::min(target.bound, distance);
  target.vector = vector;
  if (found_ < targets_.size() || border_ == Border::look || collects_images_) return;
  limit_ = 0;
  for (const Target& t : targets_) limit_ = std::max(limit_, t.distance);
}

/// The origin of h lies `at` there, in sight, and h leads `along` from it.
void GeodesicSearch::see_vertex(const Window& w, std::uint32_t h, Vec2 at, Vec2 along) {
  const std::uint32_t vertex = mesh_->origin(h);
  if (w.bend == 0 && unfolding_->missing_angle(vertex) > sharp_ && norm2(at) <= reach_ * reach_)
    sharp_vertices_.push_back({vertex, at});
  const bool bends = unfolding_->bends_ways(vertex);
  if (!bends && !nearest_first_) return;
  const double distance = bends_[w.bend].before + norm(at);
  if (distance > limit_ || !is_news(vertex, distance) || !bends) return;
  const Vec2 back = apex_of(w) - at;
  const double angle = std::max(0.0, portable_atan2(cross(along, back), dot(along, back)));
  add({distance, w.bend == 0 ? (-1 / norm(back)) * back : bends_[w.bend].first, vertex,
       unfolding_->angle_to(h) + angle},
      w.wanted);
}

/// Whether no way as short to the vertex is known so far; it is then.
bool GeodesicSearch::is_news(std::uint32_t vertex, double distance) {
  if (nearest_first_) {
    if (distance >= vertex_distance_[vertex] * (1 - improvement)) return false;
    vertex_distance_[vertex] = distance;
    return true;
  }
  Known* known = find_known(vertex);
  if (distance >= known->distance * (1 - improvement)) return false;
  if (known->vertex == none && 2 * ++known_count_ > known_.size()) {
    std::vector<Known> all(4 * known_.size());
    all.swap(known_);
    for (const Known& old : all)
      if (old.vertex != none) *find_known(old.vertex) = old;
    known = find_known(vertex);
  }
  *known = {vertex, distance};
  return true;
}

/// The vertex's entry, or the empty one that it may have.
GeodesicSearch::Known* GeodesicSearch::find_known(std::uint32_t vertex) {
  const std::size_t mask = known_.size() - 1;
  std::size_t slot = hash(vertex, mask);
  while (known_[slot].vertex != none && known_[slot].vertex != vertex) slot = (slot + 1) & mask;
  return &known_[slot];
}

void GeodesicSearch::add(const Bend& bend, std::uint64_t wanted) {
  Window w;
  w.bend = static_cast<std::uint32_t>(bends_.size());
  w.nearest = bend.before;
  w.wanted = wanted;
  bends_.push_back(bend);
  put(w);
}

/// Goes on from a vertex in the directions between two angles around it, as far as there are faces.
void GeodesicSearch::leave(const Window& bend, double low, double high) {
  if (high < low || high < 0) return;
  std::uint32_t h = mesh_->first_out(bends_[bend.bend].vertex);
  const std::uint32_t first = h;
  do {
    const double begin = unfolding_->angle_to(h), size = unfolding_->angle_at(h);
    if (low <= begin + size && high >= begin) leave_through(bend, h, low - begin, high - begin);
    h = mesh_->turn_left(h);
  } while (h != none && h != first);
}

/// The same in the face of h, which starts at the vertex; angles from h.
void GeodesicSearch::leave_through(const Window& bend, std::uint32_t h, double low, double high) {
  const std::uint32_t after = TriangleMesh::next(h), last = TriangleMesh::previous(h);
  Window w = bend;
  w.half_edge = after;
  w.right = {norm(mesh_->vertices()[mesh_->target(h)] - mesh_->vertices()[mesh_->origin(h)]), 0};
  w.left = unfolding_->tip(h, {}, w.right);
  const auto ray = [](double angle) {
    const CosSin turned = portable_cos_sin(angle / (2 * pi));
    return Vec2{turned.cos, turned.sin};
  };
  const bool whole_right = low <= no_angle, whole_left = high >= unfolding_->angle_at(h) - no_angle;
  w.right_ray = whole_right ? w.right : ray(low);
  w.left_ray = whole_left ? w.left : ray(high);
  enter(w, h, {Vec2{}, w.right, w.left});
  push(w, {});
  if (whole_right)
    follow_edge(mesh_->origin(after), unfolding_->angle_to(after) + unfolding_->angle_at(after), w,
                norm(w.right));
  if (whole_left) follow_edge(mesh_->origin(last), unfolding_->angle_to(last), w, norm(w.left));
}

/// To the vertex at the other end of an edge out of a bend.
void GeodesicSearch::follow_edge(std::uint32_t vertex, double back, const Window& w, double length) {
  const auto [before, first, from, unused] = bends_[w.bend];
  const bool bends = unfolding_->bends_ways(vertex);
  if (before + length > limit_ || !(bends || nearest_first_)) return;
  if (is_news(vertex, before + length) && bends) add({before + length, first, vertex, back}, w.wanted);
}

/// Keeps the window if it can matter; `across`: the third corner of the face that it leaves.
void GeodesicSearch::push(Window& w, Vec2 across) {
  const Vec2 edge = w.left - w.right;
  const double d2 = nearest2(apex_of(w), w.right, edge, w.right_ray, w.left_ray);
  const double before = bends_[w.bend].before, left = limit_ + slack_ - before;
  if (!(left >= 0 && d2 <= left * left)) return;
  if (is_aimed_ && (w.wanted = still_wanted(w)) == 0) return;
  if (nearest_first_) {
    if (cannot_be_shortest(w, across)) return;
    w.nearest = before + std::sqrt(d2);
  }
  put(w);
}

/// Those of the window's targets that may be nearer over it than is known. No way from a point of the edge to
/// the target is shorter than the straight line, and that is as long in the window's plane, the target turned
/// into it.
std::uint64_t GeodesicSearch::still_wanted(const Window& w) const {
  const Vec3 a = mesh_->vertices()[mesh_->origin(w.half_edge)];
  const Vec3 edge = mesh_->vertices()[mesh_->target(w.half_edge)] - a;
  const Vec2 from = apex_of(w), flat = w.left - w.right;
  const double per_length2 = 1 / norm2(edge), before = bends_[w.bend].before;
  std::uint64_t wanted = 0;
  for (std::uint64_t open = w.wanted; open != 0; open &= open - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(open));
    if (k >= targets_.size()) break;
    const Vec3 to = targets_[k].position - a;
    const double along = dot(to, edge) * per_length2, away = norm(cross(to, edge)) * per_length2;
    const Vec2 q = w.right + along * flat + away * Vec2{flat.y, -flat.x}, straight = q - from;
    const double left = std::min(targets_[k].bound, reach_) * (1 + proof) + slack_ - before;
    double length = norm(straight);
    if (length <= left) {
      const bool right_of = cross(w.right_ray, straight) < 0, left_of = cross(straight, w.left_ray) < 0;
      if (right_of || left_of) {
        const Vec2 end = meet(from, right_of ? w.right_ray : w.left_ray, w.right, flat);
        length = norm(end - from) + norm(q - end);
      }
    }
    if (length <= left) wanted |= open & -open;
  }
  return wanted;
}

/// Where a way over a corner of the face to the far end of the window is shorter than the window's, so is one
/// to each of its points.
bool GeodesicSearch::cannot_be_shortest(const Window& w, Vec2 across) const {
  const Vec2 from = apex_of(w), edge = w.left - w.right;
  const Vec2 right = meet(from, w.right_ray, w.right, edge), left = meet(from, w.left_ray, w.right, edge);
  const double before = bends_[w.bend].before;
  const double most_right = (before + norm(right)) * (1 - grazing);  // not from the apex, as all distances
  const double most_left = (before + norm(left)) * (1 - grazing);
  const auto by = [&](std::uint32_t h, Vec2 corner, Vec2 end) {
    return vertex_distance_[mesh_->origin(h)] + norm(end - corner);
  };
  if (by(w.half_edge, w.right, left) < most_left) return true;
  if (by(TriangleMesh::next(w.half_edge), w.left, right) < most_right) return true;
  const std::uint32_t third = TriangleMesh::previous(w.half_edge);
  if (cross(w.left_ray, across - from) > 0) return by(third, across, right) < most_right;
  return cross(across - from, w.right_ray) > 0 && by(third, across, left) < most_left;
}

void GeodesicSearch::put(const Window& w) {
  if (!nearest_first_) {
    windows_.push_back(w);
    return;
  }
  std::uint32_t slot = static_cast<std::uint32_t>(windows_.size());
  if (free_slots_.empty()) {
    windows_.push_back(w);
  } else {
    slot = free_slots_.back();
    free_slots_.pop_back();
    windows_[slot] = w;
  }
  queue_.push_back({w.nearest, pushed_++, slot});
  std::push_heap(queue_.begin(), queue_.end());
}

}  // namespace wellspaced

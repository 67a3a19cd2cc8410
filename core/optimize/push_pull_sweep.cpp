#include "core/optimize/push_pull_sweep.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/parallel.h"

#ifndef WELLSPACED_STRIP_WORK
#define WELLSPACED_STRIP_WORK
namespace wellspaced {

/// One strip's part of a sweep.
struct StripWork {
  Strip strip;
  Suspects suspects;
  std::vector<std::uint32_t> put_off;  ///< points with neighbors beyond the strip's territory
  SweepCounts counts;
};

}  // namespace wellspaced
#endif

// This file is compiled once for every kind of vector unit; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/optimize/push_pull_sweep.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {

constexpr float margin = 1.001f;  // aim a little past the targets, so that points settle
constexpr float longest_step = 0.2f;
constexpr float thinnest = 1e-3f;  // twice the area that a triangle must keep
constexpr float illegal = -1e-5f;  // in-circle test in float: below this it is not rounding

/// The star of one point as arrays of W lanes, so that the compiler makes vectors of them. Lanes past the
/// degree repeat the first neighbor; place 0 and place W + 1 hold the last and the first one again.
template <int W>
struct Lanes {
  alignas(64) float x[W + 2], y[W + 2], d2[W + 2];  // neighbors: offset and squared distance, lane k at k + 1
  alignas(64) float cx[W], cy[W], r2[W], area[W];   // triangle k, between neighbors k and k + 1

  void close(int degree) {
    x[0] = x[degree];
    y[0] = y[degree];
    x[W + 1] = x[1];
    y[W + 1] = y[1];
  }

  void load(const StarMesh& mesh, std::size_t i) {
    const Star& star = mesh.star(i);
    const FixedPoint here = mesh.at(i);
    const float sx = static_cast<float>(mesh.scale().x), sy = static_cast<float>(mesh.scale().y);
    for (int k = 0; k < W; ++k) {
      const FixedPoint there = mesh.at(star.neighbor[k < Star::most ? k : 0]);
      x[k + 1] = static_cast<float>(static_cast<std::int32_t>(there.x - here.x)) * sx;
      y[k + 1] = static_cast<float>(static_cast<std::int32_t>(there.y - here.y)) * sy;
    }
    close(star.degree);
  }

  void shift_from(const Lanes& other, float dx, float dy) {
    for (int k = 0; k < W + 2; ++k) x[k] = other.x[k] - dx;
    for (int k = 0; k < W + 2; ++k) y[k] = other.y[k] - dy;
  }

  void evaluate() {
    for (int k = 0; k < W + 2; ++k) d2[k] = x[k] * x[k] + y[k] * y[k];
    for (int k = 0; k < W; ++k) {
      const float ax = x[k + 1], ay = y[k + 1], a2 = d2[k + 1], bx = x[k + 2], by = y[k + 2], b2 = d2[k + 2];
      area[k] = ax * by - ay * bx;
      const float h = 0.5f / area[k];
      cx[k] = h * (by * a2 - ay * b2);
      cy[k] = h * (ax * b2 - bx * a2);
      r2[k] = cx[k] * cx[k] + cy[k] * cy[k];
    }
  }

  /// One bit a lane where `test(k)` holds.
  template <class Test>
  static std::uint32_t bits(int degree, const Test& test) {
    std::uint32_t found = 0;
    for (int k = 0; k < W; ++k) found |= static_cast<std::uint32_t>(test(k)) << k;
    return found & ((1u << degree) - 1);
  }
};

template <class Use>
void for_each_bit(std::uint32_t bits, const Use& use) {
  for (; bits != 0; bits &= bits - 1) use(std::countr_zero(bits));
}

template <int W>
class Visit {
 public:
  Visit(StarMesh& mesh, std::size_t i, const PushPull& t, Suspects& suspects)
      : mesh_(mesh),
        suspects_(suspects),
        i_(i),
        t_(t),
        r_f_(static_cast<float>(t.r_f)),
        r_c_(static_cast<float>(t.r_c)),
        r_f2_(r_f_ * r_f_),
        r_c2_(r_c_ * r_c_) {}

  /// Nothing if flips left the point with more neighbors than there are lanes.
  /// Else whether the point moved.
  std::optional<bool> run() {
    if (!settle()) return std::nullopt;
    if ((near_ | far_) == 0) return false;
    Vec2f move = displacement();
    if (!shorten(move)) return false;
    commit(move);
    return true;
  }

 private:
  struct Vec2f {
    float x, y;
  };

  /// Looks at the star and flips, until there is nothing to flip (or it goes on too long).
  bool settle() {
    constexpr int most_rounds = 4;
    for (int round = 0; mesh_.star(i_).degree <= W; ++round) {
      degree_ = mesh_.star(i_).degree;
      now_.load(mesh_, i_);
      now_.evaluate();
      look(now_);
      if (round == most_rounds) return true;
      suspect_spokes();
      if (mesh_.legalize(suspects_) > 0) continue;
      if (!t_.look_across || far_ == 0) return true;
      const Star& star = mesh_.star(i_);
      for_each_bit(far_, [&](int k) { suspects_.add(star.neighbor[k], star.neighbor[star.after(k)]); });
      if (mesh_.legalize(suspects_) == 0) return true;
    }
    return false;
  }

  /// Spoke k is illegal where the neighbor before it (at place k) lies inside the circle of triangle k.
  void suspect_spokes() {
    const auto inside = [&](int k) {
      return now_.d2[k] - 2 * (now_.x[k] * now_.cx[k] + now_.y[k] * now_.cy[k]) < illegal;
    };
    for_each_bit(Lanes<W>::bits(degree_, inside),
                 [&](int k) { suspects_.add(static_cast<std::uint32_t>(i_), mesh_.star(i_).neighbor[k]); });
  }

  void look(const Lanes<W>& lanes) {
    near_ = Lanes<W>::bits(degree_, [&](int k) { return lanes.d2[k + 1] < r_f2_; });
    far_ = Lanes<W>::bits(degree_, [&](int k) { return r_c2_ < lanes.r2[k]; });
  }

  Vec2f displacement() const {
    Vec2f sum{0, 0};
    const float push = static_cast<float>(t_.push), pull = static_cast<float>(t_.pull);
    for_each_bit(near_, [&](int k) {
      const float d = std::sqrt(now_.d2[k + 1]), weight = push * (d - r_f_ * margin) / d;
      sum = {sum.x + weight * now_.x[k + 1], sum.y + weight * now_.y[k + 1]};
    });
    for_each_bit(far_, [&](int k) {
      const float r = std::sqrt(now_.r2[k]), weight = pull * (r - r_c_ / margin) / r;
      sum = {sum.x + weight * now_.cx[k], sum.y + weight * now_.cy[k]};
    });
    const float length2 = sum.x * sum.x + sum.y * sum.y;
    if (length2 <= longest_step * longest_step) return sum;
    const float shrink = longest_step / std::sqrt(length2);
    return {sum.x * shrink, sum.y * shrink};
  }

  /// Halves the step until all triangles keep some area; leaves what they then are in next_.
  bool shorten(Vec2f& move) {
    constexpr int most_halvings = 4;
    for (int halvings = 0;; ++halvings) {
      next_.shift_from(now_, move.x, move.y);
      next_.evaluate();
      if (Lanes<W>::bits(degree_, [&](int k) { return next_.area[k] < thinnest; }) == 0) return true;
      if (halvings == most_halvings) return false;
      move = {move.x * 0.5f, move.y * 0.5f};
    }
  }

  void commit(Vec2f move) {
    const auto steps = [](float length, double scale) {
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(static_cast<double>(length) / scale));
    };
    const FixedPoint from = mesh_.at(i_);
    mesh_.move_to(i_, {from.x + steps(move.x, mesh_.scale().x), from.y + steps(move.y, mesh_.scale().y)});
    look(next_);
    if ((near_ | far_) == 0) return;
    mesh_.mark(i_);
    const std::uint32_t beyond = ((far_ << 1) | (far_ >> (degree_ - 1))) & ((1u << degree_) - 1);
    for_each_bit(near_ | far_ | beyond, [&](int k) { mesh_.mark(mesh_.star(i_).neighbor[k]); });
  }

  StarMesh& mesh_;
  Suspects& suspects_;
  const std::size_t i_;
  const PushPull& t_;
  const float r_f_, r_c_, r_f2_, r_c2_;
  int degree_ = 0;
  std::uint32_t near_ = 0, far_ = 0;
  Lanes<W> now_, next_;
};

/// Hardly any point of an even set has more than 8 neighbors; none has more than 15.
bool visit(StarMesh& mesh, std::size_t i, const PushPull& targets, Suspects& suspects) {
  if (const auto moved = Visit<8>(mesh, i, targets, suspects).run()) return *moved;
  return Visit<16>(mesh, i, targets, suspects).run().value();
}

/// Whether the star of a point lies in a territory.
bool within(const Territory& territory, const Star& star) {
  bool inside = true;
  for (int k = 0; k < Star::most; ++k) inside &= territory.holds(star.neighbor[k]);
  return inside;
}

void sweep_strip(StarMesh& mesh, const PushPull& targets, StripWork& work, const Control& control) {
  constexpr std::size_t between_checks = 4096;
  const Strip& strip = work.strip;
  SweepCounts& counts = work.counts;
  for (std::size_t i = strip.begin; (i = mesh.take_marked(i, strip.end)) < strip.end; ++i) {
    if (++counts.visits % between_checks == 0) control.check();
    if (within(strip.territory, mesh.star(i)))
      counts.moves += visit(mesh, i, targets, work.suspects);
    else
      work.put_off.push_back(static_cast<std::uint32_t>(i));
  }
}

/// What no strip could do alone.
void finish_sweep(StarMesh& mesh, const PushPull& targets, StripWork& work) {
  for (const std::uint32_t i : work.put_off) work.counts.moves += visit(mesh, i, targets, work.suspects);
}

}  // namespace wellspaced::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wellspaced {
namespace {

HWY_EXPORT(sweep_strip);
HWY_EXPORT(finish_sweep);
HWY_EXPORT(visit);

/// Threads cost more than they bring when few points are marked.
unsigned threads_for(const StarMesh& mesh, const Control& control) {
  constexpr std::size_t worth_it = 20000;
  return mesh.marked() < worth_it ? 1 : control.threads();
}

}  // namespace

SweepCounts push_pull_sweep(StarMesh& mesh, const PushPull& targets, const Control& control) {
  const std::size_t strips = mesh.strips().size();
  std::vector<StripWork> work(strips);
  for (std::size_t s = 0; s < strips; ++s) {
    work[s].strip = mesh.strips()[s];
    work[s].suspects.territory = work[s].strip.territory;
  }
  const Control crew(threads_for(mesh, control), &control);
  for (std::size_t color = 0; color < 2; ++color) {
    parallel_blocks((strips + 1 - color) / 2, 1, crew, [&](std::size_t k, std::size_t) {
      HWY_DYNAMIC_DISPATCH(sweep_strip)(mesh, targets, work[2 * k + color], crew);
    });
  }
  SweepCounts all;
  StripWork rest;
  rest.suspects.territory = mesh.everywhere();
  for (StripWork& w : work) {
    rest.put_off.insert(rest.put_off.end(), w.put_off.begin(), w.put_off.end());
    rest.suspects.edges.insert(rest.suspects.edges.end(), w.suspects.put_off.begin(),
                               w.suspects.put_off.end());
    all.visits += w.counts.visits;
    all.moves += w.counts.moves;
    all.flips += w.suspects.flips;
  }
  mesh.legalize(rest.suspects);
  HWY_DYNAMIC_DISPATCH(finish_sweep)(mesh, targets, rest);
  all.moves += rest.counts.moves;
  all.flips += rest.suspects.flips;
  return all;
}

bool push_pull_step(StarMesh& mesh, std::size_t i, const PushPull& targets) {
  Suspects suspects{mesh.everywhere()};
  return HWY_DYNAMIC_DISPATCH(visit)(mesh, i, targets, suspects);
}

}  // namespace wellspaced
#endif  // HWY_ONCE

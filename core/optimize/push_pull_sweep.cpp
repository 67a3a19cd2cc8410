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

#include "core/voronoi/star_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace wellspaced::HWY_NAMESPACE {
namespace {

constexpr float margin = 1.001f;  // aim a little past the targets, so that points settle
constexpr float longest_step = 0.2f;
constexpr float thinnest = 1e-3f;  // twice the area that a triangle must keep
constexpr float illegal = -1e-5f;  // in-circle test in float: below this it is not rounding

template <class Use>
void for_each_bit(std::uint32_t bits, const Use& use) {
  for (; bits != 0; bits &= bits - 1) use(std::countr_zero(bits));
}

template <int W>
class Visit {
  using Floats = Row<float, W>;

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

  /// Spoke k is illegal where the neighbor before it lies inside the circle of triangle k.
  void suspect_spokes() {
    const Floats x = now_.x.before(degree_), y = now_.y.before(degree_), d2 = x * x + y * y;
    const Floats outside = d2 - Floats::all(2) * (x * now_.cx + y * now_.cy);
    for_each_bit(Floats::less(outside, Floats::all(illegal)) & places(),
                 [&](int k) { suspects_.add(static_cast<std::uint32_t>(i_), mesh_.star(i_).neighbor[k]); });
  }

  std::uint32_t places() const { return (1u << degree_) - 1; }

  void look(const StarLanes<W>& lanes) {
    near_ = Floats::less(lanes.d2, Floats::all(r_f2_)) & places();
    far_ = Floats::less(Floats::all(r_c2_), lanes.r2) & places();
  }

  Vec2f displacement() const {
    const Floats place = Floats::load(place_numbers), degree = Floats::all(static_cast<float>(degree_));
    Floats x = Floats::all(0), y = x;
    if (near_ != 0) {
      const Floats d = now_.d2.root();
      const Floats weight = (Floats::all(static_cast<float>(t_.push)) * (d - Floats::all(r_f_ * margin)) / d)
                                .where_less(now_.d2, Floats::all(r_f2_))
                                .where_less(place, degree);
      x = weight * now_.x;
      y = weight * now_.y;
    }
    if (far_ != 0) {
      const Floats r = now_.r2.root();
      const Floats weight = (Floats::all(static_cast<float>(t_.pull)) * (r - Floats::all(r_c_ / margin)) / r)
                                .where_less(Floats::all(r_c2_), now_.r2)
                                .where_less(place, degree);
      x = x + (weight * now_.cx).where_less(place, degree);
      y = y + (weight * now_.cy).where_less(place, degree);
    }
    const Vec2f sum{x.sum(), y.sum()};
    const float length2 = sum.x * sum.x + sum.y * sum.y;
    if (length2 <= longest_step * longest_step) return sum;
    const float shrink = longest_step / std::sqrt(length2);
    return {sum.x * shrink, sum.y * shrink};
  }

  /// Halves the step until all triangles keep some area, or get some where they had less; leaves what they
  /// then are in next_.
  bool shorten(Vec2f& move) {
    constexpr int most_halvings = 4;
    for (int halvings = 0;; ++halvings) {
      next_.shift_from(now_, move.x, move.y);
      next_.evaluate();
      const std::uint32_t thin = Floats::less(next_.area, Floats::all(thinnest)) & places();
      if (thin == 0 || (now_is_thin() && grow(thin, move))) return true;
      if (halvings == most_halvings) return false;
      move = {move.x * 0.5f, move.y * 0.5f};
    }
  }

  bool now_is_thin() const { return (Floats::less(now_.area, Floats::all(thinnest)) & places()) != 0; }

  /// Whether these triangles will have more area than they have now. In double: they may be very small.
  bool grow(std::uint32_t thin, Vec2f move) const {
    const FixedPoint here = mesh_.at(i_), there = place_after(move);
    const Star& star = mesh_.star(i_);
    bool all = true;
    for_each_bit(thin, [&](int k) {
      const auto area_from = [&](FixedPoint from) {
        return cross(mesh_.way(from, mesh_.at(star.neighbor[k])),
                     mesh_.way(from, mesh_.at(star.neighbor[star.after(k)])));
      };
      all = all && area_from(there) > std::max(0.0, area_from(here));
    });
    return all;
  }

  FixedPoint place_after(Vec2f move) const {
    return mesh_.moved(i_, {static_cast<double>(move.x), static_cast<double>(move.y)});
  }

  void commit(Vec2f move) {
    mesh_.move_to(i_, place_after(move));
    look(next_);
    if ((near_ | far_) == 0) return;
    mesh_.mark(i_);
    const std::uint32_t beyond = ((far_ << 1) | (far_ >> (degree_ - 1))) & places();
    for_each_bit(near_ | far_ | beyond, [&](int k) { mesh_.mark(mesh_.star(i_).neighbor[k]); });
  }

  alignas(64) static constexpr float place_numbers[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                          8, 9, 10, 11, 12, 13, 14, 15};

  StarMesh& mesh_;
  Suspects& suspects_;
  const std::size_t i_;
  const PushPull& t_;
  const float r_f_, r_c_, r_f2_, r_c2_;
  int degree_ = 0;
  std::uint32_t near_ = 0, far_ = 0;
  StarLanes<W> now_, next_;
};

/// Hardly any point of an even set has more than 8 neighbors; none has more than 15.
bool visit(StarMesh& mesh, std::size_t i, const PushPull& targets, Suspects& suspects) {
  if (const auto moved = Visit<8>(mesh, i, targets, suspects).run()) return *moved;
  return Visit<16>(mesh, i, targets, suspects).run().value();
}

/// Whether the star of a point lies in a territory.
bool within(const Territory& territory, const Star& star) {
  bool inside = true;
  if (territory.low + territory.size <= territory.n)  // most territories; simpler to test
    for (int k = 0; k < Star::most; ++k) inside &= star.neighbor[k] - territory.low < territory.size;
  else
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

}  // namespace
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

#include "core/optimize/cell_sweep.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace wellspaced {
namespace {

constexpr double margin = 1.001;  // aim a little past the targets, so that points settle
constexpr double longest_step = 0.2;
constexpr double unsure =
    0.93;  // corners of inexact cells may be as far as r_c though they say this much of it

/// A corner of the cell that no other corner next to it is farther than: where parts of a cell meet, there
/// are others, which lie on the way between two corners.
template <class Use>
void for_each_far_corner(const Cell& part, double beyond2, const Use& use) {
  const std::span<const Cell::Corner> corners = part.corners();
  const std::size_t m = corners.size();
  for (std::size_t k = 0; k < m; ++k) {
    const double d2 = norm2(corners[k].at);
    if (d2 <= beyond2) continue;
    const Cell::Corner &before = corners[k == 0 ? m - 1 : k - 1], &after = corners[k + 1 == m ? 0 : k + 1];
    const bool seam = before.label < 0 || corners[k].label < 0;
    if (seam && (norm2(before.at) > d2 || norm2(after.at) > d2)) continue;
    use(k, corners[k], before);
  }
}

class Sweeper {
 public:
  Sweeper(MovingSet& set, const PushPull& targets, const Control& control)
      : set_(set), targets_(targets), control_(control), finder_(set.finder(control)) {}

  SweepCounts sweep() {
    constexpr std::size_t between_checks = 256;
    SweepCounts counts;
    for (std::size_t i = 0; (i = set_.take_marked(i, set_.size())) < set_.size(); ++i) {
      if (++counts.visits % between_checks == 0) control_.check();
      counts.moves += visit(i) ? 1 : 0;
    }
    return counts;
  }

 private:
  bool visit(std::size_t i) {
    if (set_.freedom(i).dimensions == 0) return false;  // what violates near it is seen by the others
    look(i);
    if (!violates_) return false;
    const Domain& domain = set_.domain();
    const Vec2 move = domain.possible(set_[i], set_.unit(i) * capped(move_));
    if (norm(move) < 1e-9 * set_.unit(i)) return false;
    before_.swap(spokes_);
    set_.move_to(i, domain.step(set_[i], move));
    look(i);
    mark_lost();
    if (!violates_) return true;
    set_.mark(i);
    for (const std::uint32_t j : involved_) set_.mark(j);
    return true;
  }

  static Vec2 capped(Vec2 move) {
    const double length = norm(move);
    return length <= longest_step ? move : (longest_step / length) * move;
  }

  /// What the point's cell and neighbors say: spokes_, violates_, involved_, move_ (in its units).
  void look(std::size_t i) {
    set_.find_cell(i, finder_);
    violates_ = false;
    move_ = {};
    involved_.clear();
    look_at_neighbors(i);
    look_at_corners(i);
  }

  void look_at_neighbors(std::size_t i) {
    const Domain& domain = set_.domain();
    const double reach2 = norm2(Vec2{targets_.r_f * set_.unit(i), 0});
    for (const Neighbor& neighbor : finder_.neighbors()) {
      if (norm2(neighbor.offset) >= reach2) break;  // nearest first; straight through space is no farther
      if (neighbor.id == i) continue;
      const double unit = std::min(set_.unit(i), set_.unit(neighbor.id));
      const Vec2 way = domain.way_to(set_[i], neighbor);
      const double distance = norm(way) / unit;
      if (distance >= targets_.r_f || !(distance > 0)) continue;
      violates_ = true;
      involved_.push_back(neighbor.id);
      const double shortfall = targets_.push * (distance - targets_.r_f * margin) / distance;
      move_ = move_ + (shortfall / set_.unit(i)) * way;
    }
  }

  void look_at_corners(std::size_t i) {
    double least = set_.unit(i);
    spokes_.clear();
    for (const Cell& part : finder_.parts()) {
      for (const Cell::Corner& corner : part.corners()) {
        if (corner.label < 0) continue;
        spokes_.push_back(id_of(corner.label));
        least = std::min(least, set_.unit(spokes_.back()));
      }
    }
    const double sure = set_.domain().has_exact_cells() ? 1 : unsure;
    const double r_c = set_.domain().distance_to_chart(sure * targets_.r_c * least);
    for (const Cell& part : finder_.parts()) {
      if (part.outradius2() <= r_c * r_c) continue;
      for_each_far_corner(part, r_c * r_c,
                          [&](std::size_t k, const Cell::Corner& corner, const Cell::Corner& before) {
                            look_at_corner(i, finder_.distance_of_corner(part, k), corner, before);
                          });
    }
  }

  /// It is too far if it is so for any of the points around it; else those with smaller units would be the
  /// only ones to move, and leave their place for good.
  void look_at_corner(std::size_t i, double away, const Cell::Corner& corner, const Cell::Corner& before) {
    double unit = set_.unit(i);
    for (const std::int32_t label : {corner.label, before.label})
      if (label >= 0) unit = std::min(unit, set_.unit(id_of(label)));
    const double distance = away / unit;
    if (distance <= targets_.r_c) return;
    violates_ = true;
    for (const std::int32_t label : {corner.label, before.label})
      if (label >= 0) involved_.push_back(id_of(label));
    const double excess = targets_.pull * (distance - targets_.r_c / margin) * unit / set_.unit(i);
    move_ = move_ + (excess / norm(corner.at)) * corner.at;
  }

  std::uint32_t id_of(std::int32_t label) const {
    return finder_.neighbors()[static_cast<std::size_t>(label)].id;
  }

  /// Where the point is no neighbor any more, others have come to be, and with them corners that it doesn't
  /// see.
  void mark_lost() {
    const std::size_t m = before_.size();
    for (std::size_t k = 0; k < m; ++k) {
      if (std::find(spokes_.begin(), spokes_.end(), before_[k]) != spokes_.end()) continue;
      set_.mark(before_[k]);
      set_.mark(before_[k == 0 ? m - 1 : k - 1]);
      set_.mark(before_[k + 1 == m ? 0 : k + 1]);
    }
  }

  MovingSet& set_;
  const PushPull& targets_;
  const Control& control_;
  CellFinder finder_;
  std::vector<std::uint32_t> spokes_, before_, involved_;
  bool violates_ = false;
  Vec2 move_;
};

}  // namespace

SweepCounts push_pull_sweep(MovingSet& set, const PushPull& targets, const Control& control) {
  return Sweeper(set, targets, control).sweep();
}

}  // namespace wellspaced

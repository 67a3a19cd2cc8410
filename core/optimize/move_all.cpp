#include "core/optimize/move_all.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace wellspaced {
namespace {

/// Whether there is a triangulation of the places as they are now.
bool triangulate(StarMesh& mesh, const PointSet& input, const Control& control) {
  if (mesh.is_positive()) {
    mesh.legalize_all(control);
    return true;
  }
  try {
    mesh.rebuild(input, control);
    return true;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::degenerate_input) throw;
    return false;
  }
}

}  // namespace

double move_all(StarMesh& mesh, std::span<const Vec2> moves, const PointSet& input, const Control& control) {
  LargeVector<FixedPoint> from(mesh.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = mesh.at(i);
  for (double part = 1; part >= 1.0 / 64; part /= 2) {
    for (std::size_t i = 0; i < from.size(); ++i) mesh.move_to(i, mesh.moved(i, part * moves[i]));
    if (triangulate(mesh, input, control)) return part;
    for (std::size_t i = 0; i < from.size(); ++i) mesh.move_to(i, from[i]);
  }
  return 0;
}

double move_all(MovingSet& set, std::span<const Vec2> moves, const PointSet&, const Control& control) {
  constexpr std::size_t between_checks = 4096;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (i % between_checks == 0) control.check();
    const Vec2 move = set.domain().possible(set[i], set.unit(i) * moves[i]);
    if (move != Vec2{}) set.move_to(i, set.domain().step(set[i], move));
  }
  return 1;
}

double longest(std::span<const Vec2> moves) {
  double longest2 = 0;
  for (const Vec2 move : moves) longest2 = std::max(longest2, norm2(move));
  return std::sqrt(longest2);
}

}  // namespace wellspaced

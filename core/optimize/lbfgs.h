#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/control.h"
#include "core/vec.h"

namespace wellspaced {

/// Limited-memory BFGS: descent directions from the last few steps and the changes of gradient that they
/// made. Without any step remembered the direction is -diagonal * gradient.
///
/// Guarantees: a direction of descent, up to rounding, since only steps along which the gradient grows are
/// remembered. Cost: O(memory n). Determinism: sums in index order.
/// Reference: Nocedal, "Updating Quasi-Newton Matrices with Limited Storage", 1980 (the two loops).
class Lbfgs {
 public:
  /// The step s has changed the gradient by y.
  void remember(std::vector<Vec2> s, std::vector<Vec2> y);
  void forget() { pairs_.clear(); }
  bool remembers() const { return !pairs_.empty(); }

  /// Errors: cancelled, deadline_exceeded. `diagonal`: an approximate inverse of the Hessian, one positive
  /// number a point.
  std::vector<Vec2> direction(std::span<const Vec2> gradient, std::span<const double> diagonal,
                              const Control& control) const;

 private:
  static constexpr std::size_t memory = 7;
  struct Pair {
    std::vector<Vec2> s, y;
    double sy;
  };
  std::vector<Pair> pairs_;  // the oldest first
};

double dot(std::span<const Vec2> a, std::span<const Vec2> b);

}  // namespace wellspaced

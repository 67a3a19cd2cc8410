#pragma once

#include <array>
#include <utility>

#include "core/vec.h"

namespace wellspaced {

/// A point of a tangent chart with its cost.
struct Trial {
  Vec2 at;
  double cost = 0;
};

/// `steps` steps of the Nelder-Mead simplex method in the plane from {0, size e1, size e2}; the best trial
/// seen.
///
/// Guarantees: the result costs at most cost({0, 0}).
/// Reference: Nelder and Mead 1965, with the usual coefficients 1, 2, 1/2, 1/2.
template <class Cost>
Trial nelder_mead(const Cost& cost, double size, int steps) {
  const auto tried = [&](Vec2 at) { return Trial{at, cost(at)}; };
  std::array<Trial, 3> simplex = {tried({0, 0}), tried({size, 0}), tried({0, size})};
  const auto sort = [&simplex] {  // stable, by cost
    auto& [a, b, c] = simplex;
    if (b.cost < a.cost) std::swap(a, b);
    if (c.cost < b.cost) std::swap(b, c);
    if (b.cost < a.cost) std::swap(a, b);
  };
  sort();
  for (int step = 0; step < steps; ++step) {
    auto& [best, middle, worst] = simplex;
    const Vec2 center = 0.5 * (best.at + middle.at);
    const Trial reflected = tried(2 * center - worst.at);
    if (reflected.cost < best.cost) {
      const Trial expanded = tried(3 * center - 2 * worst.at);
      worst = expanded.cost < reflected.cost ? expanded : reflected;
    } else if (reflected.cost < middle.cost) {
      worst = reflected;
    } else {
      const Trial& nearer = reflected.cost < worst.cost ? reflected : worst;
      const Trial contracted = tried(0.5 * (center + nearer.at));
      if (contracted.cost < nearer.cost) {
        worst = contracted;
      } else {
        middle = tried(0.5 * (best.at + middle.at));
        worst = tried(0.5 * (best.at + worst.at));
      }
    }
    sort();
  }
  return simplex[0];
}

/// The same along a line from {0, size}, in one dimension: the cost of a number.
template <class Cost>
double nelder_mead_on_line(const Cost& cost, double size, int steps) {
  double best = 0, worst = size, best_cost = cost(best), worst_cost = cost(worst);
  const auto sort = [&] {
    if (!(worst_cost < best_cost)) return;
    std::swap(best, worst);
    std::swap(best_cost, worst_cost);
  };
  const auto replace_worst = [&](double at, double at_cost) {
    worst = at;
    worst_cost = at_cost;
  };
  sort();
  for (int step = 0; step < steps; ++step) {
    const double reflected = 2 * best - worst, reflected_cost = cost(reflected);
    if (reflected_cost < best_cost) {
      const double expanded = 3 * best - 2 * worst, expanded_cost = cost(expanded);
      expanded_cost < reflected_cost ? replace_worst(expanded, expanded_cost)
                                     : replace_worst(reflected, reflected_cost);
    } else {
      const double nearer = reflected_cost < worst_cost ? reflected : worst;
      const double contracted = 0.5 * (best + nearer);
      replace_worst(contracted, cost(contracted));
    }
    sort();
  }
  return best;
}

}  // namespace wellspaced

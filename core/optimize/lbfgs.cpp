#include "core/optimize/lbfgs.h"

#include <cmath>
#include <utility>

namespace wellspaced {
namespace {

void add(std::vector<Vec2>& to, double factor, std::span<const Vec2> v) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = to[i] + factor * v[i];
}

}  // namespace

double dot(std::span<const Vec2> a, std::span<const Vec2> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

void Lbfgs::remember(std::vector<Vec2> s, std::vector<Vec2> y) {
  constexpr double least_curvature = 1e-8;
  const double sy = dot(s, y);
  if (!(sy > least_curvature * std::sqrt(dot(s, s) * dot(y, y)))) return;
  if (pairs_.size() == memory) pairs_.erase(pairs_.begin());
  pairs_.push_back({std::move(s), std::move(y), sy});
}

std::vector<Vec2> Lbfgs::direction(std::span<const Vec2> gradient, std::span<const double> diagonal,
                                   const Control& control) const {
  std::vector<Vec2> d(gradient.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = -1 * gradient[i];
  std::vector<double> weight(pairs_.size());
  for (std::size_t k = pairs_.size(); k-- > 0;) {
    control.check();
    weight[k] = dot(pairs_[k].s, d) / pairs_[k].sy;
    add(d, -weight[k], pairs_[k].y);
  }
  double scale = 1;
  if (remembers()) {
    double ydy = 0;
    const Pair& last = pairs_.back();
    for (std::size_t i = 0; i < d.size(); ++i) ydy += diagonal[i] * norm2(last.y[i]);
    scale = last.sy / ydy;
  }
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = (scale * diagonal[i]) * d[i];
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    control.check();
    add(d, weight[k] - dot(pairs_[k].y, d) / pairs_[k].sy, pairs_[k].s);
  }
  return d;
}

}  // namespace wellspaced

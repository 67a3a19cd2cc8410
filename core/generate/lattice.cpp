#include "core/generate/lattice.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"

namespace wellspaced {
namespace {

/// The lattice of rows * columns points, row j shifted by j * shift / (rows * columns) of the width: one
/// Hermite normal form.
struct LatticeForm {
  std::uint64_t rows = 1, columns = 1, shift = 0;
};

/// Two shortest vectors of a lattice, u no longer than v, dot(u, v) >= 0.
struct Basis {
  Vec2 u, v;
};

/// The shape that is wanted: stretch is 1 for it, and more for every other one.
enum class Shape { square, triangular };

/// Mean square of the singular values of the linear map from the ideal cell to this one, areas being equal.
double stretch(const Basis& b, Shape shape, double cell_area) {
  const double two_sides = norm2(b.u) + norm2(b.v);
  if (shape == Shape::square) return two_sides / (2 * cell_area);
  return (two_sides + norm2(b.v - b.u)) / (std::sqrt(12.0) * cell_area);
}

/// Lagrange's reduction, until the basis is shortest or one of its vectors is shorter than `too_short`.
Basis reduce(Vec2 u, Vec2 v, double too_short2) {
  for (;;) {
    if (norm2(v) < norm2(u)) std::swap(u, v);
    if (norm2(u) < too_short2) break;
    const Vec2 next = v - std::floor(dot(u, v) / norm2(u) + 0.5) * u;
    if (!(norm2(next) < norm2(v))) break;  // not shorter, be it by rounding alone
    v = next;
  }
  if (dot(u, v) < 0) v = -1 * v;
  return {u, v};
}

class BestLattice {
 public:
  BestLattice(const Torus& torus, std::uint64_t count, Shape shape)
      : torus_(torus), count_(count), shape_(shape), cell_area_(torus.area() / static_cast<double>(count)) {}

  LatticeForm find(Control& control) {
    for (std::uint64_t rows = 1; rows <= count_; ++rows) {
      if (rows % 65536 == 0) control.check();
      if (count_ % rows == 0) try_rows(rows, control);
    }
    return best_;
  }

  Basis basis(const LatticeForm& form) const { return reduce(column(form.columns), row(form), 0); }

 private:
  Vec2 column(std::uint64_t columns) const { return {torus_.width() / static_cast<double>(columns), 0}; }
  Vec2 row(const LatticeForm& form) const {
    return {torus_.width() * (static_cast<double>(form.shift) / static_cast<double>(count_)),
            torus_.height() / static_cast<double>(form.rows)};
  }

  void try_rows(std::uint64_t rows, Control& control) {
    LatticeForm form{rows, count_ / rows, 0};
    const Vec2 u = column(form.columns);
    for (; form.shift < rows; ++form.shift) {
      if (form.shift % 16384 == 0) control.check();
      const double s = stretch(reduce(u, row(form), too_short2_), shape_, cell_area_);
      if (!(s < least_ * (1 - 1e-12))) continue;  // of equal ones the first
      least_ = s;
      best_ = form;
      // With a vector u the other one is at least area / |u| long, which makes the stretch of either shape at
      // least area / (2 |u|^2).
      too_short2_ = 0.5 * cell_area_ / least_;
    }
  }

  const Torus& torus_;
  std::uint64_t count_;
  Shape shape_;
  double cell_area_, least_ = INFINITY, too_short2_ = 0;
  LatticeForm best_;
};

/// Calls put(x, y) for each point of the lattice, row by row, from left to right.
template <class Put>
void visit_lattice(const Torus& torus, const LatticeForm& form, Control& control, const Put& put) {
  const auto count = static_cast<double>(form.rows * form.columns);
  std::uint64_t start = 0, seen = 0;  // in units of width / count
  for (std::uint64_t j = 0; j < form.rows; ++j) {
    const double y = torus.height() * (static_cast<double>(j) / static_cast<double>(form.rows));
    for (std::uint64_t i = 0; i < form.columns; ++i) {
      if (++seen % 65536 == 0) control.check();
      put(torus.width() * (static_cast<double>(start + i * form.rows) / count), y);
    }
    start = (start + form.shift) % form.rows;
  }
}

PointSet lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Shape shape,
                 Control& control) {
  PointSet points{torus, {}};
  const LatticeForm form = BestLattice(*torus, count, shape).find(control);
  points.coordinates.reserve(2 * count);
  visit_lattice(*torus, form, control, [&](double x, double y) { points.push_back({x, y, 0}); });
  return points;
}

}  // namespace

PointSet triangular_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count,
                            Control& control) {
  return lattice(torus, count, Shape::triangular, control);
}

PointSet square_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control) {
  return lattice(torus, count, Shape::square, control);
}

void require_even(std::uint64_t count) {
  if (count % 2 == 0) return;
  throw Error(ErrorCode::infeasible,
              "a honeycomb has two points a cell, so an odd number of them is impossible; ask for " +
                  std::to_string(count - 1) + " or " + std::to_string(count + 1),
              "/count");
}

PointSet hexagonal_lattice(const std::shared_ptr<const Torus>& torus, std::uint64_t count, Control& control) {
  require_even(count);
  BestLattice best(*torus, count / 2, Shape::triangular);
  const LatticeForm form = best.find(control);
  const Basis b = best.basis(form);
  // The lattice's own points and the middles of one of the two triangles of each cell; in the middles of the
  // others are the hexagons' centers.
  const Vec2 second = (1.0 / 3) * (b.u + b.v);
  PointSet points{torus, {}};
  points.coordinates.reserve(2 * count);
  visit_lattice(*torus, form, control, [&](double x, double y) {
    points.push_back({x, y, 0});
    points.push_back({wrap(x + second.x, torus->width()), wrap(y + second.y, torus->height()), 0});
  });
  return points;
}

}  // namespace wellspaced

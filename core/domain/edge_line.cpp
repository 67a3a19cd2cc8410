#include "core/domain/edge_line.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/domain/exact.h"

namespace wellspaced {
namespace {

/// Doubles by number, so that neighbors differ by one.
std::int64_t rank_of(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x + 0.0);  // no negative zero
  return bits >= 0 ? bits : std::int64_t{INT64_MIN} - bits;
}
double of_rank(std::int64_t rank) {
  return std::bit_cast<double>(rank >= 0 ? rank : std::int64_t{INT64_MIN} - rank);
}

/// The first rank in (low, high] where `reached`, which is false up to some rank and then true; looks around
/// `guess` first. Requires: not reached at low, reached at high.
template <class Reached>
std::int64_t first_reached(std::int64_t low, std::int64_t high, std::int64_t guess, const Reached& reached) {
  for (std::int64_t step = 1; low < guess && guess < high && step < (std::int64_t{1} << 52); step *= 2) {
    if (reached(guess)) {
      high = guess;
      guess -= step;
    } else {
      low = guess;
      guess += step;
    }
  }
  const auto between = [&] { return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low); };
  while (between() > 1) {
    const std::int64_t middle = low + static_cast<std::int64_t>(between() / 2);
    (reached(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

Vec2 point_on_edge(const PolygonEdge& e, double coordinate) {
  double Vec2::*const major = long_axis(e);
  double Vec2::*const minor = major == &Vec2::x ? &Vec2::y : &Vec2::x;
  const auto [low, high] = std::minmax(e.from.*major, e.to.*major);
  const double first_inside = std::nextafter(low, high), last_inside = std::nextafter(high, low);
  if (!(first_inside <= last_inside)) return e.from;
  Vec2 p;
  p.*major = std::clamp(coordinate, first_inside, last_inside);
  const double a = e.from.*minor, b = e.to.*minor;
  if (a == b) {
    p.*minor = a;
    return p;
  }
  const auto side = [&](double value) {
    p.*minor = value;
    return orientation(e.from, e.to, p);
  };
  const auto [bottom, top] = std::minmax(a, b);
  const int above = side(top);
  if (above == 0) return p;
  const double ratio = (b - a) / (e.to.*major - e.from.*major);
  const double guess = std::clamp(a + (p.*major - e.from.*major) * ratio, bottom, top);
  const auto reached = [&](std::int64_t rank) { return side(of_rank(rank)) != -above; };
  if (reached(rank_of(bottom))) return p;
  const std::int64_t rank = first_reached(rank_of(bottom), rank_of(top), rank_of(guess), reached);
  // The edge is between the last value below it and this one: take the nearer one, as plain arithmetic tells.
  if (side(of_rank(rank)) == 0) return p;
  const double over = of_rank(rank), under = of_rank(rank - 1);
  p.*minor = over - guess < guess - under ? over : under;
  return p;
}

}  // namespace wellspaced

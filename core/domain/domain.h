#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/rng.h"
#include "core/vec.h"

namespace wellspaced {

/// n.u <= c in the tangent chart at a point: the side of a bisector that is nearer to that point.
struct HalfPlane {
  Vec2 n;
  double c = 0;
};

/// Sample `id` (or one of its periodic images) as seen from a base point: offset in ambient coordinates.
struct Neighbor {
  Vec3 offset;
  std::uint32_t id = 0;
};

/// An axis-aligned box around a domain, with the axes along which it repeats.
struct Box {
  Vec3 low, size;
  std::array<bool, 3> periodic{};
};

/// Where points live. Everything that generators, optimizers and analyses need to know of a shape is asked
/// here, so that each of them is written once.
///
/// The tangent chart at p is a plane with origin p in which bisectors to near samples are straight lines and
/// distance from p grows with |u|; `chart_to_distance` is that monotone map. Torus: the identity, exact.
///
/// Thread safety: immutable after construction.
class Domain {
 public:
  virtual ~Domain() = default;

  virtual std::string_view type() const = 0;  ///< its name in requests: "torus"
  virtual int dimension() const = 0;          ///< coordinates a point: 2 or 3
  virtual double area() const = 0;
  virtual Box box() const = 0;
  virtual double distance(Vec3 p, Vec3 q) const = 0;

  /// Why the (finite) point p is not in the domain, for a person; nothing if it is.
  virtual std::optional<std::string> why_outside(Vec3 p) const = 0;

  /// Uniform by area.
  virtual Vec3 random_point(Rng& rng) const = 0;

  /// p moved by the tangent vector u (the exponential map); the result is in the domain.
  virtual Vec3 step(Vec3 p, Vec2 u) const = 0;

  /// The bisectors between the candidate step(base, u) and its neighbors, in the candidate's chart.
  /// Requires: out.size() == neighbors.size(); neighbor offsets relative to `base`.
  virtual void bisectors(Vec3 base, Vec2 u, std::span<const Neighbor> neighbors,
                         std::span<HalfPlane> out) const = 0;

  /// Distance on the domain of a chart vector of length u from the chart's origin.
  virtual double chart_to_distance(double u) const = 0;
};

}  // namespace wellspaced

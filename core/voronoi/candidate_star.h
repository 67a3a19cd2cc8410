#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/domain/domain.h"
#include "core/vec.h"

namespace wellspaced {

/// The Delaunay star of a candidate that moves about among neighbors that stand still, on a flat chart: kept
/// from one candidate to the next, and mended where the candidate's neighbors are others now.
///
/// Guarantees: no neighbor reaches into the circumcircle of a triangle of the star by more than 1e-13 of its
/// radius, so the radii are those of the candidate's own Delaunay neighbors, to 1e-12 where these are spread
/// out. What came before changes radii by rounding only.
/// Cost: about 40 ns a candidate; 60 ns more for each neighbor that comes or goes, and 150 ns for the first
/// candidate among other neighbors. Determinism: the same bits
/// on any vector width. Thread safety: one a thread.
class CandidateStar {
 public:
  static constexpr std::size_t most_neighbors = 256;
  static constexpr int most = 15;  ///< spokes

  /// Turns to other neighbors. Requires: at most most_neighbors, none of them an image of the candidate.
  void load(std::span<const Neighbor> neighbors);

  struct Squares {
    double nearest2 = 0;    ///< of the distance to the nearest neighbor
    double outradius2 = 0;  ///< of the distance to the farthest corner of the cell
  };
  /// For the candidate at u, among the loaded neighbors alone. Nothing where this way does not suit: cells
  /// that are not closed, needles, more than `most` spokes.
  std::optional<Squares> squares_at(Vec2 u);

  /// What vectors work on. Offsets are seen from where the chart begins, half2 is half the square of one.
  struct Table {
    static constexpr std::size_t padded = most_neighbors + 8;

    alignas(64) double x[padded], y[padded];
    int size = 0;
    /// Spokes by their places among the neighbors, counter-clockwise; their offsets go on from the first one.
    std::int32_t spoke[most + 1];
    int degree = 0;
    alignas(64) double spoke_x[24], spoke_y[24], spoke_half2[24];
    /// All other neighbors.
    std::int32_t outer[most_neighbors];
    int outers = 0;
    alignas(64) double outer_x[most_neighbors], outer_y[most_neighbors], outer_half2[most_neighbors];
    /// The corners of the last candidate, seen from it.
    alignas(64) double corner_x[16], corner_y[16];
  };

 private:
  std::optional<Squares> mended_squares_at(Vec2 u);
  bool wrap(Vec2 u);
  bool drop_spoke(Vec2 u);
  bool take_outer(Vec2 u);
  bool replace(int first, int removed, int outer);
  void put_spokes();
  void put_outer(int at, std::int32_t place);

  Table table_;
};

}  // namespace wellspaced

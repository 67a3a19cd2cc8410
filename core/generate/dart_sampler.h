#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/control.h"
#include "core/domain/torus.h"
#include "core/generate/dart_loops.h"
#include "core/generate/dart_tiles.h"
#include "core/generate/sample_grid.h"
#include "core/point_set.h"
#include "core/rng.h"

namespace wellspaced {

/// Simple MPS: darts into a flat quadtree of cells that no single disk covers, until none is left.
///
/// Large grids are cut into tiles, which are worked on in an order of four colors, those of one color on
/// control.threads() threads. A round of darts is thrown in several passes, each with its tiles somewhere
/// else, so that no place always has the same side of a tile's border filled first. What is left after the
/// first rounds is little, and is worked on as a whole.
class DartSampler {
 public:
  DartSampler(const Torus& torus, const DiskRadii& radii, Rng& rng, Control& control);

  /// Guarantees: at the end every place of the torus was found within (1 + 5e-10) coverage radii of a sample,
  /// and each sample no nearer than the conflict radius to all earlier ones. Errors: cancelled,
  /// deadline_exceeded.
  void run();

  /// Row by row of the background grid.
  PointSet samples(const std::shared_ptr<const Torus>& torus) const;

 private:
  /// Where the tiles of a pass are, and the random numbers of each.
  struct Pass {
    double darts_a_cell = 0;
    bool halves = false;  // parts of cells first
    std::int64_t offset_x = 0, offset_y = 0;
    std::uint64_t seed = 0;
  };
  template <class Cell>
  using Lists = std::vector<std::vector<Cell>*>;

  void fill();
  void go_down();
  void report(int round);

  void throw_in_passes(int round);
  void run_pass(const Pass& pass);
  void work_on_tile(std::int64_t tile_x, std::int64_t tile_y, const Pass& pass);
  Lists<ActiveCell> blocks_of(std::int64_t tile_x, std::int64_t tile_y, const Pass& pass);
  std::size_t active() const;

  void take_together();
  void finish(int round);
  void fill_centers();

  template <class Cell>
  void halve_all(std::vector<Cell>& cells, double coverage2, std::vector<Cell>& scratch) const;
  template <class Cell>
  void throw_into(const Lists<Cell>& blocks, double darts_a_cell, Rng& rng);
  template <class Cell>
  std::size_t draw_batch(const Lists<Cell>& blocks, std::size_t fullest, std::size_t n, Rng& rng,
                         Dart* darts) const;
  void throw_around(const Dart& dart, Rng& rng);
  Vec2 drawn_near(Vec2 place, Rng& rng) const;

  SampleGrid grid_;
  DiskRadii radii_;
  TiledAxis tiles_x_, tiles_y_;
  Rng& rng_;
  Control& control_;
  std::vector<std::vector<ActiveCell>> blocks_;  // row by row
  std::vector<DeepCell> deep_;                   // in their place after the first rounds
  Level above_, level_;
};

}  // namespace wellspaced

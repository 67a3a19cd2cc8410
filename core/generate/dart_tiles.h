#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace wellspaced {

/// One axis of a background grid in blocks of about 32 cells, and the blocks in tiles of about four. Tiles
/// are an even number or one, each at least two blocks wide, and start at any block, around the corner too.
class TiledAxis {
 public:
  /// `whole`: one block, hence one tile.
  TiledAxis(std::int64_t cells, bool whole)
      : cells_(cells),
        blocks_(whole ? 1 : std::max<std::int64_t>(1, cells / 32)),
        tiles_(std::max<std::int64_t>(1, blocks_ / 8 * 2)) {}

  std::int64_t blocks() const { return blocks_; }
  std::int64_t tiles() const { return tiles_; }
  /// First cell of a block; of blocks(): the number of cells.
  std::int64_t first_cell(std::int64_t block) const { return block * cells_ / blocks_; }
  /// The first block of a tile that has `offset` blocks before tile 0; may be past the last: then less
  /// blocks().
  std::int64_t first_block(std::int64_t tile, std::int64_t offset) const {
    return offset + tile * blocks_ / tiles_;
  }

 private:
  std::int64_t cells_, blocks_, tiles_;
};

}  // namespace wellspaced

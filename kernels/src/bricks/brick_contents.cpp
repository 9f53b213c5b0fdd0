// SPDX-License-Identifier: BSD-3-Clause
#include "brick_contents.h"

#include <bitset>

namespace flyball {
namespace {

/// Bits that stand for the cells of level 1 in a brick, each at the first of its eight.
constexpr std::uint64_t first_of_eight = 0x0000'0505'0000'0505;

/// Any of the eight cells of a cell of level 1, at the first of them.
std::uint64_t any_of_eight(std::uint64_t cells) {
  cells |= cells >> 1U;  // along x
  cells |= cells >> 4U;  // along y
  cells |= cells >> 16U;
  return cells & first_of_eight;
}

std::uint64_t count_of(std::uint64_t bits) {
  return std::bitset<64>{bits}.count();
}

/// As `BrickCells::state` has it: what holds an occupied cell is occupied, and what holds an
/// unknown one otherwise is unknown.
void count_brick(const CellMasks& masks, int level, MapLevel& counts) {
  const std::uint64_t all = level == 0 ? ~std::uint64_t{0} : first_of_eight;
  const std::uint64_t occupied = level == 0 ? masks.occupied : any_of_eight(masks.occupied);
  const std::uint64_t unknown = level == 0 ? masks.unknown : any_of_eight(masks.unknown);
  counts.known_cells += count_of((occupied | ~unknown) & all);
  counts.occupied_cells += count_of(occupied);
}

void count_chunk(const Chunk& chunk, int level, MapLevel& counts) {
  if (level < brick_level) {
    for (const CellMasks& masks : chunk.masks) {
      count_brick(masks, level, counts);
    }
    return;
  }
  const std::size_t bricks_per_cell = std::size_t{1}
                                      << 3 * static_cast<unsigned>(level - brick_level);
  for (std::size_t brick = 0; brick < Chunk::brick_count; brick += bricks_per_cell) {
    const BlockSummary block = chunk.block(level, brick);
    counts.known_cells += block.has_occupied || !block.has_unknown ? 1 : 0;
    counts.occupied_cells += block.has_occupied ? 1 : 0;
  }
}

}  // namespace

MapContents contents_of(const BrickMap& map, int coarsest_level) {
  MapContents contents;
  contents.bytes = map.bytes();
  for (int level = 0; level <= coarsest_level; ++level) {
    MapLevel& counts = contents.levels.emplace_back();
    counts.cell_m = map.lattice().cell_m(level);
    for (const Chunk* chunk : map.cells().chunks()) {
      count_chunk(*chunk, level, counts);
    }
  }
  return contents;
}

}  // namespace flyball

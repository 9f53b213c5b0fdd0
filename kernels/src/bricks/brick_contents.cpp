// SPDX-License-Identifier: BSD-3-Clause
// tested-in: map_file
#include "brick_contents.h"

namespace flyball {
namespace {

void count_chunk(const BrickCells& cells, const CellKey& chunk, int level, MapLevel& counts) {
  const int edge = 1 << (chunk_level - level);
  for (int i = 0; i < edge * edge * edge; ++i) {
    const CellKey cell{chunk.x * edge + i % edge, chunk.y * edge + i / edge % edge,
                       chunk.z * edge + i / (edge * edge)};
    const CellState state = cells.state(cell, level);
    counts.known_cells += state != CellState::unknown ? 1 : 0;
    counts.occupied_cells += state == CellState::occupied ? 1 : 0;
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
      count_chunk(map.cells(), chunk->key, level, counts);
    }
  }
  return contents;
}

}  // namespace flyball

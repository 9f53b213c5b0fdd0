// SPDX-License-Identifier: BSD-3-Clause
#include "bricks/brick_contents.h"

#include "flyball/runtime/random.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

MapLevel counted_by_cells(const BrickMap& map, int level) {
  MapLevel counts;
  const int edge = 1 << (chunk_level - level);
  for (const Chunk* chunk : map.cells().chunks()) {
    for (int i = 0; i < edge * edge * edge; ++i) {
      const CellKey cell{chunk->key.x * edge + i % edge, chunk->key.y * edge + i / edge % edge,
                         chunk->key.z * edge + i / (edge * edge)};
      const CellState state = map.cells().state(cell, level);
      counts.known_cells += state != CellState::unknown ? 1 : 0;
      counts.occupied_cells += state == CellState::occupied ? 1 : 0;
    }
  }
  return counts;
}

/// Bricks in three chunks; some are all free, some hold a few unknown or occupied cells.
BrickMap scattered_map() {
  BrickMap map = BrickMap::of_states(0.15);
  RandomStream random{1, "contents"};
  std::vector<BrickStates> bricks;
  for (int i = 0; i < 900; ++i) {
    BrickStates brick{{i % 12 - 4, i / 12 % 8, i / 96 - 2}, {0, 0}};
    const int marks = i % 3 == 0 ? 0 : static_cast<int>(random.uniform(0.0, 12.0));
    for (int mark = 0; mark < marks; ++mark) {
      const std::uint64_t cell = std::uint64_t{1}
                                 << static_cast<unsigned>(random.uniform(0.0, 64.0));
      const bool is_occupied = random.uniform() < 0.3;
      brick.states.occupied |= is_occupied ? cell : 0;
      brick.states.unknown |= is_occupied ? 0 : cell;
    }
    brick.states.unknown &= ~brick.states.occupied;
    bricks.push_back(brick);
  }
  map.show(bricks);
  return map;
}

TEST(BrickContents, are_those_of_all_cells_one_by_one) {
  const BrickMap map = scattered_map();
  const MapContents contents = contents_of(map, chunk_level);
  ASSERT_EQ(contents.levels.size(), 6U);
  for (int level = 0; level <= chunk_level; ++level) {
    SCOPED_TRACE(level);
    const MapLevel expected = counted_by_cells(map, level);
    const MapLevel& counts = contents.levels[static_cast<std::size_t>(level)];
    EXPECT_EQ(counts.known_cells, expected.known_cells);
    EXPECT_EQ(counts.occupied_cells, expected.occupied_cells);
    EXPECT_GT(counts.known_cells, 0U);
    EXPECT_DOUBLE_EQ(counts.cell_m, 0.15 * (1 << level));
  }
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "bricks/brick_revisions.h"

#include "bricks/brick_map.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr int chunks = 300;
constexpr int middle = Lattice::half_keys;

/// A brick in each of many chunks, more than one near place can take.
std::vector<BrickMasks> a_change(int first = 0, int count = chunks) {
  std::vector<BrickMasks> changes;
  for (int i = first; i < first + count; ++i) {
    changes.push_back({{8 * (i % 50), 8 * (i / 50), 4}, 1, 2});
  }
  return changes;
}

CellState state_of(const BrickCells& cells, int chunk, int cell) {
  return cells.state({32 * (chunk % 50) + cell, 32 * (chunk / 50), 16}, 0);
}

TEST(BrickRevisions, keep_chunks_that_the_map_changes_drops_or_adds) {
  BrickMap map{0.15};
  map.apply(a_change(0, 100));
  const auto before = map.revision();
  map.apply(a_change());
  map.apply(a_change(0, 50));
  const auto after = map.revision();
  ASSERT_EQ(map.drop_beyond({0.0, 0.0, 0.0}, 1.0), std::size_t{chunks});
  map.apply(a_change(0, 10));
  EXPECT_EQ(before->chunks().size(), 100U);
  EXPECT_EQ(after->chunks().size(), std::size_t{chunks});
  EXPECT_EQ(map.cells().chunks().size(), 10U);
  for (int i = 0; i < chunks; ++i) {
    EXPECT_EQ(state_of(*before, i, 0), i < 100 ? CellState::free : CellState::unknown) << i;
    EXPECT_EQ(state_of(*after, i, 1), CellState::occupied) << i;
    EXPECT_EQ(state_of(map.cells(), i, 0), i < 10 ? CellState::free : CellState::unknown) << i;
  }
}

TEST(BrickRevisions, share_chunks_until_they_change) {
  BrickMap map{0.15};
  map.apply(a_change());
  const auto revision = map.revision();
  EXPECT_EQ(revision->chunks(), map.cells().chunks());
  map.apply(a_change(7, 1));
  for (std::size_t i = 0; i < chunks; ++i) {
    EXPECT_EQ(revision->chunks()[i] == map.cells().chunks()[i], i != 7) << i;
  }
}

TEST(BrickRevisions, are_handed_on_again_while_nothing_changes) {
  BrickMap map{0.15};
  map.apply(a_change());
  const auto one = map.revision();
  EXPECT_EQ(map.revision().get(), one.get());
  map.apply(a_change(0, 1));
  EXPECT_NE(map.revision().get(), one.get());
}

TEST(BrickRevisions, cost_no_copy_when_nobody_reads_them) {
  BrickMap map{0.15};
  map.apply(a_change());
  (void)map.revision();
  const auto before = map.cells().chunks();
  map.apply(a_change());
  EXPECT_EQ(map.cells().chunks(), before);
}

TEST(BrickRevisions, take_no_more_memory_however_often_they_are_handed_on) {
  BrickMap map{0.15};
  map.apply(a_change());
  const std::size_t alone = map.bytes();
  auto held = map.revision();
  const std::size_t index = map.bytes() - alone;
  std::size_t most = 0;
  for (int round = 0; round < 100; ++round) {
    map.apply(a_change());
    most = std::max(most, map.bytes());
    held = map.revision();
  }
  // What the reader holds, the index that it gave back, and the same once more, to be used again.
  EXPECT_LE(most, alone + 3 * index + 2 * chunks * sizeof(Chunk));
  held = nullptr;
  map.apply(a_change(0, 1));
  EXPECT_LE(map.bytes(), alone + 3 * index + 256 * sizeof(Chunk));
}

TEST(BrickRevisions, hold_no_more_than_each_reader_sees) {
  BrickMap map{0.15};
  map.apply(a_change());
  const std::size_t alone = map.bytes();
  std::vector<std::shared_ptr<const BrickCells>> held;
  for (int reader = 0; reader < 4; ++reader) {
    held.push_back(map.revision());
    map.apply(a_change());
  }
  const std::size_t index = held.front()->bytes();
  EXPECT_LE(map.bytes(), alone + 4 * (index + chunks * sizeof(Chunk)));
  for (int round = 0; round < 10; ++round) {
    map.apply(a_change());
  }
  EXPECT_LE(map.bytes(), alone + 4 * (index + chunks * sizeof(Chunk)));
}

TEST(BrickRevisions, outlive_the_map) {
  auto map = std::make_unique<BrickMap>(0.15);
  map->apply(a_change());
  const auto revision = map->revision();
  map->apply(a_change(0, 20));
  map = nullptr;
  EXPECT_EQ(state_of(*revision, 3, 1), CellState::occupied);
  EXPECT_EQ(revision->state({middle, middle, middle}, 0), CellState::unknown);
}

}  // namespace
}  // namespace flyball

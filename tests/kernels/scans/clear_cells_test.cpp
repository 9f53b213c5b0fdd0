// SPDX-License-Identifier: BSD-3-Clause
#include "scans/clear_cells.h"

#include <map>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr int base = 32768;
constexpr int edge = 14;  // of the box that the random scans are in

bool is_clear(const ClearCells& cells, int x, int y, int z) {
  return cells.cells().state({base + x, base + y, base + z}, 0) == CellState::free;
}

/// What the definition says, cell by cell.
class Reference {
 public:
  void set(int x, int y, int z, bool hit) {
    known_[{x, y, z}] = true;
    hit_[{x, y, z}] |= hit;
  }
  [[nodiscard]] bool is_clear(int x, int y, int z) const {
    for (int i = 0; i < 27; ++i) {
      if (known_.count({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1}) == 0) {
        return false;
      }
    }
    return !hit_.at({x, y, z});
  }

 private:
  using Cell = std::tuple<int, int, int>;
  std::map<Cell, bool> known_{};
  std::map<Cell, bool> hit_{};
};

BrickMasks one_cell(int x, int y, int z, bool hit) {
  const CellKey cell{base + x, base + y, base + z};
  const std::uint64_t bit = std::uint64_t{1} << bit_in_brick(cell);
  return {cell.above(brick_level), hit ? 0 : bit, hit ? bit : 0};
}

TEST(ClearCells, are_those_without_a_hit_and_with_known_neighbours) {
  std::mt19937 random{7};
  const auto pick = [&](int below) { return static_cast<int>(random() % below); };
  ClearCells cells{0.8};
  Reference expected;
  std::size_t clear = 0;
  for (int scan = 0; scan < 12; ++scan) {
    std::vector<BrickMasks> changes;
    for (int i = 0; i < 900; ++i) {
      const int x = pick(edge) - 5;
      const int y = pick(edge) - 5;
      const int z = pick(edge) - 5;
      const bool hit = pick(60) == 0;
      changes.push_back(one_cell(x, y, z, hit));
      expected.set(x, y, z, hit);
    }
    cells.add(changes);
    for (int i = 0; i < edge * edge * edge; ++i) {
      const int x = i % edge - 5;
      const int y = i / edge % edge - 5;
      const int z = i / edge / edge - 5;
      ASSERT_EQ(is_clear(cells, x, y, z), expected.is_clear(x, y, z)) << scan << " " << i;
      clear += is_clear(cells, x, y, z) ? 1 : 0;
    }
  }
  EXPECT_GT(clear, 500U);
}

TEST(ClearCells, know_of_a_map_what_it_still_tells) {
  std::vector<BrickMasks> seen;
  for (int i = 0; i < 512; ++i) {
    seen.push_back(one_cell(i % 8, i / 8 % 8, i / 64, i == 3 + 8 * 3 + 64 * 3));
  }
  BrickMap map{0.8};
  map.apply(seen);
  ClearCells cells{0.8};
  cells.add(map.cells());
  EXPECT_TRUE(is_clear(cells, 1, 1, 1));
  EXPECT_TRUE(is_clear(cells, 6, 6, 6));
  EXPECT_FALSE(is_clear(cells, 3, 3, 3));  // occupied
  EXPECT_FALSE(is_clear(cells, 0, 4, 4));  // beside the unknown
  EXPECT_GT(cells.bytes(), 1000U);
}

TEST(ClearCells, count_declared_space_as_known_but_not_as_seen) {
  std::vector<BrickMasks> seen;
  for (int i = 0; i < 6 * 8 * 8; ++i) {
    seen.push_back(one_cell(2 + i % 6, i / 6 % 8, i / 48, false));  // from x = 1.6 m on
  }
  ClearCells cells{0.8};
  cells.add(seen);
  EXPECT_FALSE(is_clear(cells, 2, 3, 3));
  EXPECT_TRUE(is_clear(cells, 3, 3, 3));
  cells.declare({1.0, 2.8, 2.8}, {0.3, 1.4});
  EXPECT_FALSE(is_clear(cells, 2, 3, 3));  // other neighbours stay unknown
  cells.declare({1.0, 2.8, 2.8}, {1.4, 1.4});
  EXPECT_TRUE(is_clear(cells, 2, 3, 3));
  EXPECT_FALSE(is_clear(cells, 1, 3, 3));  // never seen
}

}  // namespace
}  // namespace flyball

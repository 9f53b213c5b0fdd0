// SPDX-License-Identifier: BSD-3-Clause
#include "bricks/brick_map.h"

#include "maps/octomap_tree.h"
#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr int middle = Lattice::half_keys;

/// Random masks on random bricks in a cube of 64 cells that straddles eight chunks.
std::vector<BrickMasks> random_changes(std::mt19937_64& generator, int bricks) {
  std::vector<BrickMasks> changes;
  const auto key = [&] { return (middle >> 2) - 8 + static_cast<int>(generator() % 16); };
  for (int i = 0; i < bricks; ++i) {
    BrickMasks change;
    change.brick = {key(), key(), key()};
    const bool is_known = std::any_of(changes.begin(), changes.end(), [&](const BrickMasks& other) {
      return other.brick == change.brick;
    });
    if (is_known) {
      continue;
    }
    change.free = i % 3 == 0 ? ~std::uint64_t{0} : generator() & generator();
    change.hit = generator() & generator() & generator() & ~change.free;
    changes.push_back(change);
  }
  return changes;
}

/// The same map, cell by cell.
class BruteForce {
 public:
  void apply(const std::vector<BrickMasks>& changes) {
    for (const BrickMasks& change : changes) {
      for (int bit = 0; bit < 64; ++bit) {
        const std::tuple<int, int, int> cell{4 * change.brick.x + bit % 4,
                                             4 * change.brick.y + bit / 4 % 4,
                                             4 * change.brick.z + bit / 16};
        if ((change.hit >> bit & 1U) != 0) {
          cells_[cell] = std::min(cells_[cell] + log_odds::hit, int{log_odds::most});
        } else if ((change.free >> bit & 1U) != 0) {
          cells_[cell] = std::max(cells_[cell] + log_odds::miss, int{log_odds::least});
        }
      }
    }
  }
  void forget_occupied(int least_x) {
    for (auto cell = cells_.begin(); cell != cells_.end();) {
      const bool goes = cell->second >= 0 && std::get<0>(cell->first) >= least_x;
      cell = goes ? cells_.erase(cell) : std::next(cell);
    }
  }
  [[nodiscard]] CellState state(const CellKey& cell, int level) const {
    const int edge = 1 << level;
    bool has_unknown = false;
    for (int i = 0; i < edge * edge * edge; ++i) {
      const auto found = cells_.find({cell.x * edge + i % edge, cell.y * edge + i / edge % edge,
                                      cell.z * edge + i / edge / edge});
      if (found != cells_.end() && found->second >= 0) {
        return CellState::occupied;
      }
      has_unknown = has_unknown || found == cells_.end();
    }
    return has_unknown ? CellState::unknown : CellState::free;
  }

 private:
  std::map<std::tuple<int, int, int>, int> cells_;
};

TEST(BrickMap, says_of_every_cell_at_every_level_what_a_plain_grid_says) {
  for (const Simd simd : supported_simd()) {
    std::mt19937_64 generator{3};
    BrickMap map{0.15, simd};
    BruteForce reference;
    int seen[3] = {};
    for (int round = 0; round < 6; ++round) {
      const auto changes = random_changes(generator, 600);
      map.apply(changes);
      reference.apply(changes);
      for (int i = 0; i < 600; ++i) {
        const int level = i % (BrickCells::coarsest_level + 1);
        const auto key = [&] {
          return (middle - 40 + static_cast<int>(generator() % 80)) >> level;
        };
        const CellKey cell{key(), key(), key()};
        const CellState expected = reference.state(cell, level);
        ASSERT_EQ(map.cells().state(cell, level), expected) << "level " << level;
        ++seen[static_cast<int>(expected)];
      }
    }
    EXPECT_GT(*std::min_element(seen, seen + 3), 20);
  }
}

TEST(BrickMap, forgets_the_occupied_cells_of_some_chunks_and_leaves_revisions_as_they_were) {
  std::mt19937_64 generator{7};
  BrickMap map{0.15};
  BruteForce reference;
  const auto learn = [&] {
    const auto changes = random_changes(generator, 600);
    map.apply(changes);
    reference.apply(changes);
  };
  const auto compare = [&](const BrickCells& cells, const BruteForce& with) {
    for (int i = 0; i < 3000; ++i) {
      const int level = i % (BrickCells::coarsest_level + 1);
      const auto key = [&] { return (middle - 40 + static_cast<int>(generator() % 80)) >> level; };
      const CellKey cell{key(), key(), key()};
      ASSERT_EQ(cells.state(cell, level), with.state(cell, level)) << "level " << level;
    }
  };
  learn();
  const auto revision = map.revision();
  const BruteForce before = reference;
  map.forget_occupied({9.7, 0.0, 0.0}, 9.0);  // The chunks with x < 0 end at 0.
  reference.forget_occupied(middle);
  compare(map.cells(), reference);
  compare(*revision, before);
  learn();  // What was forgotten is learnt as if it had never been known.
  compare(map.cells(), reference);
}

TEST(BrickMap, holds_the_same_bytes_with_all_vector_instructions) {
  BrickMap portable{0.15, Simd::portable};
  BrickMap wide{0.15};
  std::mt19937_64 generator{5};
  for (int round = 0; round < 20; ++round) {
    const auto changes = random_changes(generator, 100);
    portable.apply(changes);
    wide.apply(changes);
  }
  ASSERT_EQ(portable.cells().chunks().size(), wide.cells().chunks().size());
  for (std::size_t i = 0; i < wide.cells().chunks().size(); ++i) {
    for (std::size_t brick = 0; brick < 512; ++brick) {
      ASSERT_EQ(portable.cells().chunks()[i]->bricks[brick].cells,
                wide.cells().chunks()[i]->bricks[brick].cells);
    }
  }
}

TEST(BrickMap, calls_everything_unknown_before_the_first_scan) {
  const BrickMap map{0.15};
  EXPECT_EQ(map.cells().state({middle, middle, middle}, 0), CellState::unknown);
  EXPECT_EQ(map.cells().state({0, 0, 0}, BrickCells::coarsest_level), CellState::unknown);
}

TEST(BrickMap, finds_its_chunks_again_however_many_there_are) {
  BrickMap map{0.15};
  std::vector<BrickMasks> changes;
  for (int i = 0; i < 600; ++i) {
    changes.push_back({{8 * (i % 30), 8 * (i / 30), 8 * (i % 7)}, ~std::uint64_t{0}, 0});
  }
  map.apply(changes);
  EXPECT_EQ(map.cells().chunks().size(), 600U);
  for (const BrickMasks& change : changes) {
    EXPECT_EQ(map.cells().state(change.brick, brick_level), CellState::free);
  }
}

// OctoMap's steps, with the clamps of MAVBench's code.
TEST(BrickMap, agrees_with_octomap_on_every_sequence_of_twenty_hits_and_misses) {
  octomap::OcTree tree{1.0};
  tree.setClampingThresMin(0.12);
  tree.setClampingThresMax(0.97);
  std::vector<std::pair<float, std::int8_t>> states{{0.0F, log_odds::unknown}};
  const auto update = inner_loops(widest_simd()).update_brick;
  for (int length = 0; length < 20; ++length) {
    std::vector<std::pair<float, std::int8_t>> next;
    for (const auto& [stock, ours] : states) {
      for (const bool hit : {false, true}) {
        octomap::OcTreeNode node;
        node.setLogOdds(stock);
        tree.updateNodeLogOdds(&node, hit ? tree.getProbHitLog() : tree.getProbMissLog());
        Brick brick;
        brick.cells.fill(ours);
        update(brick, hit ? 0 : 1, hit ? 1 : 0);
        ASSERT_EQ(tree.isNodeOccupied(node), log_odds::is_occupied(brick.cells[0]));
        next.emplace_back(node.getLogOdds(), brick.cells[0]);
      }
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    states = std::move(next);
  }
}

}  // namespace
}  // namespace flyball

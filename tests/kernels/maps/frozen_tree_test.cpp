// SPDX-License-Identifier: BSD-3-Clause
#include "maps/frozen_tree.h"

#include "bricks/octree_record.h"
#include "random_map.h"
#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double cell_m = 0.2;
constexpr int middle = Lattice::half_keys;

/// Whole blocks and single cells in a cube of 64 cells that straddles eight chunks, so that nodes
/// are pruned, also above the chunks, and expanded again.
std::vector<BrickMasks> random_changes(std::mt19937_64& generator) {
  std::vector<BrickMasks> changes;
  const int edge = 1 << generator() % 5;  // bricks
  const auto start = [&] {
    return (middle >> 2) - 8 +
           edge * static_cast<int>(generator() % static_cast<unsigned>(16 / edge));
  };
  const CellKey first{start(), start(), start()};
  const std::uint64_t hit = generator() % 3 == 0 ? generator() & generator() & generator() : 0;
  for (int i = 0; i < edge * edge * edge; ++i) {
    const CellKey brick{first.x + i % edge, first.y + i / edge % edge, first.z + i / edge / edge};
    changes.push_back({brick, ~hit, hit});
  }
  return changes;
}

/// How many nodes are the same; none below one that is not.
std::size_t same_below(const octomap::OcTree& tree,
                       const octomap::OcTreeNode& node,
                       const FrozenNode& frozen) {
  if (tree.isNodeOccupied(&node) != FrozenTree::is_occupied(frozen) ||
      tree.nodeHasChildren(&node) != FrozenTree::has_children(frozen)) {
    return 0;
  }
  std::size_t same = 1;
  for (unsigned octant = 0; octant < 8; ++octant) {
    const FrozenNode* child = FrozenTree::child(frozen, octant);
    if (tree.nodeChildExists(&node, octant) != (child != nullptr)) {
      return 0;
    }
    same += child == nullptr ? 0 : same_below(tree, *tree.getNodeChild(&node, octant), *child);
  }
  return same;
}

void expect_same(const octomap::OcTree& tree, const FrozenTree& frozen) {
  ASSERT_NE(frozen.root(), nullptr);
  ASSERT_EQ(same_below(tree, *tree.getRoot(), *frozen.root()), tree.size());
}

TEST(FrozenTree, has_the_nodes_that_the_tree_had) {
  octomap::OcTree tree{cell_m};
  OctreeRecord record;
  TreeFreezer freezer;
  std::mt19937_64 generator{3};
  std::vector<std::pair<std::unique_ptr<octomap::OcTree>, std::shared_ptr<const FrozenTree>>> kept;
  std::size_t least_nodes = tree.size();
  bool was_pruned = false;
  for (int round = 0; round < 100; ++round) {
    const auto changes = random_changes(generator);
    freezer.forget(changes);
    record.write(changes, tree);
    if (generator() % 2 == 0) {  // Several changes may lie between two copies.
      expect_same(tree, *freezer.freeze(tree));
    }
    if (round % 20 == 0) {
      kept.emplace_back(std::make_unique<octomap::OcTree>(tree), freezer.freeze(tree));
    }
    was_pruned = was_pruned || tree.size() < least_nodes;
    least_nodes = tree.size();
  }
  EXPECT_TRUE(was_pruned);
  for (const auto& [then, frozen] : kept) {
    expect_same(*then, *frozen);
  }
}

TEST(FrozenTree, knows_the_state_of_every_place_as_the_tree_does) {
  const auto tree = kit::random_tree(cell_m, {0.5, 0.1}, 3);
  tree->prune();
  TreeFreezer freezer;
  const auto frozen = freezer.freeze(*tree);
  EXPECT_EQ(frozen->cell_m(), cell_m);
  std::mt19937 generator{5};
  int seen[3] = {};
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p_W = kit::random_point(generator, 4.0);
    const auto* node = tree->search(p_W.x(), p_W.y(), p_W.z());
    const CellState expected = node == nullptr              ? CellState::unknown
                               : tree->isNodeOccupied(node) ? CellState::occupied
                                                            : CellState::free;
    ASSERT_EQ(frozen->state(p_W), expected);
    ++seen[static_cast<int>(expected)];
  }
  EXPECT_GT(*std::min_element(seen, seen + 3), 100);
  EXPECT_EQ(frozen->state({1e9, 0.0, 0.0}), CellState::unknown);
  EXPECT_EQ(TreeFreezer{}.freeze(octomap::OcTree{cell_m})->state({0, 0, 0}), CellState::unknown);
}

TEST(FrozenTree, shares_what_did_not_change) {
  const auto tree = kit::random_tree(cell_m, {0.5, 0.1}, 3);
  TreeFreezer freezer;
  const auto one = freezer.freeze(*tree);
  EXPECT_EQ(freezer.freeze(*tree), one);
  const CellKey cell{middle + 3, middle + 3, middle + 3};
  freezer.forget(cell);
  tree->setNodeValue(octomap::OcTreeKey(middle + 3, middle + 3, middle + 3), 1.0F);
  const auto other = freezer.freeze(*tree);
  const auto chunk_children = [](const FrozenTree& of, const CellKey& key) {
    const FrozenNode* node = of.root();
    for (int level = 15; level >= chunk_level; --level) {
      const auto bit = [&](int k) { return static_cast<unsigned>(k >> level) & 1U; };
      node = FrozenTree::child(*node, bit(key.x) | bit(key.y) << 1U | bit(key.z) << 2U);
    }
    return node->children;
  };
  EXPECT_NE(chunk_children(*one, cell), chunk_children(*other, cell));
  const CellKey elsewhere{middle - 3, middle + 3, middle + 3};
  EXPECT_EQ(chunk_children(*one, elsewhere), chunk_children(*other, elsewhere));
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A copy of an OctoMap tree that stays as it is, for readers on other threads. It has the same
/// leaves, so that every question has the same answer to the last bit, but of each node only what
/// questions need: whether it is occupied.
///
/// Copies share what did not change between them. The tree is cut into blocks of 32 x 32 x 32
/// cells; a new copy makes those blocks anew in which cells were written since the last one, and
/// the few nodes above all blocks.

#include "flyball/runtime/occupancy.h"

#include "bricks/lattice.h"
#include "maps/octomap_tree.h"
#include "scans/scan_masks.h"
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace flyball {

struct FrozenNode {
  const FrozenNode* children;  ///< Those that exist, side by side.
  std::uint8_t exists;         ///< A bit for each octant.
  bool is_occupied;
};
using FrozenNodes = std::vector<FrozenNode>;

class FrozenTree {
 public:
  using Node = FrozenNode;
  /// Owners: the trees that show the block, and the TreeFreezer for the next one.
  using Block = std::shared_ptr<const FrozenNodes>;

  /// @param nodes   The root first; none for an empty tree.
  /// @param blocks  What the nodes' children point into, beside `nodes` itself.
  FrozenTree(double cell_m, FrozenNodes nodes, std::vector<Block> blocks)
      : lattice_{cell_m}, nodes_{std::move(nodes)}, blocks_{std::move(blocks)} {}

  [[nodiscard]] double cell_m() const { return lattice_.cell_m(0); }
  /// Null for an empty tree.
  [[nodiscard]] const Node* root() const { return nodes_.empty() ? nullptr : nodes_.data(); }
  [[nodiscard]] static bool has_children(const Node& node) { return node.exists != 0; }
  /// Null where there is none.
  [[nodiscard]] static const Node* child(const Node& node, unsigned octant);
  [[nodiscard]] static bool is_occupied(const Node& node) { return node.is_occupied; }
  /// Of the leaf that contains the place; unknown where there is none.
  [[nodiscard]] CellState state(const Vec3& p_W) const;
  /// Without its blocks.
  [[nodiscard]] std::size_t bytes() const;

 private:
  Lattice lattice_;
  FrozenNodes nodes_;
  std::vector<Block> blocks_;
};

/// Makes copies of one tree, in turn. To be used by the thread that changes the tree.
class TreeFreezer {
 public:
  /// To be told of whatever was written.
  void forget(const std::vector<BrickMasks>& changes);
  void forget(const CellKey& cell);
  /// The tree as it is now. Its owners are those who hold copies of the pointer. Costs a walk over
  /// the blocks that were written since the last copy, at first over the whole tree.
  [[nodiscard]] std::shared_ptr<const FrozenTree> freeze(const octomap::OcTree& tree);
  /// Of the blocks that are kept for the next copy.
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] std::shared_ptr<const FrozenTree> made(const octomap::OcTree& tree);

  std::unordered_map<std::uint64_t, FrozenTree::Block> blocks_{};  ///< By packed chunks.
  std::shared_ptr<const FrozenTree> last_{};  ///< Null when something was written since.
};

}  // namespace flyball

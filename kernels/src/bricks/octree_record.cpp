// SPDX-License-Identifier: BSD-3-Clause
#include "octree_record.h"

#include <algorithm>
#include <bitset>
#include <utility>

namespace flyball {
namespace {

constexpr unsigned brick_depth = 14;  // of 16: a node there covers 4 x 4 x 4 cells
constexpr std::uint64_t all_cells = ~std::uint64_t{0};

/// Spreads the bits of a 14-bit coordinate to every third place.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32U) & 0x1f00000000ffffULL;
  x = (x | x << 16U) & 0x1f0000ff0000ffULL;
  x = (x | x << 8U) & 0x100f00f00f00f00fULL;
  x = (x | x << 4U) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2U) & 0x1249249249249249ULL;
}

std::uint64_t morton(const CellKey& cell) {
  const auto bits = [](int key) { return spread(static_cast<std::uint64_t>(key)); };
  return bits(cell.x) | bits(cell.y) << 1U | bits(cell.z) << 2U;
}

/// Gathers every third bit: the inverse of `spread`.
int every_third_bit(std::uint64_t code) {
  int x = 0;
  for (unsigned bit = 0; bit < brick_depth; ++bit) {
    x |= static_cast<int>(code >> 3U * bit & 1U) << bit;
  }
  return x;
}

/// The cells of one tree node that are to change. Down to a brick they are items of the sorted
/// list; below, bits.
struct Cells {
  std::uint64_t free;
  std::uint64_t hit;
};

/// What `updateNodeRecurs` does for one cell, done for all cells of a scan in one descent.
class Descent {
 public:
  explicit Descent(octomap::OcTree& tree) : tree_{tree} {}

  /// `fresh`: just created, so having no children does not mean that it was pruned.
  struct Node {
    octomap::OcTreeNode* node;
    bool fresh;
  };

  [[nodiscard]] bool has_children(Node parent) const { return tree_.nodeHasChildren(parent.node); }
  void update(Node leaf, bool hit) {
    const bool was_occupied = tree_.isNodeOccupied(leaf.node);
    tree_.updateNodeLogOdds(leaf.node, hit ? tree_.getProbHitLog() : tree_.getProbMissLog());
    has_new_state_ =
        has_new_state_ || leaf.fresh || tree_.isNodeOccupied(leaf.node) != was_occupied;
  }
  /// Whether a leaf has got another state since the last call.
  [[nodiscard]] bool take_has_new_state() { return std::exchange(has_new_state_, false); }

  /// Adds those of a cube of `edge` cells (4, 2 or 1) in a brick, whose lowest bit is `first`.
  void add_states(const octomap::OcTreeNode& node,
                  unsigned edge,
                  unsigned first,
                  CellMasks& states) const {
    if (!tree_.nodeHasChildren(&node)) {
      const std::uint64_t cells = cells_in(edge) << first;
      states.unknown &= ~cells;
      states.occupied |= tree_.isNodeOccupied(&node) ? cells : 0;
      return;
    }
    for (unsigned octant = 0; octant < 8; ++octant) {
      if (tree_.nodeChildExists(&node, octant)) {
        add_states(*tree_.getNodeChild(&node, octant), edge / 2,
                   first + first_bit(octant, edge / 2), states);
      }
    }
  }

  /// A cube of `edge` cells (4, 2 or 1); the cells' lowest bits are its.
  void cube(Node parent, unsigned edge, const Cells& cells) {
    const std::uint64_t all = cells_in(edge);
    const bool is_whole = cells.free == all || cells.hit == all;
    if (is_saturated(parent, cells)) {
      return;
    }
    if (edge == 1 || (is_whole && !has_children(parent))) {
      update(parent, cells.hit != 0);
      return;
    }
    const unsigned half = edge / 2;
    const std::uint64_t part = cells_in(half);
    for (unsigned octant = 0; octant < 8; ++octant) {
      const unsigned shift = first_bit(octant, half);
      const Cells below{cells.free >> shift & part, cells.hit >> shift & part};
      if ((below.free | below.hit) != 0) {
        cube(child(parent, octant), half, below);
      }
    }
    refresh(parent);
  }

  Node child(Node parent, unsigned octant) {
    bool fresh = false;
    if (!tree_.nodeChildExists(parent.node, octant)) {
      if (!parent.fresh && !has_children(parent)) {
        tree_.expandNode(parent.node);
      } else {
        tree_.createNodeChild(parent.node, octant);
        fresh = true;
      }
    }
    return {tree_.getNodeChild(parent.node, octant), fresh};
  }

  void refresh(Node parent) {
    if (!tree_.pruneNode(parent.node)) {
      parent.node->updateOccupancyChildren();
    }
  }

 private:
  /// A pruned node that is as free, or as occupied, as can be: nothing would change.
  [[nodiscard]] bool is_saturated(Node parent, const Cells& cells) const {
    if (parent.fresh || has_children(parent)) {
      return false;
    }
    const float log_odds = parent.node->getLogOdds();
    return (cells.hit == 0 && log_odds <= tree_.getClampingThresMinLog()) ||
           (cells.free == 0 && log_odds >= tree_.getClampingThresMaxLog());
  }

  /// The lowest bits of a brick that are a cube.
  static constexpr std::uint64_t cells_in(unsigned edge) {
    return edge == 4 ? all_cells : edge == 2 ? 0x330033 : 1;
  }
  /// Of the octant of a brick or of its part, whose edges are `edge` cells.
  static constexpr unsigned first_bit(unsigned octant, unsigned edge) {
    return edge * ((octant & 1U) + (octant >> 1U & 1U) * 4 + (octant >> 2U) * 16);
  }

  octomap::OcTree& tree_;
  bool has_new_state_{};
};

/// From the root down to the bricks.
template <class Item>
class Writer {
 public:
  /// @param is_new   The tree was empty: whatever is written has a new state.
  /// @param changed  Gets the bricks with new states.
  Writer(octomap::OcTree& tree,
         const std::vector<Item>& items,
         const std::vector<std::uint32_t>& wholly_free,
         bool is_new,
         std::vector<BrickStates>& changed)
      : descent_{tree},
        items_{items},
        wholly_free_{wholly_free},
        is_new_{is_new},
        changed_{changed} {}

  void below(Descent::Node parent, unsigned depth, std::size_t first, std::size_t last) {
    if (depth == brick_depth) {
      descent_.cube(parent, 4, {items_[first].free, items_[first].hit});
      note_states(*parent.node, first, last);
      return;
    }
    if (is_free_block(depth, first, last) && !descent_.has_children(parent)) {
      descent_.update(parent, false);
      note_states(*parent.node, first, last);
      return;
    }
    const unsigned shift = 3 * (brick_depth - 1 - depth);
    while (first != last) {
      const auto octant = static_cast<unsigned>(items_[first].code >> shift & 7U);
      std::size_t next = first + 1;
      while (next != last && (items_[next].code >> shift & 7U) == octant) {
        ++next;
      }
      below(descent_.child(parent, octant), depth + 1, first, next);
      first = next;
    }
    descent_.refresh(parent);
  }

 private:
  /// @param node  Of a brick, or of a block of bricks without children.
  void note_states(const octomap::OcTreeNode& node, std::size_t first, std::size_t last) {
    if (!descent_.take_has_new_state() && !is_new_) {
      return;
    }
    CellMasks states;
    descent_.add_states(node, 4, 0, states);
    for (std::size_t i = first; i < last; ++i) {
      const std::uint64_t code = items_[i].code;
      changed_.push_back(
          {{every_third_bit(code), every_third_bit(code >> 1U), every_third_bit(code >> 2U)},
           states});
    }
  }
  [[nodiscard]] bool is_free_block(unsigned depth, std::size_t first, std::size_t last) const {
    const unsigned levels = brick_depth - depth;
    return levels < 8 && last - first == std::size_t{1} << 3 * levels &&
           wholly_free_[last] - wholly_free_[first] == last - first;
  }

  Descent descent_;
  const std::vector<Item>& items_;
  const std::vector<std::uint32_t>& wholly_free_;
  bool is_new_;
  std::vector<BrickStates>& changed_;
};

}  // namespace

const std::vector<BrickStates>& OctreeRecord::write(const std::vector<BrickMasks>& changes,
                                                    octomap::OcTree& tree) {
  changed_.clear();
  if (changes.empty()) {
    return changed_;
  }
  sort(changes);
  const bool is_new = tree.getRoot() == nullptr;
  if (is_new) {
    write_first_cell(items_.front(), tree);
  }
  wholly_free_.assign(1, 0);
  for (const Item& item : items_) {
    wholly_free_.push_back(wholly_free_.back() + (item.free == all_cells ? 1 : 0));
  }
  Writer<Item>{tree, items_, wholly_free_, is_new, changed_}.below({tree.getRoot(), false}, 0, 0,
                                                                   items_.size());
  return changed_;
}

/// The masks come chunk by chunk, so whole chunks are put in order.
void OctreeRecord::sort(const std::vector<BrickMasks>& changes) {
  runs_.clear();
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const CellKey chunk = changes[i].brick.above(chunk_level - brick_level);
    const std::uint64_t code = morton(chunk);
    if (runs_.empty() || runs_.back().code != code) {
      runs_.push_back({code, i, i});
    }
    runs_.back().last = i + 1;
  }
  std::sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.code < b.code; });
  items_.clear();
  for (const Run& run : runs_) {
    for (std::size_t i = run.first; i < run.last; ++i) {
      const BrickMasks& change = changes[i];
      items_.push_back({run.code << 9U | brick_number(change.brick), change.free, change.hit});
    }
  }
}

/// Only OctoMap's own update can make a root.
void OctreeRecord::write_first_cell(Item& item, octomap::OcTree& tree) {
  const std::uint64_t cells = item.free | item.hit;
  const std::uint64_t cell = cells & (~cells + 1);
  const auto bit = static_cast<int>(std::bitset<64>{cell - 1}.count());
  const auto key = [&](unsigned axis, int offset) {
    return static_cast<octomap::key_type>(4 * every_third_bit(item.code >> axis) + (offset & 3));
  };
  tree.updateNode(octomap::OcTreeKey{key(0, bit), key(1, bit >> 2), key(2, bit >> 4)},
                  (item.hit & cell) != 0, false);
  item.free &= ~cell;
  item.hit &= ~cell;
}

}  // namespace flyball

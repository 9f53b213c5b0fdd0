// SPDX-License-Identifier: BSD-3-Clause
#include "maps/frozen_tree.h"

#include "scans/packed_cell.h"
#include <bitset>

namespace flyball {
namespace {

constexpr int tree_depth = 16;
constexpr int block_depth = tree_depth - chunk_level;

std::size_t count_of(unsigned bits) {
  return std::bitset<8>{bits}.count();
}

/// Where a node is: its octants on the way down from the root, most significant first.
struct Place {
  int depth{};
  CellKey key{};  ///< At that depth: as many bits.

  [[nodiscard]] Place child(unsigned octant) const {
    const auto bit = [&](unsigned axis) { return static_cast<int>(octant >> axis & 1U); };
    return {depth + 1, {2 * key.x + bit(0), 2 * key.y + bit(1), 2 * key.z + bit(2)}};
  }
};

/// Copies nodes, at first with the numbers of their children, because the list grows.
class Copy {
 public:
  explicit Copy(const octomap::OcTree& tree) : tree_{tree} {}

  void add_root(const octomap::OcTreeNode& root) { nodes_.push_back(without_children(root)); }
  /// @param elsewhere  The children of a node at a place, if they are kept elsewhere; or null.
  template <class Elsewhere>
  void add_children(std::size_t number,
                    const octomap::OcTreeNode& node,
                    const Place& place,
                    Elsewhere&& elsewhere) {
    if (!tree_.nodeHasChildren(&node)) {
      return;
    }
    nodes_[number].exists = exists(node);
    nodes_[number].elsewhere = elsewhere(node, place);
    if (nodes_[number].elsewhere == nullptr) {
      nodes_[number].first_child = add_below(node, place, elsewhere);
    }
  }
  /// The children of a node, and all that is below them.
  template <class Elsewhere>
  std::size_t add_below(const octomap::OcTreeNode& node, const Place& place, Elsewhere& elsewhere) {
    const std::size_t first = nodes_.size();
    for (unsigned octant = 0; octant < 8; ++octant) {
      if (tree_.nodeChildExists(&node, octant)) {
        nodes_.push_back(without_children(*tree_.getNodeChild(&node, octant)));
      }
    }
    std::size_t number = first;
    for (unsigned octant = 0; octant < 8; ++octant) {
      if (tree_.nodeChildExists(&node, octant)) {
        add_children(number, *tree_.getNodeChild(&node, octant), place.child(octant), elsewhere);
        ++number;
      }
    }
    return first;
  }

  [[nodiscard]] FrozenNodes nodes() const {
    FrozenNodes nodes(nodes_.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Numbered& from = nodes_[i];
      nodes[i] = {from.elsewhere != nullptr ? from.elsewhere : nodes.data() + from.first_child,
                  from.exists, from.is_occupied};
    }
    return nodes;
  }

 private:
  struct Numbered {
    std::size_t first_child;
    const FrozenNode* elsewhere;
    std::uint8_t exists;
    bool is_occupied;
  };
  [[nodiscard]] Numbered without_children(const octomap::OcTreeNode& node) const {
    return {0, nullptr, 0, tree_.isNodeOccupied(&node)};
  }
  [[nodiscard]] std::uint8_t exists(const octomap::OcTreeNode& node) const {
    unsigned bits = 0;
    for (unsigned octant = 0; octant < 8; ++octant) {
      bits |= tree_.nodeChildExists(&node, octant) ? 1U << octant : 0;
    }
    return static_cast<std::uint8_t>(bits);
  }

  const octomap::OcTree& tree_;
  std::vector<Numbered> nodes_{};
};

FrozenTree::Block block_below(const octomap::OcTree& tree, const octomap::OcTreeNode& node) {
  Copy copy{tree};
  const auto nowhere = [](const auto&, const Place&) -> const FrozenNode* { return nullptr; };
  (void)copy.add_below(node, {}, nowhere);
  return std::make_shared<const FrozenNodes>(copy.nodes());
}

}  // namespace

const FrozenTree::Node* FrozenTree::child(const Node& node, unsigned octant) {
  const unsigned bit = 1U << octant;
  return (node.exists & bit) == 0 ? nullptr : node.children + count_of(node.exists & (bit - 1));
}

CellState FrozenTree::state(const Vec3& p_W) const {
  const Node* node = lattice_.contains(p_W) ? root() : nullptr;
  if (node == nullptr) {
    return CellState::unknown;
  }
  const CellKey key = lattice_.cell(p_W);
  for (int level = tree_depth - 1; level >= 0 && node != nullptr && has_children(*node); --level) {
    const auto bit = [&](int of_key) { return static_cast<unsigned>(of_key >> level) & 1U; };
    node = child(*node, bit(key.x) | bit(key.y) << 1U | bit(key.z) << 2U);
  }
  return node == nullptr     ? CellState::unknown
         : node->is_occupied ? CellState::occupied
                             : CellState::free;
}

std::size_t FrozenTree::bytes() const {
  return nodes_.capacity() * sizeof(FrozenNode) + blocks_.capacity() * sizeof(Block);
}

void TreeFreezer::forget(const std::vector<BrickMasks>& changes) {
  if (!changes.empty()) {
    last_ = nullptr;
  }
  CellKey last{-1, -1, -1};
  for (const BrickMasks& change : changes) {
    const CellKey chunk = change.brick.above(chunk_level - brick_level);
    if (!(chunk == last)) {
      blocks_.erase(packed::chunk(chunk));
      last = chunk;
    }
  }
}

void TreeFreezer::forget(const CellKey& cell) {
  last_ = nullptr;
  blocks_.erase(packed::chunk(cell.above(chunk_level)));
}

std::shared_ptr<const FrozenTree> TreeFreezer::freeze(const octomap::OcTree& tree) {
  if (last_ == nullptr) {
    last_ = made(tree);
  }
  return last_;
}

std::shared_ptr<const FrozenTree> TreeFreezer::made(const octomap::OcTree& tree) {
  const octomap::OcTreeNode* root = tree.getRoot();
  if (root == nullptr) {
    return std::make_shared<const FrozenTree>(tree.getResolution(), FrozenNodes{},
                                              std::vector<FrozenTree::Block>{});
  }
  std::vector<FrozenTree::Block> shown;
  const auto in_block = [&](const octomap::OcTreeNode& node,
                            const Place& place) -> const FrozenNode* {
    if (place.depth != block_depth) {
      return nullptr;
    }
    FrozenTree::Block& block = blocks_[packed::chunk(place.key)];
    if (block == nullptr) {
      block = block_below(tree, node);
    }
    return shown.emplace_back(block)->data();
  };
  Copy copy{tree};
  copy.add_root(*root);
  copy.add_children(0, *root, {}, in_block);
  return std::make_shared<const FrozenTree>(tree.getResolution(), copy.nodes(), std::move(shown));
}

std::size_t TreeFreezer::bytes() const {
  std::size_t bytes = last_ != nullptr ? last_->bytes() : 0;
  for (const auto& [chunk, block] : blocks_) {
    bytes += block->capacity() * sizeof(FrozenNode) + sizeof(FrozenTree::Block);
  }
  return bytes;
}

}  // namespace flyball

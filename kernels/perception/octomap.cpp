// flyball-package: octomap
// flyball-link: octomap octomath
// SPDX-License-Identifier: BSD-3-Clause
//
// OctoMap's log-odds octree: Hornung et al. 2013, doi:10.1007/s10514-012-9321-0. The trees are
// those that stock insertion makes, byte for byte, and so is the work that is counted; the host is
// spared: scans/ray_scan.h walks the rays, bricks/octree_record.h writes the cells. One tree per
// resolution that was used. Questions do not look at the tree, but at a copy of what it says of
// each cell (free, occupied, unknown), which follows every change: a reader on another thread can
// be given a revision of that at once.

#include "flyball/kernels/mapper.h"
#include "flyball/runtime/registry.h"

#include "bricks/octree_copy.h"
#include "bricks/octree_record.h"
#include "maps/layered_mapper.h"
#include "maps/octree_file.h"

namespace {

using flyball::Error;
using flyball::MapLevel;
using flyball::Result;
using flyball::Status;

class TreeStore {
 public:
  explicit TreeStore(double cell_m)
      : tree_{std::make_unique<octomap::OcTree>(cell_m)},
        shown_{flyball::BrickMap::of_states(cell_m)} {
    tree_->setClampingThresMin(0.12);  // both as in MAVBench's code
    tree_->setClampingThresMax(0.97);
  }

  [[nodiscard]] double cell_m() const { return tree_->getResolution(); }
  [[nodiscard]] const flyball::BrickCells& cells() const { return shown_.cells(); }
  [[nodiscard]] std::shared_ptr<const flyball::BrickCells> revision() { return shown_.revision(); }

  void write(const std::vector<flyball::BrickMasks>& masks) {
    shown_.show(record_.write(masks, *tree_));
  }

  void show(const flyball::BrickStates& brick) { shown_.show({brick}); }

  [[nodiscard]] bool is_occupied(const flyball::CellKey& cell) const {
    const octomap::OcTreeNode* node = tree_->search(key_of(cell));
    return node != nullptr && tree_->isNodeOccupied(node);
  }
  [[nodiscard]] bool is_confirmed(const flyball::CellKey& cell) const {
    const octomap::OcTreeNode* node = tree_->search(key_of(cell));
    return node != nullptr && node->getLogOdds() >= flyball::confirmed_log_odds;
  }
  void confirm(const flyball::CellKey& cell) {
    tree_->setNodeValue(key_of(cell), flyball::confirmed_log_odds);
    const flyball::CellKey brick = cell.above(flyball::brick_level);
    flyball::CellMasks states = shown_.cells().masks(brick);
    states.occupied |= std::uint64_t{1} << flyball::bit_in_brick(cell);
    states.unknown &= ~states.occupied;
    shown_.show({{brick, states}});
  }

  [[nodiscard]] MapLevel counts() const {
    MapLevel counts{cell_m()};
    for (auto leaf = tree_->begin_leafs(); leaf != tree_->end_leafs(); ++leaf) {
      const std::uint64_t cells = std::uint64_t{1} << 3 * (tree_->getTreeDepth() - leaf.getDepth());
      counts.known_cells += cells;
      counts.occupied_cells += tree_->isNodeOccupied(*leaf) ? cells : 0;
    }
    return counts;
  }
  [[nodiscard]] std::size_t bytes() const { return tree_->memoryUsage() + shown_.bytes(); }

  [[nodiscard]] Status write_file(const std::string& path) const {
    octomap::OcTree copy{*tree_};  // Writing .bt rounds a tree.
    return flyball::write_octree(copy, path);
  }
  [[nodiscard]] static Result<TreeStore> read_file(const std::string& path) {
    const auto tree = flyball::read_octree(path);
    if (!tree) {
      return tree.error();
    }
    auto shown = flyball::to_bricks(**tree);
    if (!shown) {
      return Error{shown.error().code, "map file \"" + path + "\": " + shown.error().message};
    }
    TreeStore store{(*tree)->getResolution()};
    store.tree_->swapContent(**tree);
    store.shown_ = std::move(*shown);
    return store;
  }

 private:
  static octomap::OcTreeKey key_of(const flyball::CellKey& cell) {
    const auto key = [](int k) { return static_cast<octomap::key_type>(k); };
    return {key(cell.x), key(cell.y), key(cell.z)};
  }

  std::unique_ptr<octomap::OcTree> tree_;  ///< It cannot be moved.
  flyball::OctreeRecord record_{};
  flyball::BrickMap shown_;  ///< What the tree says of each cell.
};

}  // namespace

FLYBALL_PLUGIN(octomap) {
  registry.add<flyball::Mapper>(
      "octomap", [] { return std::make_unique<flyball::LayeredMapper<TreeStore>>(); });
}

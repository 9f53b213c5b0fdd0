// SPDX-License-Identifier: BSD-3-Clause
#include "scan_update.h"

#include "ray_walk.h"
#include <algorithm>
#include <bitset>

namespace flyball {
namespace {

using Brick = ScanUpdate::Brick;

constexpr int brick_depth = 14;  // of 16: a node there covers 4 x 4 x 4 cells

/// Spreads the bits of a 14-bit brick coordinate to every third place.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32U) & 0x1f00000000ffffULL;
  x = (x | x << 16U) & 0x1f0000ff0000ffULL;
  x = (x | x << 8U) & 0x100f00f00f00f00fULL;
  x = (x | x << 4U) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2U) & 0x1249249249249249ULL;
}

/// Gathers every third bit: the inverse of `spread`.
int gathered(std::uint64_t code) {
  int x = 0;
  for (unsigned bit = 0; bit < brick_depth; ++bit) {
    x |= static_cast<int>(code >> (3U * bit) & 1U) << bit;
  }
  return x;
}

std::uint64_t bit_of(const RayWalk::Cell& cell) {
  const int bit = (cell[2] & 3) << 4 | (cell[1] & 3) << 2 | (cell[0] & 3);
  return std::uint64_t{1} << static_cast<unsigned>(bit);
}

double count(std::uint64_t mask) {
  return static_cast<double>(std::bitset<64>{mask}.count());
}

/// What `updateNodeRecurs` does for one cell, done for all cells of the bricks in one descent.
class TreeWriter {
 public:
  explicit TreeWriter(octomap::OcTree& tree) : tree_{tree} {}

  void write(std::vector<Brick>& bricks) {
    if (bricks.empty()) {
      return;
    }
    if (tree_.getRoot() == nullptr) {
      write_first_cell(bricks.front());
    }
    inner({tree_.getRoot(), false}, 0, bricks.data(), bricks.data() + bricks.size());
  }

 private:
  /// `fresh`: just created, so having no children does not mean that it was pruned.
  struct Node {
    octomap::OcTreeNode* node;
    bool fresh;
  };

  /// Only OctoMap's own update can make a root.
  void write_first_cell(Brick& brick) {
    const std::uint64_t cells = brick.free | brick.hit;
    const std::uint64_t cell = cells & (~cells + 1);
    const auto bit = static_cast<int>(std::bitset<64>{cell - 1}.count());
    const auto key = [&](unsigned axis, int offset) {
      return static_cast<octomap::key_type>(4 * gathered(brick.code >> axis) + (offset & 3));
    };
    tree_.updateNode(octomap::OcTreeKey{key(0, bit), key(1, bit >> 2), key(2, bit >> 4)},
                     (brick.hit & cell) != 0, false);
    brick.free &= ~cell;
    brick.hit &= ~cell;
  }

  void inner(Node parent, unsigned depth, const Brick* first, const Brick* last) {
    if (depth == brick_depth) {
      brick(parent, *first);
      return;
    }
    const unsigned shift = 3 * (brick_depth - 1 - depth);
    while (first != last) {
      const std::uint64_t octant = first->code >> shift & 7U;
      const Brick* next = std::find_if(
          first, last, [&](const Brick& brick) { return (brick.code >> shift & 7U) != octant; });
      inner(child(parent, static_cast<unsigned>(octant)), depth + 1, first, next);
      first = next;
    }
    refresh(parent);
  }

  void brick(Node parent, const Brick& cells) {
    constexpr std::uint64_t octant_cells = 0x330033;  // x, y, z in 0..1
    if (is_saturated(parent, cells)) {
      return;
    }
    for (unsigned octant = 0; octant < 8; ++octant) {
      const unsigned shift = (octant & 1U) * 2 + (octant >> 1U & 1U) * 8 + (octant >> 2U) * 32;
      const Brick part{0, cells.free >> shift & octant_cells, cells.hit >> shift & octant_cells};
      if ((part.free | part.hit) != 0) {
        eighth(child(parent, octant), part);
      }
    }
    refresh(parent);
  }

  void eighth(Node parent, const Brick& cells) {
    if (is_saturated(parent, cells)) {
      return;
    }
    for (unsigned octant = 0; octant < 8; ++octant) {
      const unsigned shift = (octant & 1U) + (octant >> 1U & 1U) * 4 + (octant >> 2U) * 16;
      const bool hit = (cells.hit >> shift & 1U) != 0;
      if (hit || (cells.free >> shift & 1U) != 0) {
        tree_.updateNodeLogOdds(child(parent, octant).node,
                                hit ? tree_.getProbHitLog() : tree_.getProbMissLog());
      }
    }
    refresh(parent);
  }

  /// A pruned node that is as free, or as occupied, as can be: nothing would change.
  [[nodiscard]] bool is_saturated(Node parent, const Brick& cells) const {
    if (parent.fresh || tree_.nodeHasChildren(parent.node)) {
      return false;
    }
    const float log_odds = parent.node->getLogOdds();
    return (cells.hit == 0 && log_odds <= tree_.getClampingThresMinLog()) ||
           (cells.free == 0 && log_odds >= tree_.getClampingThresMaxLog());
  }

  Node child(Node parent, unsigned octant) {
    bool fresh = false;
    if (!tree_.nodeChildExists(parent.node, octant)) {
      if (!parent.fresh && !tree_.nodeHasChildren(parent.node)) {
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

  octomap::OcTree& tree_;
};

}  // namespace

ScanUpdate::Counts ScanUpdate::compute(const octomap::OcTree& lattice, const Scan& scan) {
  cut_rays(scan);
  span_window(lattice, scan.origin_W);
  Counts counts;
  counts.rays = static_cast<double>(rays_.size());
  counts.traversals = mark_cells(lattice, scan.origin_W);
  counts.updates = collect_bricks();
  return counts;
}

void ScanUpdate::apply(octomap::OcTree& tree) {
  TreeWriter{tree}.write(bricks_);
  bricks_.clear();
}

// The arithmetic of OccupancyOcTreeBase::computeUpdate, in its types: float vectors, a norm in
// double, a range in float. Anything else moves the ends of cut rays across cell borders.
void ScanUpdate::cut_rays(const Scan& scan) {
  rays_.clear();
  const auto cut = [&](const octomap::point3d& p_W, bool is_hit) {
    const octomap::point3d ray = p_W - scan.origin_W;
    if (ray.norm() <= scan.range_m) {
      rays_.push_back({p_W, is_hit});
    } else {
      rays_.push_back({scan.origin_W + ray.normalized() * static_cast<float>(scan.range_m), false});
    }
  };
  for (const octomap::point3d& p_W : scan.hits_W) {
    cut(p_W, true);
  }
  for (const octomap::point3d& p_W : scan.clear_W) {
    cut(p_W, false);
  }
}

void ScanUpdate::span_window(const octomap::OcTree& lattice, const octomap::point3d& origin_W) {
  const octomap::OcTreeKey start = lattice.coordToKey(origin_W);
  int low[3] = {start[0], start[1], start[2]};
  int high[3] = {start[0], start[1], start[2]};
  for (const Ray& ray : rays_) {
    const octomap::OcTreeKey end = lattice.coordToKey(ray.end_W);
    for (unsigned i = 0; i < 3; ++i) {
      low[i] = std::min<int>(low[i], end[i]);
      high[i] = std::max<int>(high[i], end[i]);
    }
  }
  std::size_t bricks = 1;
  for (unsigned i = 0; i < 3; ++i) {
    // A walk may step past its end by a cell where rounding hides the end from it.
    first_brick_[i] = (low[i] - 2) / 4;
    window_size_[i] = (high[i] + 2) / 4 - first_brick_[i] + 1;
    bricks *= static_cast<std::size_t>(window_size_[i]);
  }
  window_.assign(bricks, Brick{});
}

double ScanUpdate::mark_cells(const octomap::OcTree& lattice, const octomap::point3d& origin_W) {
  // Copies: a store into the window may change the members, as far as the compiler knows.
  const auto brick_of = [window = window_.data(), first = first_brick_,
                         size = window_size_](const RayWalk::Cell& cell) -> Brick& {
    const int row = ((cell[2] >> 2) - first[2]) * size[1] + (cell[1] >> 2) - first[1];
    return window[static_cast<std::size_t>(row * size[0] + (cell[0] >> 2) - first[0])];
  };
  std::size_t traversals = 0;
  for (const Ray& ray : rays_) {
    traversals += RayWalk{lattice, origin_W, ray.end_W}.visit_free(
        [&](const RayWalk::Cell& cell) { brick_of(cell).free |= bit_of(cell); });
    if (ray.is_hit) {
      const auto cell = RayWalk::cell_of(lattice, ray.end_W);
      brick_of(cell).hit |= bit_of(cell);
    }
  }
  return static_cast<double>(traversals);
}

double ScanUpdate::collect_bricks() {
  bricks_.clear();
  double updates = 0.0;
  for (std::size_t i = 0; i < window_.size(); ++i) {
    Brick brick = window_[i];
    if ((brick.free | brick.hit) == 0) {
      continue;
    }
    brick.free &= ~brick.hit;  // a cell that was hit is not freed by the rays that pass it
    updates += count(brick.free) + count(brick.hit);
    const std::size_t row = i / static_cast<std::size_t>(window_size_[0]);
    const std::size_t at[3] = {i % static_cast<std::size_t>(window_size_[0]),
                               row % static_cast<std::size_t>(window_size_[1]),
                               row / static_cast<std::size_t>(window_size_[1])};
    for (unsigned axis = 0; axis < 3; ++axis) {
      brick.code |= spread(at[axis] + static_cast<std::size_t>(first_brick_[axis])) << axis;
    }
    bricks_.push_back(brick);
  }
  std::sort(bricks_.begin(), bricks_.end(),
            [](const Brick& a, const Brick& b) { return a.code < b.code; });
  return updates;
}

}  // namespace flyball

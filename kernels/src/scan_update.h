// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One scan's change to an OctoMap tree: the same rays, cells and result as OctoMap 1.9.7's
/// `insertPointCloud(scan, origin, max_range)`, bit for bit, in less host time.
///
/// Two things differ, and neither can be seen in the tree. Cells are collected in bit masks over
/// the scan's surroundings in place of two hash sets. And they are applied brick by brick (4 x 4 x
/// 4 cells, in Morton order), so that inner nodes are refreshed once for a brick and not once for a
/// cell. The order does not matter to OctoMap: each cell is updated once, and after its last change
/// below, every inner node is pruned or set to its children's maximum.

#include <array>
#include <cstdint>
#include <vector>

#include <octomap/OcTree.h>

namespace flyball {

/// Rays of one scan in W.
struct Scan {
  octomap::point3d origin_W{};
  std::vector<octomap::point3d> hits_W{};
  std::vector<octomap::point3d> clear_W{};  ///< Ends of rays that met nothing.
  double range_m{};                         ///< Rays are cut there, and then mark nothing.
};

class ScanUpdate {
 public:
  struct Counts {
    double rays{};
    double traversals{};  ///< Cells walked, with repeats.
    double updates{};     ///< Unique cells.
  };

  /// Walks the rays over the cells of `lattice`, which is not changed.
  /// @pre Every coordinate within `range_m` of the origin lies inside the lattice.
  /// @cost Memory for two bits per cell of the box around the rays; kept for the next scan.
  Counts compute(const octomap::OcTree& lattice, const Scan& scan);
  /// Applies the change that was computed last, once.
  /// @pre `tree` has the resolution of the lattice.
  void apply(octomap::OcTree& tree);

  /// 64 cells of a tree: those to be freed and those hit. Bit 16 z + 4 y + x.
  struct Brick {
    std::uint64_t code{};  ///< Morton code of the brick: three bits for each tree level.
    std::uint64_t free{};
    std::uint64_t hit{};
  };

 private:
  struct Ray {
    octomap::point3d end_W;
    bool is_hit;
  };
  void cut_rays(const Scan& scan);
  void span_window(const octomap::OcTree& lattice, const octomap::point3d& origin_W);
  double mark_cells(const octomap::OcTree& lattice, const octomap::point3d& origin_W);
  double collect_bricks();

  std::vector<Ray> rays_{};
  std::vector<Brick> window_{};  ///< Dense; bricks of the box around the rays, x fastest.
  std::array<int, 3> first_brick_{};
  std::array<int, 3> window_size_{};
  std::vector<Brick> bricks_{};  ///< Those that change, in Morton order.
};

}  // namespace flyball

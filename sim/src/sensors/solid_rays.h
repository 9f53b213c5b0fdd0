// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How deep a camera sees among a world's solids: boxes, pillars (as prisms of 24 faces) and the
/// ground, not triangles. Tiles of pixels go down a tree of boxes together, near solids first; the
/// rays of a tile are held against a solid only if some of them may meet it before what is met
/// already.

#include "flyball/runtime/messages.h"
#include "flyball/sim/world.h"

#include "sensors/ray_loops.h"
#include <cstddef>
#include <vector>

namespace flyball {

class SolidRays {
 public:
  /// People who stay where they are stand there as pillars.
  explicit SolidRays(const World& world, const RayLoops& loops = *supported_ray_loops().back());

  /// Depth along the optical axis of what each pixel's ray meets first, infinite where that is
  /// beyond the range. Row by row; `depth_m` has a number for each pixel.
  ///
  /// @cost .07 ms for 256 x 144 pixels in `outdoor_to_indoor`, .22 ms among the 27 072 boxes of
  ///       building 079 (one virtual core of an AMD EPYC of the Zen 4 class, AVX-512).
  void look(const Intrinsics& camera, const Pose& X_WC, double range_m, float* depth_m) const;

 private:
  /// Of the tree, depth first: the left child is the next node.
  struct Node {
    Aabb box;
    std::size_t right{};  ///< Of an inner node.
    std::size_t first{};  ///< Of a leaf: in `solids_`.
    std::size_t count{};  ///< 0: an inner node.
  };
  struct Solid {
    Aabb box;
    bool is_pillar{};
  };
  struct Bounds;
  struct Tile;

  void grow(std::size_t first, std::size_t count);
  void look_at_tile(Tile& tile) const;
  void meet(const Node& leaf, Tile& tile) const;
  void meet(const Solid& solid, Tile& tile) const;

  const RayLoops& loops_;
  double ground_z_m_;
  bool has_ground_;
  std::vector<Solid> solids_{};
  std::vector<Node> nodes_{};
};

}  // namespace flyball

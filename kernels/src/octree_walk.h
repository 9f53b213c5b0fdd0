// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Walks down an OctoMap tree, only where a shape is, and shows what the tree says there. Own
/// recursion, because OctoMap's iterators visit whole boxes and skip unknown space.

#include "overlap.h"
#include <array>
#include <cmath>

#include <octomap/OcTree.h>

namespace flyball {

class OctreeWalk {
 public:
  /// The tree outlives the walk.
  explicit OctreeWalk(const octomap::OcTree& tree)
      : tree_{tree}, resolution_m_{tree.getResolution()} {}

  /// Shows each occupied leaf's cube, cut to `region`, that overlaps the shape, near ones first.
  /// Ends when `show(part)` returns true, and says whether it did.
  template <class Shape, class Show>
  bool any_occupied(const Aabb& region, const Shape& shape, Show&& show) const {
    const octomap::OcTreeNode* root = tree_.getRoot();
    return root != nullptr && tree_.isNodeOccupied(root) &&
           occupied_below(*root, whole, scope(region, shape), show);
  }

  /// The same for the cubes of which the tree knows nothing.
  template <class Shape, class Show>
  bool any_unknown(const Aabb& region, const Shape& shape, Show&& show) const {
    const octomap::OcTreeNode* root = tree_.getRoot();
    if (root == nullptr || !boxes_inside(region)) {
      return show(region);
    }
    return tree_.nodeHasChildren(root) && unknown_below(*root, whole, scope(region, shape), show);
  }

 private:
  using Keys = std::array<int, 3>;

  /// A node's cube: its lowest key and its edge, in cells.
  struct Cube {
    Keys base;
    int edge;
  };
  static constexpr int half_keys = 1 << 15;
  static constexpr Cube whole{{0, 0, 0}, 1 << 16};

  template <class Shape>
  struct Scope {
    const Aabb& region;
    const Shape& shape;
    Keys first;  ///< Cells that the region overlaps.
    Keys last;
    Keys focus;
  };

  [[nodiscard]] double keys_from_m(double x) const { return x / resolution_m_ + half_keys; }
  static int clamped(double key) {
    return static_cast<int>(std::clamp(key, 0.0, 2.0 * half_keys - 1.0));
  }

  template <class Shape>
  [[nodiscard]] Scope<Shape> scope(const Aabb& region, const Shape& shape) const {
    Scope<Shape> result{region, shape, {}, {}, {}};
    const Vec3 focus = shape.focus();
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      result.first[i] = clamped(std::floor(keys_from_m(region.min[axis] + touch_m)));
      result.last[i] = clamped(std::ceil(keys_from_m(region.max[axis] - touch_m)) - 1.0);
      result.focus[i] = clamped(std::floor(keys_from_m(focus[axis])));
    }
    return result;
  }

  /// Beyond its 65536 cells a tree knows nothing; a region that reaches there is unknown as a
  /// whole.
  [[nodiscard]] bool boxes_inside(const Aabb& region) const {
    const double edge_m = half_keys * resolution_m_;
    return (region.min.array() >= -edge_m).all() && (region.max.array() <= edge_m).all();
  }

  [[nodiscard]] Aabb part_of(const Cube& cube, const Aabb& region) const {
    const auto at = [&](int axis, int offset) {
      return (cube.base[static_cast<std::size_t>(axis)] + offset - half_keys) * resolution_m_;
    };
    const Aabb box{{at(0, 0), at(1, 0), at(2, 0)},
                   {at(0, cube.edge), at(1, cube.edge), at(2, cube.edge)}};
    return intersection(box, region);
  }

  static Cube child_of(const Cube& cube, unsigned octant) {
    const int half = cube.edge / 2;
    return {{cube.base[0] + ((octant & 1U) != 0 ? half : 0),
             cube.base[1] + ((octant & 2U) != 0 ? half : 0),
             cube.base[2] + ((octant & 4U) != 0 ? half : 0)},
            half};
  }

  /// Bit i is set when octant i holds a cell of the scope.
  template <class Shape>
  static unsigned octants_in(const Cube& cube, const Scope<Shape>& scope) {
    constexpr std::array<unsigned, 3> low{0x55, 0x33, 0x0f};
    unsigned mask = 0xff;
    for (std::size_t i = 0; i < 3; ++i) {
      const int middle = cube.base[i] + cube.edge / 2;
      mask &= scope.last[i] < middle ? low[i] : 0xffU;
      mask &= scope.first[i] >= middle ? ~low[i] : 0xffU;
    }
    return mask;
  }

  /// The octant that contains the focus or lies nearest to it.
  template <class Shape>
  static unsigned nearest_octant(const Cube& cube, const Scope<Shape>& scope) {
    unsigned octant = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      octant |= scope.focus[i] >= cube.base[i] + cube.edge / 2 ? 1U << i : 0U;
    }
    return octant;
  }

  /// Calls `visit(octant, cube)` for the children in the scope, near ones first.
  template <class Shape, class Visit>
  static bool any_child(const Cube& cube, const Scope<Shape>& scope, Visit&& visit) {
    const unsigned mask = octants_in(cube, scope);
    const unsigned nearest = nearest_octant(cube, scope);
    for (unsigned n = 0; n < 8; ++n) {
      const unsigned octant = n ^ nearest;
      if ((mask >> octant & 1U) != 0 && visit(octant, child_of(cube, octant))) {
        return true;
      }
    }
    return false;
  }

  // An inner node holds the largest log-odds below it, so free space ends the recursion early.
  template <class Shape, class Show>
  bool occupied_below(const octomap::OcTreeNode& node,
                      const Cube& cube,
                      const Scope<Shape>& scope,
                      Show& show) const {
    if (!tree_.nodeHasChildren(&node)) {
      return show(part_of(cube, scope.region));
    }
    return any_child(cube, scope, [&](unsigned octant, const Cube& child) {
      if (!tree_.nodeChildExists(&node, octant)) {
        return false;
      }
      const octomap::OcTreeNode* below = tree_.getNodeChild(&node, octant);
      return tree_.isNodeOccupied(below) && scope.shape.overlaps(part_of(child, scope.region)) &&
             occupied_below(*below, child, scope, show);
    });
  }

  template <class Shape, class Show>
  bool unknown_below(const octomap::OcTreeNode& node,
                     const Cube& cube,
                     const Scope<Shape>& scope,
                     Show& show) const {
    return any_child(cube, scope, [&](unsigned octant, const Cube& child) {
      if (!tree_.nodeChildExists(&node, octant)) {
        const Aabb part = part_of(child, scope.region);
        return scope.shape.overlaps(part) && show(part);
      }
      const octomap::OcTreeNode* below = tree_.getNodeChild(&node, octant);
      return tree_.nodeHasChildren(below) && scope.shape.overlaps(part_of(child, scope.region)) &&
             unknown_below(*below, child, scope, show);
    });
  }

  const octomap::OcTree& tree_;
  double resolution_m_;
};

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Walks down an OctoMap tree only where a shape is, and shows what the tree says there: what
/// questions to the brick map are compared with. Own recursion, because OctoMap's iterators visit
/// whole boxes and skip unknown space.

#include "flyball/runtime/occupancy.h"

#include "maps/octomap_tree.h"
#include "visual/overlap.h"
#include <array>

namespace flyball {

/// OctoMap's tree, asked as FrozenTree is.
class OctomapNodes {
 public:
  using Node = octomap::OcTreeNode;
  explicit OctomapNodes(const octomap::OcTree& tree) : tree_{tree} {}

  [[nodiscard]] double cell_m() const { return tree_.getResolution(); }
  [[nodiscard]] const Node* root() const { return tree_.getRoot(); }
  [[nodiscard]] bool has_children(const Node& node) const { return tree_.nodeHasChildren(&node); }
  /// Null where there is none.
  [[nodiscard]] const Node* child(const Node& node, unsigned octant) const {
    return tree_.nodeChildExists(&node, octant) ? tree_.getNodeChild(&node, octant) : nullptr;
  }
  [[nodiscard]] bool is_occupied(const Node& node) const { return tree_.isNodeOccupied(&node); }

 private:
  const octomap::OcTree& tree_;
};

class OctreeWalk {
 public:
  /// The tree outlives the walk.
  explicit OctreeWalk(const octomap::OcTree& tree)
      : tree_{tree}, resolution_m_{tree_.cell_m()}, cells_per_m_{1.0 / resolution_m_} {}

  /// Shows each occupied leaf's cube, cut to `region`, that overlaps the shape, near ones first.
  /// Ends when `show(part)` returns true, and says whether it did.
  template <class Shape, class Show>
  [[nodiscard]] bool any_occupied(const Aabb& region, const Shape& shape, Show&& show) const {
    const Node* root = tree_.root();
    return root != nullptr &&
           occupied_below({root, {0, 0, 0}, all_keys}, scope(region, shape), show);
  }

  /// The same for the cubes of which the tree knows nothing.
  template <class Shape, class Show>
  [[nodiscard]] bool any_unknown(const Aabb& region, const Shape& shape, Show&& show) const {
    const Node* root = tree_.root();
    if (root == nullptr || !contains(region)) {
      return show(region);
    }
    return unknown_below({root, {0, 0, 0}, all_keys}, scope(region, shape), show);
  }

 private:
  using Node = OctomapNodes::Node;
  using Keys = std::array<int, 3>;
  static constexpr int all_keys = 1 << 16;
  static constexpr int half_keys = all_keys / 2;

  /// A node with its cube: lowest key and edge, in cells. No node: a cube that is not known.
  struct Cube {
    const Node* node;
    Keys base;
    int edge;
  };

  template <class Shape>
  struct Scope {
    const Aabb& region;
    const Shape& shape;
    Keys first;  ///< Cells that the region overlaps.
    Keys last;
    Keys focus;
  };

  [[nodiscard]] int key(double x) const {
    return static_cast<int>(std::clamp(x * cells_per_m_ + half_keys, 0.0, all_keys - 1.0));
  }

  template <class Shape>
  [[nodiscard]] Scope<Shape> scope(const Aabb& region, const Shape& shape) const {
    const auto keys = [this](const Vec3& p) { return Keys{key(p.x()), key(p.y()), key(p.z())}; };
    const Vec3 margin = Vec3::Constant(touch_m);
    return {region, shape, keys(region.min + margin), keys(region.max - margin),
            keys(shape.focus())};
  }

  /// Beyond its 65536 cells a tree knows nothing; a region that reaches there is unknown as a
  /// whole.
  [[nodiscard]] bool contains(const Aabb& region) const {
    const double edge_m = half_keys * resolution_m_;
    return (region.min.array() >= -edge_m).all() && (region.max.array() <= edge_m).all();
  }

  [[nodiscard]] Aabb box_of(const Cube& cube) const {
    const auto corner = [&](int offset) {
      return Vec3{(cube.base[0] + offset - half_keys) * resolution_m_,
                  (cube.base[1] + offset - half_keys) * resolution_m_,
                  (cube.base[2] + offset - half_keys) * resolution_m_};
    };
    return {corner(0), corner(cube.edge)};
  }

  [[nodiscard]] Cube child_of(const Cube& cube, unsigned octant) const {
    const int half = cube.edge / 2;
    return {tree_.child(*cube.node, octant),
            {cube.base[0] + ((octant & 1U) != 0 ? half : 0),
             cube.base[1] + ((octant & 2U) != 0 ? half : 0),
             cube.base[2] + ((octant & 4U) != 0 ? half : 0)},
            half};
  }

  /// The octant of a cube in which a key lies or, from outside, to which it is nearest.
  static unsigned octant_of(const Cube& cube, const Keys& key) {
    unsigned octant = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      octant |= key[i] >= cube.base[i] + cube.edge / 2 ? 1U << i : 0U;
    }
    return octant;
  }

  /// Goes down from a known cube, as long as one octant holds all of the scope, `more(cube)` is
  /// true and the cube has children. Most of a query's levels pass here, so this is kept tight.
  template <class Shape, class More>
  [[nodiscard]] Cube descended(Cube cube, const Scope<Shape>& scope, More&& more) const {
    int differing = 0;
    Keys first{};
    for (std::size_t i = 0; i < 3; ++i) {
      first[i] = std::max(scope.first[i], cube.base[i]);
      differing |= first[i] ^ std::min(scope.last[i], cube.base[i] + cube.edge - 1);
    }
    while (cube.node != nullptr && cube.edge / 2 > differing && more(cube) &&
           tree_.has_children(*cube.node)) {
      cube = child_of(cube, octant_of(cube, first));
    }
    return cube;
  }

  /// Visits the children that overlap the shape, near ones first.
  template <class Shape, class Visit>
  [[nodiscard]] bool any_child(const Cube& cube, const Scope<Shape>& scope, Visit&& visit) const {
    const unsigned nearest = octant_of(cube, scope.focus);
    const unsigned low = octant_of(cube, scope.first);
    const unsigned high = octant_of(cube, scope.last);
    for (unsigned n = 0; n < 8; ++n) {
      const unsigned octant = n ^ nearest;
      if ((octant & low) != low || (octant & ~high) != 0) {
        continue;
      }
      const Cube child = child_of(cube, octant);
      if (scope.shape.overlaps(box_of(child)) && visit(child)) {
        return true;
      }
    }
    return false;
  }

  template <class Shape, class Show>
  [[nodiscard]] bool show_part(const Cube& cube, const Scope<Shape>& scope, Show& show) const {
    const Aabb part = intersection(box_of(cube), scope.region);
    return scope.shape.overlaps(part) && show(part);
  }

  // An inner node holds the largest log-odds below it, so free space ends the recursion early.
  template <class Shape, class Show>
  [[nodiscard]] bool occupied_below(const Cube& top, const Scope<Shape>& scope, Show& show) const {
    const auto is_occupied = [this](const Cube& cube) { return tree_.is_occupied(*cube.node); };
    const Cube cube = descended(top, scope, is_occupied);
    if (cube.node == nullptr || !is_occupied(cube)) {
      return false;
    }
    if (!tree_.has_children(*cube.node)) {
      return show_part(cube, scope, show);
    }
    return any_child(cube, scope, [&](const Cube& child) {
      return child.node != nullptr && occupied_below(child, scope, show);
    });
  }

  template <class Shape, class Show>
  [[nodiscard]] bool unknown_below(const Cube& top, const Scope<Shape>& scope, Show& show) const {
    const Cube cube = descended(top, scope, [](const Cube&) { return true; });
    if (cube.node == nullptr) {
      return show_part(cube, scope, show);
    }
    return tree_.has_children(*cube.node) && any_child(cube, scope, [&](const Cube& child) {
             return unknown_below(child, scope, show);
           });
  }

  OctomapNodes tree_;
  double resolution_m_;
  double cells_per_m_;
};

/// Questions to a tree.
class OctreeView {
 public:
  /// The tree outlives the view.
  explicit OctreeView(const octomap::OcTree& tree) : tree_{tree}, walk_{tree} {}

  [[nodiscard]] CellState state(const Vec3& p_W) const {
    const octomap::OcTreeNode* node = tree_.search(p_W.x(), p_W.y(), p_W.z());
    return node == nullptr              ? CellState::unknown
           : tree_.isNodeOccupied(node) ? CellState::occupied
                                        : CellState::free;
  }
  [[nodiscard]] CellState body_state(const Vec3& p_WB, const Cylinder& body) const {
    const BodyShape shape{p_WB, body};
    const auto any = [](const Aabb&) { return true; };
    return walk_.any_occupied(shape.bounds(), shape, any)  ? CellState::occupied
           : walk_.any_unknown(shape.bounds(), shape, any) ? CellState::unknown
                                                           : CellState::free;
  }
  [[nodiscard]] bool segment_hits(const Vec3& from, const Vec3& to, const Cylinder& body) const {
    const SweepShape shape{from, to, body};
    return walk_.any_occupied(shape.bounds(), shape, [](const Aabb&) { return true; });
  }

 private:
  const octomap::OcTree& tree_;
  OctreeWalk walk_;
};

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Several OctoMap trees of different resolutions, seen as one map.
///
/// The tree used last answers. For a cube that it does not know, of whatever size, the tree used
/// before it answers, cut to that cube, and so on. A coarser tree's occupied cube does not say
/// which of the finer cells in it is occupied: where it answers for a finer tree it stands for
/// unknown, so that a planner may look there for a door, and the guard still does not go. (Density
/// and nearest obstacle take it as it is.) A coarse tree's free cube may hold a wall as well: a
/// layer can name those that surely do not (bricks/clear_cells.h), and then the others stand for
/// unknown, too, where it answers for a finer tree. What no tree knows is unknown, except inside
/// the cylinders that were declared clear. A place that is not finite is unknown, a way there is
/// blocked.

#include "flyball/runtime/occupancy.h"

#include "overlap.h"
#include <cstdint>
#include <functional>
#include <vector>

namespace octomap {
class OcTree;
}  // namespace octomap

namespace flyball {

class OctomapView final : public OccupancyView {
 public:
  /// Cylinders that are kept; past it the oldest of the thinnest goes.
  static constexpr std::size_t max_clear = 16;

  /// A tree, and where those of its free cells stand that can be trusted where it answers for a
  /// finer one. Null: in the tree itself.
  struct Layer {
    const octomap::OcTree* tree;
    const octomap::OcTree* trusted_by_finer;
  };
  /// Makes the layer the one that answers first. Its trees outlive the view.
  void activate(const Layer& layer);
  void activate(const octomap::OcTree& tree) { activate({&tree, nullptr}); }
  /// Back to knowing no tree.
  void forget_trees() { layers_.clear(); }
  /// Ignored when an earlier cylinder contains it.
  void declare_clear(const Vec3& centre_W, const Cylinder& space);

  struct Clear {
    Vec3 centre_W;
    Cylinder space;
  };
  [[nodiscard]] const std::vector<Clear>& declared() const { return clear_; }

  /// Of the active tree; `initial_resolution_m` before there is one.
  [[nodiscard]] double resolution_m() const override;
  [[nodiscard]] CellState state(const Vec3& p_W) const override;
  /// An unknown part of the body counts as free when declared cylinders cover it. It is taken
  /// apart, down to 2 cm, and each piece must lie in one cylinder: its own box, or the body's disc
  /// and the piece's height.
  [[nodiscard]] CellState body_state(const Vec3& p_WB, const Cylinder& body) const override;
  [[nodiscard]] bool has_occupied(const Aabb& box) const override;
  [[nodiscard]] bool segment_hits(const Vec3& from,
                                  const Vec3& to,
                                  const Cylinder& body) const override;
  [[nodiscard]] double obstacle_density(const Vec3& p_W,
                                        double radius_m,
                                        double half_band_m) const override;
  [[nodiscard]] double nearest_obstacle_m(const Vec3& p_W,
                                          double limit_m,
                                          double half_band_m) const override;

  /// Shows the cubes of all occupied leaves that count: those of the active tree, and those of the
  /// others that lie at least in part where no later tree knows better.
  void for_each_occupied(const std::function<void(const Aabb& cube)>& show) const;

  static constexpr double initial_resolution_m = 0.15;

 private:
  /// What a coarser tree's occupied cube stands for: unknown for whoever moves, an obstacle for
  /// whoever looks around.
  enum class Use : std::uint8_t { move, look };
  struct Layers {
    std::size_t count;
    Use use;
  };

  [[nodiscard]] bool is_vague(std::size_t layer, Use use) const;
  /// The tree whose free cells count.
  [[nodiscard]] const octomap::OcTree& known(std::size_t layer, Use use) const;
  /// Shows the parts of `region` in the shape that none of the first `layers.count` trees knows.
  template <class Shape, class Show>
  [[nodiscard]] bool any_gap(Layers layers,
                             const Aabb& region,
                             const Shape& shape,
                             Show&& show) const;
  template <class Shape, class Show>
  [[nodiscard]] bool any_gap_from(
      std::size_t layer, Layers layers, const Aabb& region, const Shape& shape, Show& show) const;
  /// Shows the occupied parts in the shape, each cut to where its tree is the one that answers.
  template <class Shape, class Show>
  [[nodiscard]] bool any_obstacle(const Shape& shape, Use use, Show&& show) const;
  template <class Shape>
  [[nodiscard]] bool hits(const Shape& shape, Use use) const;

  struct Columns;
  [[nodiscard]] int occupied_columns(const Columns& block) const;
  [[nodiscard]] bool is_cleared(const Aabb& part, const BodyShape& body) const;
  [[nodiscard]] bool is_in_clear(const Aabb& part, const BodyShape& body) const;

  std::vector<Layer> layers_{};  ///< The active one first.
  std::vector<Clear> clear_{};
};

}  // namespace flyball

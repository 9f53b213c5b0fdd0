// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Several maps of different resolutions, seen as one.
///
/// The map used last answers. For a cube that it does not know, of whatever size, the map used
/// before it answers, cut to that cube, and so on. A coarser map's occupied cube does not say
/// which of the finer cells in it is occupied: where it answers for a finer map it stands for
/// unknown, so that a planner may look there for a door, and the guard still does not go. (Density
/// and nearest obstacle take it as it is.) A coarse map's free cube may hold a wall as well: a
/// layer can name those that surely do not (scans/clear_cells.h), and then the others stand for
/// unknown, too, where it answers for a finer map. What no map knows is unknown, except inside
/// the cylinders that were declared clear. A place that is not finite is unknown, and a path there
/// is blocked.

#include "flyball/runtime/occupancy.h"

#include "scans/clear_spaces.h"
#include <cstdint>
#include <functional>
#include <vector>

namespace flyball {

class BrickCells;

class LayeredView final : public OccupancyView {
 public:
  /// A map, at its finest level, and where those of its free cells stand that can be trusted where
  /// it answers for a finer one. Null: in the map itself.
  struct Layer {
    const BrickCells* cells;
    const BrickCells* trusted_by_finer;
  };
  /// Makes the layer the one that answers first. Its maps outlive the view.
  void activate(const Layer& layer);
  void activate(const BrickCells& cells) { activate({&cells, nullptr}); }
  /// Asks it no more.
  void forget(const BrickCells& cells);
  /// The active one first.
  [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
  /// Back to knowing no map.
  void forget_layers() { layers_.clear(); }
  /// Ignored when an earlier cylinder contains it.
  void declare_clear(const Vec3& centre_W, const Cylinder& space) {
    clear_.declare(centre_W, space);
  }
  [[nodiscard]] const ClearSpaces& declared() const { return clear_; }
  void declare_clear(const ClearSpaces& spaces) { clear_ = spaces; }

  /// Of the active map; `initial_resolution_m` before there is one.
  [[nodiscard]] double resolution_m() const override;
  [[nodiscard]] CellState state(const Vec3& p_W) const override;
  /// An unknown part of the body counts as free when declared cylinders cover it. It is taken
  /// apart, down to 19 mm, and each piece must lie in one cylinder: its own box, or the body's disc
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

  /// Shows all occupied cells that count: those of the active map, and those of the
  /// others that lie at least in part where no later map knows better.
  void for_each_occupied(const std::function<void(const Aabb& cube)>& show) const;

  static constexpr double initial_resolution_m = 0.15;

 private:
  /// What a coarser map's occupied cube stands for: unknown space for planning and collision
  /// checks, an obstacle for queries about the surroundings.
  enum class Use : std::uint8_t { move, look };
  struct Layers {
    std::size_t count;
    Use use;
  };

  [[nodiscard]] bool is_vague(std::size_t layer, Use use) const;
  /// Of a layer that answers for a finer one: where its free cells stand. Else null.
  [[nodiscard]] const BrickCells* trusted(std::size_t layer, Use use) const;
  [[nodiscard]] bool is_plainly_free(const Aabb& box) const;
  /// Shows the parts of `region` in the shape that none of the first `layers.count` maps knows.
  template <class Shape, class Show>
  [[nodiscard]] bool any_gap(Layers layers,
                             const Aabb& region,
                             const Shape& shape,
                             Show&& show) const;
  template <class Shape, class Show>
  [[nodiscard]] bool any_gap_from(
      std::size_t layer, Layers layers, const Aabb& region, const Shape& shape, Show& show) const;
  /// Shows the occupied parts in the shape, each cut to where its map is the one that answers.
  template <class Shape, class Show>
  [[nodiscard]] bool any_obstacle(const Shape& shape, Use use, Show&& show) const;
  template <class Shape>
  [[nodiscard]] bool hits(const Shape& shape, Use use) const;

  std::vector<Layer> layers_{};  ///< The active one first.
  ClearSpaces clear_{};
};

}  // namespace flyball

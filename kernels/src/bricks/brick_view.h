// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The brick map as planner, collision check and guard see it, at the active level.
///
/// A cell of that level is occupied, and blocks with its full cube, when any part of it is. In a
/// cell without an obstacle every finest cell answers for itself: what was seen is free, the rest
/// is unknown, except inside the cylinders that were declared clear. (So a coarse cell is free as a
/// whole only when no part of it is unknown, and a switch to a coarser level forgets nothing.) A
/// place that is not finite is unknown, and a path there is blocked.

#include "flyball/kernels/inflated_window.h"
#include "flyball/runtime/occupancy.h"

#include "brick_cells.h"
#include "scans/clear_spaces.h"
#include <functional>
#include <memory>
#include <optional>

namespace flyball {

class BodyShape;
class BoxWords;

class BrickView final : public OccupancyView, public Inflatable {
 public:
  /// The map outlives the view.
  explicit BrickView(const BrickCells& map) : map_{map} { activate(0); }
  /// The same view of another map.
  BrickView(const BrickCells& map, const BrickView& like) : map_{map}, clear_{like.clear_} {
    activate(like.level_);
  }

  /// Which cells block from now on: 0..5. Costs nothing.
  void activate(int level);
  [[nodiscard]] int level() const { return level_; }
  /// What this view shows now, of cells that stay as they are. Its owners are those who hold copies
  /// of the pointer.
  [[nodiscard]] std::shared_ptr<const OccupancyView> of_revision(
      std::shared_ptr<const BrickCells> cells) const;
  /// Ignored when an earlier cylinder contains it.
  void declare_clear(const Vec3& centre_W, const Cylinder& space) {
    clear_.declare(centre_W, space);
  }

  [[nodiscard]] double resolution_m() const override { return map_.lattice().cell_m(level_); }
  [[nodiscard]] CellState state(const Vec3& p_W) const override;
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

  void inflate(const Aabb& box_W,
               const Cylinder& body,
               Obstruction by,
               InflatedWindow& window) const override;

  /// Shows the cubes of all occupied cells of the active level, in an order that the scans decide.
  void for_each_occupied(const std::function<void(const Aabb& cube)>& show) const;

 private:
  [[nodiscard]] CellState seen_at(const Chunk& chunk, PackedCell cell) const;
  [[nodiscard]] CellState far_state(const Vec3& p_W, PackedCell cell) const;
  [[nodiscard]] CellState unseen_state(const Vec3& p_W) const;
  [[nodiscard]] std::optional<CellState> seen_by(const BodyShape& shape) const;
  [[nodiscard]] CellState seen_by_disc(const BodyShape& shape, const BoxWords& words) const;
  [[nodiscard]] CellState beyond_clear(const BodyShape& shape) const;

  const BrickCells& map_;
  ClearSpaces clear_{};
  int level_{};
  const std::uint8_t* answers_{};  ///< By codes of bricks, at this level.
};

}  // namespace flyball

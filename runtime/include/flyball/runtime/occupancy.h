// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What planner, collision check and guard ask of a map. One rule for all: an occupied cell blocks
/// with its full cube, and unknown is never reported as free.

#include "flyball/runtime/geometry.h"

#include <cstdint>

namespace flyball {

/// Ordered from best to worst.
enum class CellState : std::uint8_t { free, unknown, occupied };

class OccupancyView {
 public:
  OccupancyView() = default;
  OccupancyView(const OccupancyView&) = delete;
  OccupancyView& operator=(const OccupancyView&) = delete;
  virtual ~OccupancyView() = default;

  [[nodiscard]] virtual double resolution_m() const = 0;
  [[nodiscard]] virtual CellState state(const Vec3& p_W) const = 0;
  /// The worst state among the cells whose cube the body's cylinder around `p_WB` overlaps.
  [[nodiscard]] virtual CellState body_state(const Vec3& p_WB, const Cylinder& body) const = 0;
  /// Whether an occupied cube overlaps the box.
  [[nodiscard]] virtual bool has_occupied(const Aabb& box) const = 0;
  /// Whether an occupied cube overlaps the body anywhere on the segment (exact: no gaps).
  [[nodiscard]] virtual bool segment_hits(const Vec3& from,
                                          const Vec3& to,
                                          const Cylinder& body) const = 0;
  /// Share of the .8 m columns within `radius_m` of `p_W` (altitude band ± `half_band_m`) that hold
  /// an occupied cell, 0..1. The column size is fixed, so that the figure means the same at every
  /// map resolution.
  [[nodiscard]] virtual double obstacle_density(const Vec3& p_W,
                                                double radius_m,
                                                double half_band_m) const = 0;
  /// Distance from `p_W` to the nearest occupied cube in the altitude band; `limit_m` when none is
  /// nearer.
  [[nodiscard]] virtual double nearest_obstacle_m(const Vec3& p_W,
                                                  double limit_m,
                                                  double half_band_m) const = 0;
};

}  // namespace flyball

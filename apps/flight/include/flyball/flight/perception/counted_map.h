// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a node asks the map beside its kernels, so that this work has a price as well.

#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/work.h"

namespace flyball {

/// The price list (`NodeSpec::cost`) of nodes that do nothing but ask the map.
inline constexpr const char* map_queries_cost = "map_queries";

/// Hands each question on to the map, and counts it.
class CountedMap final : public OccupancyView {
 public:
  /// @param map  Outlives this.
  explicit CountedMap(const OccupancyView& map) : map_{map} {}

  [[nodiscard]] double resolution_m() const override { return map_.resolution_m(); }
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

  /// Adds what was asked so far: `cells` (states of single cells), `poses` (states of a body),
  /// `collision_queries` (boxes and segments), `densities` and `distances` (to the nearest
  /// obstacle). What was not asked for is not added.
  void add_to(Work& work) const;

 private:
  const OccupancyView& map_;
  // Questions do not change the map, so those who ask hold it as constant.
  mutable double cells_{};
  mutable double poses_{};
  mutable double collision_queries_{};
  mutable double densities_{};
  mutable double distances_{};
};

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a planner asks of a map, and how often it asked.

#include "flyball/kernels/inflated_window.h"
#include "flyball/runtime/occupancy.h"

#include <optional>

namespace flyball {

class MotionChecker {
 public:
  /// The map outlives the checker.
  MotionChecker(const OccupancyView& map, const Cylinder& body, double max_slope_rad);

  /// Says where the next motions will be. When there have been many of them and the map can be
  /// grown by the body, that is done once, and a line that crosses no bit of the window is free
  /// without a closer look. The answers, and what is counted, stay the same.
  void expect_motions_in(const Aabb& box_W);

  /// No occupied cube overlaps the body; unknown space counts as free.
  [[nodiscard]] bool is_free(const Vec3& p_WB);
  /// The straight piece is not too steep and hits nothing. Pieces shorter than .3 m may be steeper:
  /// a corner's height may be mended there, and a camera does not notice.
  [[nodiscard]] bool is_flyable(const Vec3& from_W, const Vec3& to_W);
  /// Distance to the nearest obstacle at the body's height, at most `limit_m`.
  [[nodiscard]] double clearance_m(const Vec3& p_WB, double limit_m);
  /// A look at one cell: does something occupied overlap the box?
  [[nodiscard]] bool has_occupied(const Aabb& box);

  [[nodiscard]] const Cylinder& body() const { return body_; }
  [[nodiscard]] double resolution_m() const { return map_.resolution_m(); }
  /// Body queries so far; looks at cells count in proportion to what they cost.
  [[nodiscard]] double queries() const { return queries_; }

 private:
  [[nodiscard]] bool hits(const Vec3& from_W, const Vec3& to_W);

  const OccupancyView& map_;
  const Inflatable* inflatable_;  ///< The same map; null if it cannot be grown.
  Cylinder body_;
  double max_rise_;  ///< Height per horizontal distance.
  double queries_{};
  std::optional<Aabb> expected_{};
  int motions_{};  ///< Since they are expected there.
  InflatedWindow window_{};
};

}  // namespace flyball

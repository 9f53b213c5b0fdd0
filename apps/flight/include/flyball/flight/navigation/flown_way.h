// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The way by which the vehicle has come.

#include "flyball/runtime/geometry.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace flyball {

/// What is nearer than this to the way is on it. Chosen: there is no wall between.
constexpr double beside_way_m = 1.0;

/// A way that was flown is free, as long as obstacles do not move, so on the way home no other need
/// be searched for. Loops of it are left out.
class FlownWay {
 public:
  /// The vehicle follows its path and is here.
  void flew(const Vec3& p_W);
  /// Whether it passes near this goal.
  [[nodiscard]] bool leads_to(const Vec3& goal_W) const;
  /// From the start along the way to the place nearest to the goal; empty where it does not lead
  /// there, or the start is not beside it.
  ///
  /// @param most_m  So much of it, at most; 0: all.
  [[nodiscard]] std::vector<Vec3> between(const Vec3& start_W,
                                          const Vec3& goal_W,
                                          double most_m) const;

 private:
  void go_on_from(const Vec3& p_W);
  /// The place on it that is nearest to `p_W`, if it is no farther away than this.
  [[nodiscard]] std::optional<std::size_t> nearest(const Vec3& p_W, double within_m) const;

  std::vector<Vec3> places_W_{};  ///< Oldest first.
};

}  // namespace flyball

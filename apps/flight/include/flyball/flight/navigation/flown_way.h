// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The way by which the vehicle has come.

#include "flyball/runtime/geometry.h"

#include <vector>

namespace flyball {

/// A way that was flown is free, as long as obstacles do not move, so on the way home no other need
/// be searched for. Loops of it are left out.
class FlownWay {
 public:
  /// The vehicle follows its path and is here.
  void flew(const Vec3& p_W);
  /// Whether it passes near this goal.
  [[nodiscard]] bool leads_to(const Vec3& goal_W) const;
  /// Its part between the places nearest to `start_W` and to `goal_W`, in this order; empty where
  /// it does not lead there.
  [[nodiscard]] std::vector<Vec3> between(const Vec3& start_W, const Vec3& goal_W) const;

 private:
  std::vector<Vec3> places_W_{};  ///< Oldest first.
};

}  // namespace flyball

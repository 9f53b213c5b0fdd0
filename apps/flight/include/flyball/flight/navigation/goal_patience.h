// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How long a vehicle tries to reach a goal.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/time.h"

#include <limits>
#include <optional>
#include <vector>

namespace flyball {

/// A vehicle gives up where it has stood without a path for `limit_s`. Where it has doubted
/// obstacles, the map shows paths through walls that are not seen again yet, and before a closed
/// door the vehicle would try them until its battery is empty. So there it also gives up when it
/// has come no nearer to the goal for some of these limits.
class GoalPatience {
 public:
  explicit GoalPatience(double limit_s) : limit_s_{limit_s} {}

  /// The way to a new goal begins.
  void begin(MissionTime now);
  /// The way to the same goal goes on after something else: the time for it begins anew.
  void resume(MissionTime now);
  /// Whether obstacles around this place may be doubted once more. If so, it has been noted: walls
  /// are seen again and close the way as before, so a few times are enough.
  [[nodiscard]] bool may_doubt(const Vec3& here_W);
  /// @param to_goal_m  On the straight line; none where there is no goal, or the vehicle has
  /// arrived.
  /// @param rests      The vehicle stands.
  /// @return           Whether the vehicle gives up.
  [[nodiscard]] bool note(MissionTime now, std::optional<double> to_goal_m, bool rests);
  /// Whether the vehicle has come no nearer to the goal for a whole limit.
  [[nodiscard]] bool comes_no_nearer(MissionTime now) const {
    return to_seconds(now - nearer_since_) > limit_s_;
  }

 private:
  double limit_s_;
  MissionTime without_path_since_{};
  MissionTime nearer_since_{};  ///< When the vehicle came to `nearest_m_`.
  double nearest_m_{std::numeric_limits<double>::infinity()};  ///< To the goal, so far.
  std::vector<Vec3> doubted_W_{};                              ///< Places, on the way to it.
};

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where the localizer's world lies in the frame that the flight controller flies in.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/time.h"

#include <deque>
#include <optional>

namespace flyball {

/// The flight controller keeps the vehicle at its set-points by an estimate of its own, in a frame
/// O. The flight plans in the localizer's world W, which drifts against O, and jumps where a place
/// is seen again: "odom" and "map" of REP 105, whose X_OW this is. Both see the same vehicle at the
/// same time, so X_OW does not depend on where the vehicle is flown, and set-points that are
/// carried over by it make no second control loop beside the controller's. In flight X_OW changes
/// slowly, because set-points must not jump; rotations are about the vehicle, because far from the
/// origin a small one would throw it aside. Only yaw is turned: both know which way is down.
class OdometryFrame {
 public:
  /// The controller's estimate at a time of the mission. Times do not fall.
  void note(MissionTime now, const Pose& X_OB);
  /// The localizer's estimate. One that is not finite, or older than a second or
  /// than what was noted, is left out.
  /// @param is_standing  Nothing is flown, so that X_OW may jump.
  void localized(const PoseEstimate& where, bool is_standing);
  /// A set-point of W in O.
  [[nodiscard]] Setpoint in_odometry(const Setpoint& setpoint) const;

 private:
  struct Noted {
    MissionTime at{};
    Pose X_OB{Pose::Identity()};
  };
  [[nodiscard]] const Pose* controller_at(MissionTime at) const;

  std::deque<Noted> noted_{};
  Pose X_OW_{Pose::Identity()};
  std::optional<MissionTime> last_{};  ///< Of the localizer's estimates.
};

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Path tracking: a reference that moves along a path, corrected by where the vehicle is.

#include "flyball/runtime/kernel.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/trajectory.h"

namespace flyball {

/// The reference on the path.
struct PathReference {
  double s_m{};
  double speed_m_s{};
  double acceleration_m_s2{};
  double yaw_rad{};
};

class PathTracker : public Kernel {
 public:
  /// Position, velocity and acceleration to command: the reference's own, plus error feedback on
  /// the velocity. `now` stamps the set-point.
  [[nodiscard]] virtual Setpoint track(const Path& path,
                                       const PathReference& reference,
                                       const PoseEstimate& where,
                                       MissionTime now) = 0;
};

}  // namespace flyball

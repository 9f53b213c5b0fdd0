// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From the last visual fix to now.

#include "flyball/kernels/localizer.h"
#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/messages.h"

#include <deque>

namespace flyball {

/// A fix is as old as the camera's interval and the computer together. Until the next one the
/// vehicle goes on as fast as the fix said, and turns as the flight controller's attitude does.
/// After half a second without a fix the position stands: it is not known, and the error grows.
class DeadReckoning {
 public:
  void start(const Pose& X_WB);
  void correct(const VisualFix& fix);
  [[nodiscard]] PoseEstimate estimate(const NavigationSample& sample);

 private:
  struct Attitude {
    MissionTime stamp;
    Eigen::Quaterniond q_WB;
  };
  [[nodiscard]] Eigen::Quaterniond attitude_at(MissionTime t) const;

  std::deque<Attitude> attitudes_;  ///< Of the last seconds.
  std::optional<VisualFix> fix_{};  ///< The last one that was tracked.
  Pose X_WB_start_{Pose::Identity()};
};

/// A localizer that sees knows a place per frame; between frames it reckons.
class SeeingLocalizer : public Localizer {
 public:
  void correct(const VisualFix& fix) final { reckoning_.correct(fix); }
  PoseEstimate estimate(const NavigationSample& sample, Work& work) final {
    work.add("samples", 1.0);
    return reckoning_.estimate(sample);
  }

 protected:
  DeadReckoning reckoning_;
};

}  // namespace flyball

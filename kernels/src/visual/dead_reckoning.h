// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From the last visual fix to now.

#include "flyball/kernels/localizer.h"
#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/messages.h"

#include "visual/climb_filter.h"
#include <deque>

namespace flyball {

/// A fix is as old as the camera's interval and the computer together. Until the next one the
/// vehicle goes on as fast as the fix said, climbs as the barometer says, and turns as the flight
/// controller's attitude does. After half a second without a fix the place over ground stands: it
/// is not known, and the error grows. The height goes on.
class DeadReckoning {
 public:
  void start(const Pose& X_WB);
  void correct(const VisualFix& fix);
  [[nodiscard]] PoseEstimate estimate(const NavigationSample& sample);

 private:
  struct Sample {
    MissionTime stamp;
    Eigen::Quaterniond q_WB;
    double height_m;  ///< By the barometer.
  };
  void add_sample(const NavigationSample& sample);
  /// Where it was at a time of the last five seconds, as far as is known now.
  [[nodiscard]] Pose pose_at(MissionTime t) const;
  [[nodiscard]] const Sample& sample_at(MissionTime t) const;

  std::deque<Sample> samples_;  ///< In the last seconds.
  ClimbFilter climb_{};
  bool has_barometer_{};
  double height_then_m_{};          ///< At the start, later at the fix.
  std::optional<VisualFix> fix_{};  ///< The last one that was tracked.
  /// By the first sample at or after the fix, which is kept because a fix may grow older than the
  /// samples. Empty: no sample is that new.
  std::optional<Eigen::Quaterniond> q_WB_then_{};
  Pose X_WB_start_{Pose::Identity()};
};

/// A localizer that uses images knows a pose per frame, and dead reckoning carries it on between
/// frames. What it reckons with is out of reach of `track_frame`, which another thread may call.
class VisualLocalizer : public Localizer {
 public:
  void correct(const VisualFix& fix) final { reckoning_.correct(fix); }
  std::optional<PoseEstimate> estimate(const NavigationSample& sample, Work& work) final {
    work.add("samples", 1.0);
    return reckoning_.estimate(sample);
  }

 protected:
  /// Where the vehicle stands.
  void reckon_from(const Pose& X_WB) { reckoning_.start(X_WB); }

 private:
  DeadReckoning reckoning_;
};

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A path from images and inertial measurements.

#include "visual/feature_tracks.h"
#include "visual/inertial_filter.h"
#include "visual/landmark_update.h"
#include "visual/standstill.h"
#include <map>

namespace flyball {

struct OdometryOutcome {
  /// Saw enough within the last second and a half, makes sense, and knows its speed to .5 m/s; to
  /// .2 m/s when nothing that was seen has corrected it for as long. The IMU does not contradict
  /// the images for a second.
  bool tracked{};
  int tracks{};    ///< Points in the newest image that were in the one before.
  int believed{};  ///< Tracks that corrected the filter.
};

/// Multi-state constraint Kalman filter: Mourikis & Roumeliotis 2007. Corners are followed from
/// image to image; when one is out of view, or as old as the window, it binds the poses that saw
/// it. Depth is used where the frame has it. No map and no loops: the error grows with the path.
class InertialOdometry {
 public:
  InertialOdometry();

  /// At rest here; without a pose, level as the accelerometer says, at the origin.
  void start(const std::optional<Pose>& X_WB);
  void add_imu_sample(const ImuSample& sample);
  /// Adds `pixels`, `features`, `tracks` and `filter_updates` (rows times columns squared) to
  /// `work`.
  /// @error As `FeatureTracks::follow`.
  [[nodiscard]] Result<OdometryOutcome> track_frame(const VisualFrame& frame, Work& work);
  [[nodiscard]] const InertialFilter& filter() const { return filter_; }

 private:
  /// The same image again, while the IMU says that the body moves: the camera hangs.
  [[nodiscard]] bool is_stale(const VisualFrame& frame) const;
  void look(const VisualFrame& frame,
            const std::vector<TrackedPoint>& points,
            OdometryOutcome& outcome,
            Work& work);
  [[nodiscard]] bool makes_sense() const;
  [[nodiscard]] bool is_due(MissionTime now) const;
  void begin(MissionTime now);
  void advance(MissionTime to);
  void propagate(const ImuSample& sample, MissionTime to);
  /// Before it has moved: that it stands is a measurement.
  void stand();
  /// Later: so is that it hardly moves. @return Whether that told something.
  bool hold(const SlowView& view, double focal_px);
  [[nodiscard]] bool knows_speed() const;
  void note(const std::vector<TrackedPoint>& points);
  /// How many points were in the image before; they tell whether the body has moved.
  int watch_for_motion(const std::vector<TrackedPoint>& points);
  [[nodiscard]] std::optional<Innovation> told_by(const std::vector<Glimpse>& glimpses,
                                                  double ray_sigma) const;
  int use_tracks(double ray_sigma, Work& work);
  [[nodiscard]] std::vector<std::uint64_t> finished() const;
  void forget_oldest();

  FeatureTracks tracks_;
  RestWatch rest_{};
  InertialFilter filter_;
  std::map<std::uint64_t, std::vector<Glimpse>> seen_{};
  std::vector<ImuSample> waiting_{};  ///< Later than the newest frame.
  std::deque<Vec3> recent_f_B_{};     ///< To see how much it shakes.
  ImuSample last_{};
  std::optional<Pose> X_WB_start_{};
  MissionTime now_{};
  MissionTime last_seen_{};
  MissionTime last_bound_{};  ///< Tracks, or that it stood, have corrected the filter.
  bool has_begun_{};
  bool has_moved_{};
  bool has_been_full_{};  ///< The window.
  int refused_views_{};   ///< In a row: it seems to stand, and the IMU says otherwise.
  bool has_failed_{};     ///< For good: it knows no place that it could find again.
};

}  // namespace flyball

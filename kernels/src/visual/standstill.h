// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// That the body stands, or hardly moves, as a measurement.

#include "flyball/runtime/time.h"

#include "visual/feature_tracks.h"
#include "visual/inertial_filter.h"
#include <deque>
#include <map>

namespace flyball {

/// What corners show that hardly moved.
struct SlowView {
  double moved_ray{};  ///< Median of the corners' displacements in the image, of z = 1.
  double lasted_s{};   ///< Since the view that they are compared with.
  double depth_m{};    ///< Median of the corners' depths; 0 where none is known.
};

/// Compares the corners with where they were half a second ago or, while they stay within half a
/// pixel, longer ago. Zero-velocity updates of inertial odometry are found so in OpenVINS (Geneva
/// et al. 2020, doi:10.1109/ICRA40945.2020.9196524); the longer a view has lasted, the slower the
/// camera must have been.
class RestWatch {
 public:
  void clear();
  /// @return Twice a second; nothing in between, nor where too few corners are in both views.
  [[nodiscard]] std::optional<SlowView> compare(const std::vector<TrackedPoint>& points,
                                                MissionTime now,
                                                double focal_px);

 private:
  void begin(const std::vector<TrackedPoint>& points, MissionTime now);

  std::map<std::uint64_t, Eigen::Vector2d> then_{};  ///< Rays of the corners, by id.
  MissionTime captured_then_{};
  MissionTime told_{};
};

constexpr std::size_t shake_samples = 40;  // .2 s at 200 Hz.

/// Vibration in the last specific forces: their standard deviation around the mean. Real manoeuvres
/// within .2 s count as shaking too.
/// @param recent_f_B  Fewer than `shake_samples` say nothing.
[[nodiscard]] double shaking(const std::deque<Vec3>& recent_f_B);

/// It stands: a measurement of speed, tilt and biases.
/// @param shaking_m_s2  Standard deviation of the vibration in the accelerometer.
[[nodiscard]] Innovation standing(const InertialFilter& filter,
                                  const ImuSample& sample,
                                  double speed_sigma_m_s,
                                  double shaking_m_s2);
/// It is slow, whatever the inertial sensors measure.
[[nodiscard]] Innovation slow(const InertialFilter& filter, double speed_sigma_m_s);

}  // namespace flyball

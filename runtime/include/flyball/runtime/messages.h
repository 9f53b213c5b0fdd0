// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What sensors say and what the flight controller hears.

#include "flyball/runtime/deferred.h"
#include "flyball/runtime/geometry.h"
#include "flyball/runtime/numbers.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace flyball {

/// Where W's origin lies on the earth. The simulated receiver places the world there, and the
/// localizer is told the same place.
struct GeodeticOrigin {
  double latitude_rad{0.8290};   ///< 47.5 degrees north.
  double longitude_rad{0.1484};  ///< 8.5 degrees east.
  double height_m{400.0};        ///< Above the WGS-84 ellipsoid.
};

/// Pinhole camera without distortion.
struct Intrinsics {
  int width_px{};
  int height_px{};
  double focal_px{};  ///< Same for x and y.
  double centre_x_px{};
  double centre_y_px{};
};

/// One depth frame. `depth_m` is the distance along the optical axis, row by row; infinity where
/// nothing was hit within the sensor's range.
struct DepthImage {
  MissionTime captured{};
  std::uint64_t sequence{};
  Intrinsics camera{};
  double max_range_m{};
  std::vector<float> depth_m{};
};

/// What another camera at the same place saw at the same time; S is its frame.
struct SideView {
  Eigen::Matrix3d R_CS{Eigen::Matrix3d::Identity()};
  Deferred<DepthImage> image{};
};

/// A frame as the sensor publishes it. Most are overtaken before somebody looks, and then the
/// simulator need not render them.
struct DepthFrame {
  MissionTime captured{};
  std::uint64_t sequence{};
  int pixels{};  ///< Of each image.
  Deferred<DepthImage> image{};
  std::vector<SideView> sides{};  ///< Beside the camera that looks ahead, if there are any.
};

/// Returns of one frame in the camera frame C.
struct PointCloud {
  MissionTime captured{};
  std::uint64_t sequence{};
  std::vector<Eigen::Vector3f> hits_C{};   ///< Surface points [m].
  std::vector<Eigen::Vector3f> clear_C{};  ///< End points of rays without return, at `max_range_m`.
  std::optional<Intrinsics> camera{};  ///< Of the image whose pixels these are, if they are any.
};

/// An image whose pixels are the points of a cloud: each lies on the ray through the middle of its
/// pixel (`point_of_pixel`).
struct RangeImage {
  Deferred<DepthImage> image{};
  double reach_m{};  ///< Pixels that are farther became rays without return of about this length.
};

/// A point cloud as its builder publishes it.
struct PointCloudFrame {
  MissionTime captured{};
  std::uint64_t sequence{};
  Deferred<PointCloud> cloud_C{};
  std::optional<RangeImage> pixels{};  ///< Where they are all that the cloud is made of.
  double range_m{};                    ///< It holds no hits beyond; 0: nobody says.
};

/// On a link: 16 bits of millimetres for each pixel, as RGB-D cameras send them.
[[nodiscard]] inline double wire_bytes(const DepthFrame& frame) {
  return 2.0 * frame.pixels * (1.0 + static_cast<double>(frame.sides.size()));
}
/// On a link: three 32-bit numbers for each point. Makes the points.
[[nodiscard]] inline double wire_bytes(const PointCloudFrame& frame) {
  const PointCloud& cloud = frame.cloud_C.value();
  return 12.0 * static_cast<double>(cloud.hits_C.size() + cloud.clear_C.size());
}

/// Its points. The image, from which a mapper might make them again, is left out.
inline void visit_numbers(PointCloudFrame& frame, NumberVisitor& visitor) {
  PointCloud cloud = frame.cloud_C.value();
  for (auto* points : {&cloud.hits_C, &cloud.clear_C}) {
    for (Eigen::Vector3f& point : *points) {
      visit_vector(visitor, {"x", "y", "z"}, Quantity::reach, point);
    }
  }
  cloud.camera.reset();
  frame.cloud_C = Deferred<PointCloud>::of(std::move(cloud));
  frame.pixels.reset();
}

/// Where the vehicle truly is: only a simulator can say, and only a localizer that stands in for a
/// perfect one (`LocalizerInputs::truth`) is told.
struct TruePose {
  MissionTime stamp{};
  Pose X_WB{Pose::Identity()};
  Vec3 v_WB{Vec3::Zero()};
};

/// What the navigation sensors measured.
struct NavigationSample {
  MissionTime stamp{};
  bool has_fix{};  ///< Whether this sample carries a new GPS fix.
  double latitude_rad{};
  double longitude_rad{};
  double height_m{};           ///< Above the WGS-84 ellipsoid.
  Vec3 v_gps_W{Vec3::Zero()};  ///< Doppler velocity, east-north-up [m/s].
  Eigen::Quaterniond q_WB_ahrs{Eigen::Quaterniond::Identity()};  ///< From the flight controller.
  double pressure_pa{};                                          ///< 0 without a barometer.
};

/// Where the vehicle believes it is.
struct PoseEstimate {
  MissionTime stamp{};
  Pose X_WB{Pose::Identity()};
  Vec3 v_WB{Vec3::Zero()};
};

inline void visit_numbers(PoseEstimate& pose, NumberVisitor& visitor) {
  Vec3 p_W = pose.X_WB.translation();
  visit_vector(visitor, {"x", "y", "z"}, Quantity::position, p_W);
  pose.X_WB.translation() = p_W;
  visit_vector(visitor, {"vx", "vy", "vz"}, Quantity::velocity, pose.v_WB);
}

/// What the companion computer streams to the flight controller.
struct Setpoint {
  MissionTime stamp{};
  Vec3 p_WB{Vec3::Zero()};
  Vec3 v_WB{Vec3::Zero()};
  Vec3 a_WB{Vec3::Zero()};  ///< Feed-forward.
  double yaw_rad{};
  double yaw_rate_rad_s{};
};

inline void visit_numbers(Setpoint& setpoint, NumberVisitor& visitor) {
  visit_vector(visitor, {"x", "y", "z"}, Quantity::position, setpoint.p_WB);
  visit_vector(visitor, {"vx", "vy", "vz"}, Quantity::velocity, setpoint.v_WB);
  visit_vector(visitor, {"ax", "ay", "az"}, Quantity::acceleration, setpoint.a_WB);
  visitor.visit("yaw", Quantity::angle, setpoint.yaw_rad);
  visitor.visit("yaw_rate", Quantity::rate, setpoint.yaw_rate_rad_s);
}

}  // namespace flyball

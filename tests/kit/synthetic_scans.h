// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Depth scans of two simple places, by closed-form ray intersection: no simulator needed.

#include "flyball/runtime/messages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace flyball::kit {

/// A closed room with a block in it, or open ground with towers under an empty sky.
enum class Place { indoor, outdoor };

/// One frame of a camera that flies through the place.
struct SyntheticScan {
  Pose X_WC{Pose::Identity()};
  PointCloud cloud_C{};
};

/// Distance along a unit vector to the box, from outside it; infinity past it.
inline double distance_to_box_m(const Aabb& box, const Vec3& from, const Vec3& direction) {
  const Eigen::Array3d a = (box.min - from).array() / direction.array();
  const Eigen::Array3d b = (box.max - from).array() / direction.array();
  const double enter = a.min(b).maxCoeff();
  const double leave = a.max(b).minCoeff();
  return enter > 0.0 && enter < leave ? enter : std::numeric_limits<double>::infinity();
}

inline double distance_m(Place place, const Vec3& from, const Vec3& direction) {
  const bool indoor = place == Place::indoor;
  double nearest = std::numeric_limits<double>::infinity();
  if (indoor) {
    const Aabb room{{-3.0, -2.03, 0.0}, {9.0, 2.07, 2.7}};
    const Eigen::Array3d a = (room.min - from).array() / direction.array();
    const Eigen::Array3d b = (room.max - from).array() / direction.array();
    nearest = a.max(b).minCoeff();
  } else if (direction.z() < 0.0) {
    nearest = -from.z() / direction.z();
  }
  const std::vector<Aabb> blocks = indoor
                                       ? std::vector<Aabb>{{{4.0, -1.0, 0.0}, {5.0, 0.2, 2.0}}}
                                       : std::vector<Aabb>{{{5.0, -3.0, 0.0}, {7.0, -1.0, 6.0}},
                                                           {{6.0, 2.0, 0.0}, {8.0, 3.0, 4.0}},
                                                           {{12.0, -2.0, 0.0}, {14.0, 2.0, 8.0}}};
  for (const Aabb& block : blocks) {
    nearest = std::min(nearest, distance_to_box_m(block, from, direction));
  }
  return nearest;
}

/// A 90 degree camera. Points beyond `range_m` become clear rays just longer than it.
inline SyntheticScan synthetic_scan(Place place, int frame, double range_m, int width_px = 64) {
  const bool indoor = place == Place::indoor;
  const int height_px = width_px * 9 / 16;
  SyntheticScan scan;
  scan.X_WC.translation() = indoor ? Vec3{-1.0 + 0.11 * frame, 0.013 * frame, 1.4}
                                   : Vec3{0.31 * frame, 0.02 * frame, 2.0};
  Eigen::Matrix3d R_BC;
  R_BC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const double yaw_rad = 0.05 * frame;
  scan.X_WC.linear() = Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()}.toRotationMatrix() * R_BC;
  scan.cloud_C.sequence = static_cast<std::uint64_t>(frame);
  scan.cloud_C.camera =
      Intrinsics{width_px, height_px, 0.5 * width_px, 0.5 * (width_px - 1), 0.5 * (height_px - 1)};
  for (int pixel = 0; pixel < width_px * height_px; ++pixel) {
    const double half_px = 0.5 * width_px;
    const Vec3 ray_C = Vec3{(pixel % width_px + 0.5 - half_px) / half_px,
                            (pixel / width_px + 0.5 - 0.5 * height_px) / half_px, 1.0}
                           .normalized();
    const double d_m = distance_m(place, scan.X_WC.translation(), scan.X_WC.linear() * ray_C);
    if (d_m <= range_m) {
      scan.cloud_C.hits_C.emplace_back((d_m * ray_C).cast<float>());
    } else {
      scan.cloud_C.clear_C.emplace_back((1.001 * range_m * ray_C).cast<float>());
    }
  }
  return scan;
}

}  // namespace flyball::kit

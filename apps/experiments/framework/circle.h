// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A circle of 25 m radius between trees and houses: MAVBench's flight for SLAM.

#include "flyball/runtime/random.h"
#include "flyball/sim/world.h"

#include <cmath>

namespace flyball {

constexpr double circle_radius_m = 25.0;
constexpr double circle_height_m = 2.5;
constexpr double full_turn_rad = 6.283185307179586;

/// Nothing stands within 3 m of the circle.
inline World circle_world(std::uint64_t seed) {
  World world;
  world.bounds_W = {Vec3{-60, -60, 0}, Vec3{60, 60, 15}};
  RandomStream random{seed, "circle_world"};
  const auto place = [&random](double from_m, double to_m) {
    const double angle = random.uniform(0.0, full_turn_rad);
    const double radius_m = random.uniform(from_m, to_m);
    return Vec3{radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0};
  };
  for (int i = 0; i < 70; ++i) {
    const double height_m = random.uniform(3.0, 8.0);
    world.pillars.push_back({place(29.0, 40.0), random.uniform(0.2, 0.5), height_m});
    world.pillars.push_back({place(8.0, 21.0), random.uniform(0.2, 0.5), height_m});
  }
  for (int i = 0; i < 40; ++i) {
    const Vec3 half{random.uniform(1.0, 2.5), random.uniform(1.0, 2.5), random.uniform(2.0, 6.0)};
    const Vec3 foot_W = place(33.0, 45.0);
    world.boxes.push_back({foot_W - Vec3{half.x(), half.y(), 0.0}, foot_W + half});
  }
  return world;
}

/// The camera's pose after `path_m` of the circle.
inline Pose circle_pose(double path_m) {
  const double angle = path_m / circle_radius_m;
  Eigen::Matrix3d R_WC;
  R_WC.col(2) = Vec3{-std::sin(angle), std::cos(angle), 0.0};  // Ahead.
  R_WC.col(1) = -Vec3::UnitZ();
  R_WC.col(0) = R_WC.col(1).cross(R_WC.col(2));
  Pose X_WC = Pose::Identity();
  X_WC.linear() = R_WC;
  X_WC.translation() =
      Vec3{circle_radius_m * std::cos(angle), circle_radius_m * std::sin(angle), circle_height_m};
  return X_WC;
}

}  // namespace flyball

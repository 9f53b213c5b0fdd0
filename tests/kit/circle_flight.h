// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How a vehicle flies the circle of MAVBench's flight for SLAM, looking ahead.

#include "flyball/sim/vehicle.h"

#include "experiments/framework/circle.h"
#include <algorithm>
#include <cmath>

namespace flyball::kit {

using flyball::circle_height_m;
using flyball::circle_pose;
using flyball::circle_radius_m;
using flyball::circle_world;
using flyball::full_turn_rad;

/// How the camera looks out of the body: ahead.
inline Pose ahead_from_body() {
  Pose X_BC = Pose::Identity();
  X_BC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return X_BC;
}

/// A vehicle that stands for `stand_s`, speeds up by `gain_m_s2` to `speed_m_s` and stays level.
/// Rotors turn as in hover when it `shakes`.
struct CircleRun {
  double speed_m_s{2.0};
  double stand_s{0.5};
  bool shakes{false};
  double gain_m_s2{1.0};

  [[nodiscard]] double pace_m_s(double t_s) const {
    return std::clamp(gain_m_s2 * (t_s - stand_s), 0.0, speed_m_s);
  }
  [[nodiscard]] double path_m(double t_s) const {
    const double moving_s = std::max(0.0, t_s - stand_s);
    const double gaining_s = std::min(moving_s, speed_m_s / gain_m_s2);
    return 0.5 * gain_m_s2 * gaining_s * gaining_s + speed_m_s * (moving_s - gaining_s);
  }
  [[nodiscard]] VehicleState at(double t_s) const {
    const Pose X_WC = circle_pose(path_m(t_s));
    VehicleState state;
    state.X_WB = X_WC * ahead_from_body().inverse();
    const Vec3 ahead_W = state.X_WB.linear().col(0);
    const Vec3 inwards_W = state.X_WB.linear().col(1);
    const double pace = pace_m_s(t_s);
    const double gain = t_s > stand_s && pace < speed_m_s ? gain_m_s2 : 0.0;
    state.v_WB = pace * ahead_W;
    state.a_WB = gain * ahead_W + pace * pace / circle_radius_m * inwards_W;
    state.w_WB_B = Vec3{0.0, 0.0, pace / circle_radius_m};
    if (shakes) {
      state.rotor_rev_s = {60.3, 61.7, 60.9, 61.2};
    }
    return state;
  }
};

}  // namespace flyball::kit

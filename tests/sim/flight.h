// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A vehicle with its flight controller, flown along a reference that arrives at 50 Hz.

#include "flyball/sim/flight_controller.h"
#include "flyball/sim/vehicle.h"

#include "built_data.h"
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {

inline Airframe shipped_airframe(const std::string& name) {
  const auto loaded = load_airframe(kit::built_data() + "/airframes/" + name + ".toml");
  EXPECT_TRUE(loaded.ok()) << loaded.error().message;
  return loaded.ok() ? *loaded : Airframe{};
}

/// Largest errors of a flight against its reference [m].
struct TrackingError {
  double total_m{};
  double lateral_m{};  ///< Across the reference's velocity, in the horizontal plane.
  double vertical_m{};
  double ahead_m{};  ///< Along it.
  double behind_m{};
};

class Flight {
 public:
  /// Hovers at `height_m` over the origin.
  explicit Flight(double payload_kg = 0.0,
                  double dt_s = 0.001,
                  double height_m = 3.0,
                  const std::string& name = "matrice_100",
                  const std::optional<GimbalSpec>& gimbal = std::nullopt)
      : airframe{shipped_airframe(name)},
        vehicle{airframe, payload_kg, {{0.0, 0.0, height_m}, 0.0, 0.0}, gimbal},
        controller{airframe, 0.0},
        step_s{dt_s} {
    controller.hold(vehicle.state());
    Setpoint here;
    here.p_WB = {0.0, 0.0, height_m};
    // The rotors start from rest, so it drops a little first.
    follow(2.0, [&here](double) { return here; });
  }

  void tick() {
    vehicle.step(step_s, controller.update(state(), vehicle.mass_kg(), now, step_s), wind_W);
    now += Duration{std::llround(step_s * 1e9)};
  }
  void run(double duration_s) {
    for (long i = std::lround(duration_s / step_s); i > 0; --i) {
      tick();
    }
  }
  /// Streams `reference(t)` at 50 Hz for t in [0, duration_s); `watch(t, reference)` after each
  /// step.
  template <class Reference, class Watch>
  void follow(double duration_s, const Reference& reference, const Watch& watch) {
    const long steps_per_set_point = std::lround(0.02 / step_s);
    const long steps = std::lround(duration_s / step_s);
    for (long i = 0; i < steps; ++i) {
      if (i % steps_per_set_point == 0) {
        Setpoint set_point = reference(static_cast<double>(i) * step_s);
        set_point.stamp = now;
        controller.follow(set_point);
      }
      tick();
      const double t = static_cast<double>(i + 1) * step_s;
      watch(t, reference(t));
    }
  }
  template <class Reference>
  TrackingError follow(double duration_s, const Reference& reference) {
    TrackingError worst;
    follow(duration_s, reference, [&](double, const Setpoint& wanted) {
      const Vec3 e = state().X_WB.translation() - wanted.p_WB;
      const Vec3 heading =
          wanted.v_WB.norm() > 1e-6 ? Vec3{wanted.v_WB.normalized()} : last_heading_;
      last_heading_ = heading;
      const double along = e.dot(heading);
      worst.total_m = std::max(worst.total_m, e.norm());
      worst.lateral_m = std::max(worst.lateral_m, (e - along * heading).head<2>().norm());
      worst.vertical_m = std::max(worst.vertical_m, std::abs(e.z()));
      worst.ahead_m = std::max(worst.ahead_m, along);
      worst.behind_m = std::max(worst.behind_m, -along);
    });
    return worst;
  }

  [[nodiscard]] const VehicleState& state() const { return vehicle.state(); }
  [[nodiscard]] Vec3 position() const { return state().X_WB.translation(); }
  [[nodiscard]] double yaw_rad() const { return yaw_of(state().X_WB.linear().col(0)); }

  Airframe airframe;
  Vehicle vehicle;
  FlightController controller;
  MissionTime now{};
  double step_s;
  Vec3 wind_W{Vec3::Zero()};

 private:
  Vec3 last_heading_{Vec3::UnitX()};
};

/// From rest along x at height z: speeds up, cruises, brakes.
struct Dash {
  double speed_m_s{1.0};
  double speed_up_m_s2{2.0};
  double brake_m_s2{6.0};
  double cruise_s{2.0};
  double height_m{3.0};

  [[nodiscard]] double brake_at_s() const { return speed_m_s / speed_up_m_s2 + cruise_s; }
  [[nodiscard]] double brake_at_m() const {
    return 0.5 * speed_m_s * speed_m_s / speed_up_m_s2 + cruise_s * speed_m_s;
  }
  [[nodiscard]] double brake_length_m() const { return 0.5 * speed_m_s * speed_m_s / brake_m_s2; }
  [[nodiscard]] double end_s() const { return brake_at_s() + speed_m_s / brake_m_s2; }

  Setpoint operator()(double t) const {
    Setpoint s;
    const double speed_up_s = speed_m_s / speed_up_m_s2;
    const double braking_s = std::clamp(t - brake_at_s(), 0.0, speed_m_s / brake_m_s2);
    if (t < speed_up_s) {
      s.p_WB.x() = 0.5 * speed_up_m_s2 * t * t;
      s.v_WB.x() = speed_up_m_s2 * t;
      s.a_WB.x() = speed_up_m_s2;
    } else if (t < brake_at_s()) {
      s.p_WB.x() = 0.5 * speed_m_s * speed_up_s + speed_m_s * (t - speed_up_s);
      s.v_WB.x() = speed_m_s;
    } else {
      s.p_WB.x() = brake_at_m() + speed_m_s * braking_s - 0.5 * brake_m_s2 * braking_s * braking_s;
      s.v_WB.x() = speed_m_s - brake_m_s2 * braking_s;
      s.a_WB.x() = t < end_s() ? -brake_m_s2 : 0.0;
    }
    s.p_WB.z() = height_m;
    return s;
  }
};

/// A left turn at constant speed after a straight run-up with a ramp of the speed.
struct Turn {
  double speed_m_s{1.0};
  double radius_m{2.0};
  double ramp_s{2.0};
  double straight_s{1.0};
  double height_m{3.0};

  Setpoint operator()(double t) const {
    Setpoint s;
    const double ramp_m = 0.5 * speed_m_s * ramp_s;
    const double curve_at_s = ramp_s + straight_s;
    const double curve_at_m = ramp_m + speed_m_s * straight_s;
    if (t < ramp_s) {
      s.p_WB.x() = 0.5 * speed_m_s / ramp_s * t * t;
      s.v_WB.x() = speed_m_s / ramp_s * t;
      s.a_WB.x() = speed_m_s / ramp_s;
    } else if (t < curve_at_s) {
      s.p_WB.x() = ramp_m + speed_m_s * (t - ramp_s);
      s.v_WB.x() = speed_m_s;
    } else {
      const double w = speed_m_s / radius_m;
      const double angle = w * (t - curve_at_s);
      const Vec3 ahead{std::cos(angle), std::sin(angle), 0.0};
      const Vec3 left{-ahead.y(), ahead.x(), 0.0};
      s.p_WB = Vec3{curve_at_m, radius_m, 0.0} - radius_m * left;
      s.v_WB = speed_m_s * ahead;
      s.a_WB = speed_m_s * w * left;
      s.yaw_rad = wrap_angle(angle);
      s.yaw_rate_rad_s = w;
    }
    s.p_WB.z() = height_m;
    return s;
  }
};

}  // namespace flyball

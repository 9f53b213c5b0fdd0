// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
//
// Vehicles beside which the companion computer is no small thing.

#include "flyball/runtime/guard.h"
#include "flyball/sim/battery.h"
#include "flyball/sim/rotor_power.h"

#include "flight.h"
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr const char* light[] = {"mini_2", "spark", "tello"};

/// Electrical, by eq. 1, in level flight at a constant speed.
double level_w(const Airframe& airframe, double speed_m_s, double payload_kg = 0.0) {
  RegressionPower power{airframe};
  VehicleState state;
  state.v_WB = {speed_m_s, 0.0, 0.0};
  state.rotor_rev_s = {100.0, 100.0, 100.0, 100.0};
  return power.update(state, payload_kg, Vec3::Zero(), 0.01);
}

double endurance_minutes(const Airframe& airframe, double speed_m_s) {
  Battery battery{airframe.battery_cells, airframe.battery_ah};
  const double power_w = level_w(airframe, speed_m_s);
  constexpr double dt_s = 0.1;
  double t_s = 0.0;
  while (!battery.is_empty()) {
    battery.draw(power_w, dt_s);
    t_s += dt_s;
  }
  return t_s / 60.0;
}

TEST(LightAirframes, last_as_long_as_their_makers_say) {
  const struct {
    const char* name;
    double speed_m_s;
    double maker_min;
  } rows[] = {{"mini_2", 4.7, 31.0}, {"spark", 0.0, 15.0}, {"tello", 15.0 / 3.6, 13.0}};
  for (const auto& row : rows) {
    const double minutes = endurance_minutes(shipped_airframe(row.name), row.speed_m_s);
    std::printf("%s at %.1f m/s: %.1f min (maker %.0f)\n", row.name, row.speed_m_s, minutes,
                row.maker_min);
    EXPECT_NEAR(minutes, row.maker_min, 0.1 * row.maker_min) << row.name;
  }
}

TEST(LightAirframes, hover_in_the_classes_that_they_stand_for) {
  const double mini_w = level_w(shipped_airframe("mini_2"), 0.0);
  EXPECT_GT(mini_w, 35.0);
  EXPECT_LT(mini_w, 45.0);
  EXPECT_NEAR(level_w(shipped_airframe("spark"), 0.0), 60.0, 8.0);
  EXPECT_NEAR(level_w(shipped_airframe("tello"), 0.0), 20.0, 1.0);
}

// Rotor power in units of hover's, at a speed in units of the rotors' induced velocity, is that of
// the Matrice 100: eq. 1 was moved by momentum theory.
TEST(LightAirframes, are_similar_to_the_airframe_whose_regression_they_take_over) {
  const auto induced_m_s = [](const Airframe& a) {
    const double disc_m2 = 3.14159265358979 * a.rotor_diameter_m * a.rotor_diameter_m;  // All four.
    return std::sqrt(a.mass_kg * 9.80665 / (2.0 * 1.225 * disc_m2));
  };
  const auto relative = [&](const Airframe& a, double speed, double payload_share) {
    return level_w(a, speed * induced_m_s(a), payload_share * a.mass_kg) / level_w(a, 0.0);
  };
  const Airframe model = shipped_airframe("matrice_100");
  for (const char* name : light) {
    const Airframe airframe = shipped_airframe(name);
    for (const double speed : {0.5, 1.0}) {
      EXPECT_NEAR(relative(airframe, speed, 0.2), relative(model, speed, 0.2), 2e-3) << name;
    }
  }
}

/// A circle flown anticlockwise, entered at speed.
struct Turn {
  double speed_m_s{1.5};
  double radius_m{4.0};
  Setpoint operator()(double t) const {
    // Four seconds to get up to speed on the way.
    const double s_m = t < 4.0 ? speed_m_s * t * t / 8.0 : speed_m_s * (t - 2.0);
    const double v = t < 4.0 ? speed_m_s * t / 4.0 : speed_m_s;
    const double angle = s_m / radius_m;
    Setpoint set;
    set.p_WB = {radius_m * std::sin(angle), radius_m * (1.0 - std::cos(angle)), 3.0};
    set.v_WB = {v * std::cos(angle), v * std::sin(angle), 0.0};
    set.a_WB = v * v / radius_m * Vec3{-std::sin(angle), std::cos(angle), 0.0};
    return set;
  }
};

TEST(LightAirframes, stay_inside_the_tracking_tube_in_a_curve) {
  for (const char* name : light) {
    Flight flight{0.0, 0.001, 3.0, name};
    const Turn turn;
    const TrackingError e = flight.follow(10.0, turn);
    std::printf("%s, %.1f m/s on a radius of %.0f m: lateral %.4f m, vertical %.4f m\n", name,
                turn.speed_m_s, turn.radius_m, e.lateral_m, e.vertical_m);
    EXPECT_LT(std::hypot(e.lateral_m, e.vertical_m), TrackingTube{}.radius_m(turn.speed_m_s))
        << name;
  }
}

TEST(LightAirframes, fly_the_square_better_than_the_reference_simulator) {
  const auto square = [](double t) {
    constexpr double side_m = 5.0;
    const Vec3 corners[] = {{0, 0, 3}, {5, 0, 3}, {5, 5, 3}, {0, 5, 3}, {0, 0, 3}};
    const double s_m = std::min(t, 4.0 * side_m - 1e-9);
    const auto k = static_cast<std::size_t>(s_m / side_m);
    const Vec3 ahead = (corners[k + 1] - corners[k]) / side_m;
    Setpoint set;
    set.p_WB = corners[k] + (s_m - static_cast<double>(k) * side_m) * ahead;
    set.v_WB = t < 4.0 * side_m ? ahead : Vec3{Vec3::Zero()};
    return set;
  };
  for (const char* name : light) {
    Flight flight{0.0, 0.001, 3.0, name};
    const TrackingError e = flight.follow(22.0, square);
    std::printf("%s, 5 m square at 1 m/s: %.3f m\n", name, e.total_m);
    EXPECT_LT(e.total_m, 0.65) << name;  // MAVBench (MICRO 2018): 5 m square
  }
}

}  // namespace
}  // namespace flyball

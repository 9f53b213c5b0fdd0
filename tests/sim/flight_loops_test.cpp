// SPDX-License-Identifier: BSD-3-Clause
//
// The loops seen from outside: heading, disturbances, saturated rotors. How well they track is in
// flight_controller_test.cpp.

#include "flyball/sim/flight_controller.h"

#include "flight.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(FlightLoops, turns_by_a_quarter_turn_a_second_without_leaving_its_place) {
  Flight flight;
  Setpoint turned;
  turned.p_WB = {0.0, 0.0, 3.0};
  turned.yaw_rad = 3.0;
  double fastest_rad_s = 0.0;
  double farthest_rad = 0.0;
  double away_m = 0.0;
  flight.follow(
      3.0, [&](double) { return turned; },
      [&](double, const Setpoint&) {
        fastest_rad_s = std::max(fastest_rad_s, flight.state().w_WB_B.z());
        farthest_rad = std::max(farthest_rad, flight.yaw_rad());
        away_m = std::max(away_m, (flight.position() - turned.p_WB).norm());
      });
  EXPECT_NEAR(flight.yaw_rad(), 3.0, 0.01);
  EXPECT_NEAR(fastest_rad_s, 1.5708, 0.1);
  EXPECT_LT(farthest_rad, 3.05);
  EXPECT_LT(away_m, 0.05);
}

TEST(FlightLoops, turns_to_the_nearer_side) {
  Flight flight;
  Setpoint turned;
  turned.p_WB = {0.0, 0.0, 3.0};
  turned.yaw_rad = 3.0;
  flight.follow(3.0, [&](double) { return turned; });
  turned.yaw_rad = -3.0;
  flight.follow(
      1.5, [&](double) { return turned; },
      [&](double, const Setpoint&) { ASSERT_GT(std::abs(flight.yaw_rad()), 2.9); });
  EXPECT_NEAR(flight.yaw_rad(), -3.0, 0.02);
}

TEST(FlightLoops, bears_a_gust_and_a_wrong_belief_about_its_mass) {
  Flight flight;
  const Vec3 place{0.0, 0.0, 3.0};
  Setpoint here;
  here.p_WB = place;
  flight.wind_W = {8.0, 0.0, 0.0};
  EXPECT_LT(flight.follow(3.0, [&](double) { return here; }).total_m, 0.3);
  EXPECT_LT((flight.position() - place).norm(), 0.02);
  for (int i = 0; i < 3000; ++i) {  // Believes to carry 200 g that are not there.
    if (i % 20 == 0) {
      here.stamp = flight.now;
      flight.controller.follow(here);
    }
    const double believed_kg = flight.vehicle.mass_kg() + 0.2;
    flight.vehicle.step(0.001,
                        flight.controller.update(flight.state(), believed_kg, flight.now, 0.001),
                        flight.wind_W);
    flight.now += std::chrono::milliseconds{1};
  }
  EXPECT_LT((flight.position() - place).norm(), 0.02);
}

TEST(FlightLoops, keeps_its_attitude_when_the_rotors_have_no_more_to_give) {
  Flight flight{1.0};
  Setpoint far;  // Asks for a climb and a dash that together exceed the thrust.
  far.p_WB = {30.0, 0.0, 30.0};
  far.v_WB = {10.0, 0.0, 10.0};
  far.a_WB = {6.0, 0.0, 6.0};
  double steepest_rad = 0.0;
  flight.follow(
      1.5, [&](double) { return far; },
      [&](double, const Setpoint&) {
        steepest_rad =
            std::max(steepest_rad, std::acos(std::min(1.0, flight.state().X_WB.linear()(2, 2))));
        ASSERT_LT(flight.state().w_WB_B.norm(), 7.0);
      });
  EXPECT_LT(steepest_rad, 0.85);  // Limit .75 rad and overshoot
  EXPECT_GT(flight.state().v_WB.x(), 2.0);
}

TEST(FlightLoops, other_airframes_fly_too) {
  for (const char* name : {"solo", "f450", "mini_2", "spark", "tello"}) {
    const Airframe airframe = shipped_airframe(name);
    Vehicle vehicle{airframe, 0.0, {{0.0, 0.0, 0.5 * airframe.body_height_m}, 1.0, 0.0}};
    FlightController controller{airframe, 0.0};
    controller.take_off(vehicle.state(), 2.0);
    MissionTime now{};
    for (int i = 0; i < 3500; ++i) {
      vehicle.step(0.001, controller.update(vehicle.state(), vehicle.mass_kg(), now, 0.001),
                   Vec3::Zero());
      now += std::chrono::milliseconds{1};
    }
    EXPECT_TRUE(controller.is_done(vehicle.state())) << name;
    EXPECT_NEAR(yaw_of(vehicle.state().X_WB.linear().col(0)), 1.0, 0.01) << name;
  }
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/vehicle.h"

#include "flight.h"
#include <cstring>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double dt_s = 0.001;
const Vec3 calm = Vec3::Zero();

/// High above the ground and without air resistance, unless a test wants some.
Airframe in_vacuum() {
  Airframe airframe = shipped_airframe("matrice_100");
  airframe.drag_area_m2 = 0.0;
  return airframe;
}

double hover_rev_s(const Airframe& airframe, double mass_kg) {
  return std::sqrt(mass_kg * gravity_m_s2 / (4.0 * airframe.thrust_per_n2()));
}

RotorSpeeds all(double rev_s) {
  return {rev_s, rev_s, rev_s, rev_s};
}

TEST(Vehicle, falls_freely) {
  Vehicle vehicle{in_vacuum(), 0.5, {{0.0, 0.0, 100.0}, 0.3, 0.0}};
  const double t = 2.0;
  for (int i = 0; i < 2000; ++i) {
    vehicle.step(dt_s, all(0.0), calm);
  }
  EXPECT_NEAR(vehicle.state().v_WB.z(), -gravity_m_s2 * t, 1e-9);
  // Semi-explicit Euler falls ahead by g t dt / 2 and no more.
  EXPECT_NEAR(vehicle.state().X_WB.translation().z(),
              100.0 - 0.5 * gravity_m_s2 * t * t - 0.5 * gravity_m_s2 * t * dt_s, 1e-9);
  EXPECT_LT(vehicle.state().w_WB_B.norm(), 1e-12);
}

TEST(Vehicle, reaches_the_terminal_speed_of_quadratic_drag) {
  Airframe airframe = in_vacuum();
  airframe.drag_area_m2 = 0.2;
  Vehicle vehicle{airframe, 0.0, {{0.0, 0.0, 1000.0}, 0.0, 0.0}};
  const Vec3 wind_W{3.0, 0.0, 0.0};
  for (int i = 0; i < 10000; ++i) {
    vehicle.step(dt_s, all(0.0), wind_W);
  }
  const double terminal_m_s = std::sqrt(2.0 * vehicle.mass_kg() * gravity_m_s2 /
                                        (air_density_kg_m3 * airframe.drag_area_m2));
  EXPECT_NEAR(vehicle.state().v_WB.z(), -terminal_m_s, 1e-3 * terminal_m_s);
  EXPECT_NEAR(vehicle.state().v_WB.x(), wind_W.x(), 0.01);  // Carried along by the wind.
}

TEST(Vehicle, hovers_when_thrust_equals_weight) {
  for (const double payload_kg : {0.0, 1.0}) {
    const Airframe airframe = in_vacuum();
    Vehicle vehicle{airframe, payload_kg, {{0.0, 0.0, 100.0}, 0.0, 0.0}};
    for (int i = 0; i < 2000; ++i) {
      vehicle.step(dt_s, all(hover_rev_s(airframe, vehicle.mass_kg())), calm);
    }
    EXPECT_LT(vehicle.state().a_WB.norm(), 1e-9);
    EXPECT_LT(vehicle.state().w_WB_B.norm(), 1e-9);
  }
}

TEST(Vehicle, rotors_follow_their_command_exactly_at_any_step) {
  const Airframe airframe = in_vacuum();
  for (const double step_s : {0.001, 0.004, 0.02}) {
    Vehicle vehicle{airframe, 0.0, {{0.0, 0.0, 100.0}, 0.0, 0.0}};
    for (double t = 0.0; t < airframe.rotor_lag_s - 1e-9; t += step_s) {
      vehicle.step(step_s, all(60.0), calm);
    }
    EXPECT_NEAR(vehicle.state().rotor_rev_s[2], 60.0 * (1.0 - std::exp(-1.0)), 1e-9) << step_s;
    // Impulse of the spin-up, closed form of the integral of n^2 over one time constant.
    const double e1 = std::exp(-1.0);
    const double n2_s =
        3600.0 * airframe.rotor_lag_s * (1.0 - 2.0 * (1.0 - e1) + 0.5 * (1.0 - e1 * e1));
    const double thrust_m_s = 4.0 * airframe.thrust_per_n2() * n2_s / airframe.mass_kg;
    EXPECT_NEAR(vehicle.state().v_WB.z(), thrust_m_s - gravity_m_s2 * airframe.rotor_lag_s, 1e-9);
  }
}

TEST(Vehicle, limits_the_rotors_to_their_fastest) {
  const Airframe airframe = in_vacuum();
  Vehicle vehicle{airframe, 0.0, {{0.0, 0.0, 100.0}, 0.0, 0.0}};
  for (int i = 0; i < 1000; ++i) {
    vehicle.step(dt_s, all(1e6), calm);
  }
  EXPECT_NEAR(vehicle.state().rotor_rev_s[0], airframe.max_rotor_rev_s(), 1e-6);
  EXPECT_NEAR(vehicle.state().a_WB.z() / gravity_m_s2 + 1.0, 2.17, 0.01);  // Thrust to weight
}

/// Angular acceleration after the rotors have settled, within a step that begins at rest.
Vec3 turn_of(const RotorSpeeds& speeds) {
  Airframe airframe = in_vacuum();
  airframe.rotor_lag_s = 1e-6;
  Vehicle vehicle{airframe, 0.0, {{0.0, 0.0, 100.0}, 0.0, 0.0}};
  vehicle.step(dt_s, speeds, calm);
  return vehicle.state().w_WB_B / dt_s;
}

TEST(Vehicle, turns_about_each_axis_by_torque_over_inertia) {
  const Airframe airframe = in_vacuum();
  const Vec3 inertia = airframe.inertia_kg_m2();
  const double slow = 50.0;
  const double fast = 60.0;
  const double more_n = airframe.thrust_per_n2() * (fast * fast - slow * slow);
  const double lever_m = airframe.arm_m / std::sqrt(2.0);
  // The lag's remainder within the first step is below 1e-2 of the mean.
  const Vec3 roll = turn_of({fast, slow, slow, fast});  // Left pair: rolls to the right.
  EXPECT_NEAR(roll.x(), 2.0 * lever_m * more_n / inertia.x(), 0.01 * roll.x());
  const Vec3 pitch = turn_of({slow, slow, fast, fast});  // Rear pair: nose down.
  EXPECT_NEAR(pitch.y(), 2.0 * lever_m * more_n / inertia.y(), 0.01 * pitch.y());
  const Vec3 yaw = turn_of({fast, slow, fast, slow});  // The clockwise pair: to the left.
  const double more_nm = airframe.torque_per_n2() * (fast * fast - slow * slow);
  EXPECT_NEAR(yaw.z(), 2.0 * more_nm / inertia.z(), 0.01 * yaw.z());
  EXPECT_GT(std::min({roll.x(), pitch.y(), yaw.z()}), 1.0);
}

TEST(Vehicle, stands_on_its_legs_and_does_not_slide_in_wind) {
  const Airframe airframe = shipped_airframe("matrice_100");
  Vehicle vehicle{airframe, 0.5, {{0.0, 0.0, 0.5 * airframe.body_height_m}, 0.0, 0.0}};
  for (const double step_s : {0.001, 0.004}) {
    for (int i = 0; i < 1000; ++i) {
      vehicle.step(step_s, all(0.0), {5.0, 0.0, 0.0});
    }
    const double sunk_m = 0.5 * airframe.body_height_m - vehicle.state().X_WB.translation().z();
    EXPECT_NEAR(sunk_m, 0.002 * vehicle.mass_kg() / airframe.mass_kg, 2e-4);
    EXPECT_LT(vehicle.state().v_WB.norm(), 0.01);
    EXPECT_GT(vehicle.state().X_WB.linear()(2, 2), 0.9999);
  }
}

TEST(Vehicle, loses_in_the_legs_what_it_fell) {
  const Airframe airframe = in_vacuum();
  const double stand_m = 0.5 * airframe.body_height_m;
  Vehicle vehicle{airframe, 0.0, {{0.0, 0.0, stand_m + 0.5}, 0.0, 0.0}};
  const double before_j = vehicle.potential_j();
  for (int i = 0; i < 3000; ++i) {
    vehicle.step(dt_s, all(0.0), calm);
  }
  EXPECT_LT(vehicle.state().v_WB.norm(), 1e-3);
  const double fallen_j = before_j - vehicle.potential_j();
  EXPECT_NEAR(fallen_j, vehicle.mass_kg() * gravity_m_s2 * 0.502, 0.01);
  EXPECT_NEAR(vehicle.contact_loss_j(), fallen_j, 0.01 * fallen_j);
}

TEST(Vehicle, balances_its_energy_over_a_flight) {
  for (const double step_s : {0.001, 0.004}) {
    const Airframe airframe = shipped_airframe("matrice_100");
    Flight flight{0.5, step_s, 4.0};
    flight.wind_W = {2.0, -4.0, 0.0};
    const auto residual_j = [&flight] {
      const Vehicle& v = flight.vehicle;
      return v.rotor_work_j() - v.kinetic_j() - v.potential_j() - v.drag_loss_j() -
             v.contact_loss_j();
    };
    const double start_j = residual_j();
    Turn turn;
    turn.speed_m_s = 6.0;
    turn.radius_m = 9.0;
    turn.height_m = 4.0;
    flight.follow(6.0, turn);
    flight.controller.hold(flight.state());
    flight.run(2.0);
    flight.controller.land(flight.state());
    flight.run(8.0);
    ASSERT_EQ(flight.controller.mode(), FlightMode::idle);
    EXPECT_GT(flight.vehicle.drag_loss_j(), 20.0);
    std::printf(
        "energy at steps of %.0f ms: rotors %.2f J, drag %.2f J, ground %.2f J, left over %.4f J\n",
        1e3 * step_s, flight.vehicle.rotor_work_j(), flight.vehicle.drag_loss_j(),
        flight.vehicle.contact_loss_j(), residual_j() - start_j);
    EXPECT_LT(std::abs(residual_j() - start_j), 0.01 * std::abs(flight.vehicle.rotor_work_j()));
  }
}

/// Yaw of the body that hangs free, and of its camera's axis, after the gimbal was told to pan.
TEST(Vehicle, turns_against_its_panning_camera) {
  const Airframe airframe = in_vacuum();
  const GimbalSpec gimbal;
  Vehicle vehicle{airframe, 0.0, {{0.0, 0.0, 500.0}, 0.0, 0.0}, gimbal};
  EXPECT_DOUBLE_EQ(vehicle.mass_kg(), airframe.mass_kg + gimbal.mass_kg);
  vehicle.aim({0.5, 0.0});
  for (int i = 0; i < 20; ++i) {
    vehicle.step(dt_s, all(0.0), calm);
  }
  // No torque from outside: I_body w + I_ball (w + rate) = 0; both axes pass through the origin.
  const double ball = 0.4 * gimbal.mass_kg * gimbal.radius_m * gimbal.radius_m;
  const GimbalJoints before = vehicle.gimbal_joints();
  vehicle.step(dt_s, all(0.0), calm);
  const double rate_rad_s = (vehicle.gimbal_joints().pan - before.pan) / dt_s;
  EXPECT_GT(rate_rad_s, 0.5);
  const double inertia = airframe.inertia_kg_m2().z() + ball;
  EXPECT_NEAR(vehicle.state().w_WB_B.z(), -ball * rate_rad_s / inertia,
              1e-6 * ball * rate_rad_s / inertia);
}

TEST(Vehicle, pans_no_faster_than_the_gimbals_rate_and_arrives) {
  const GimbalSpec gimbal;
  for (const double step_s : {0.001, 0.004}) {
    Vehicle vehicle{in_vacuum(), 0.0, {{0.0, 0.0, 500.0}, 0.0, 0.0}, gimbal};
    vehicle.aim({0.8, 0.5});
    double fastest_rad_s = 0.0;
    for (double t_s = 0.0; t_s < 2.0; t_s += step_s) {
      const double before_rad = vehicle.gimbal_joints().pan;
      vehicle.step(step_s, all(0.0), calm);
      fastest_rad_s = std::max(fastest_rad_s, (vehicle.gimbal_joints().pan - before_rad) / step_s);
    }
    EXPECT_NEAR(fastest_rad_s, gimbal.max_rate_rad_s, 0.01);
    const Vec3 axis_W = vehicle.camera_pose().linear().col(2);
    EXPECT_NEAR(std::asin(-axis_W.z()), 0.5, 1e-3);
    // From the heading that the body has now.
    EXPECT_NEAR(yaw_of(axis_W) - yaw_of(vehicle.state().X_WB.linear().col(0)), 0.8, 1e-3);
  }
}

TEST(Vehicle, holds_its_cameras_axis_while_it_banks_and_balances_its_energy) {
  Flight flight{0.5, 0.001, 4.0, "matrice_100", GimbalSpec{}};
  flight.vehicle.aim({0.3, 0.6});
  const auto residual_j = [&flight] {
    const Vehicle& v = flight.vehicle;
    return v.rotor_work_j() + v.gimbal_work_j() - v.kinetic_j() - v.potential_j() -
           v.drag_loss_j() - v.contact_loss_j();
  };
  flight.run(2.0);
  const double start_j = residual_j();
  Turn turn;
  turn.speed_m_s = 6.0;
  turn.radius_m = 9.0;
  turn.height_m = 4.0;
  double most_rad = 0.0;
  double leaned_rad = 0.0;
  flight.follow(6.0, turn, [&](double /*t*/, const Setpoint& /*wanted*/) {
    const Pose& X_WB = flight.state().X_WB;
    const Vec3 axis_L =
        level_frame(X_WB).linear().transpose() * flight.vehicle.camera_pose().linear().col(2);
    const Vec3 right_W = flight.vehicle.camera_pose().linear().col(0);
    most_rad = std::max(
        {most_rad, std::abs(std::asin(-axis_L.z()) - 0.6), std::abs(std::asin(right_W.z()))});
    leaned_rad = std::max(leaned_rad, std::acos(X_WB.linear()(2, 2)));
  });
  EXPECT_GT(leaned_rad, 0.3);
  EXPECT_LT(most_rad, 0.15);  // 25 ms behind a body that begins to lean at some rad/s.
  EXPECT_GT(std::abs(flight.vehicle.gimbal_work_j()), 0.0);
  EXPECT_LT(std::abs(residual_j() - start_j), 0.01 * std::abs(flight.vehicle.rotor_work_j()));
}

TEST(Vehicle, is_where_somebody_else_found_it_and_goes_on_from_there) {
  for (const bool has_gimbal : {false, true}) {
    Vehicle vehicle{in_vacuum(),
                    0.0,
                    {{0.0, 0.0, 500.0}, 0.0, 0.0},
                    has_gimbal ? std::optional{GimbalSpec{}} : std::nullopt};
    VehicleState found;
    found.X_WB = Eigen::Translation3d{1.0, 2.0, 300.0} *
                 Eigen::AngleAxisd{0.4, Vec3{1.0, 2.0, 3.0}.normalized()};
    found.v_WB = {3.0, 0.0, 1.0};
    found.rotor_rev_s = all(50.0);
    vehicle.place(0.01, found);
    EXPECT_EQ(vehicle.state().X_WB.matrix(), found.X_WB.matrix());
    EXPECT_EQ(vehicle.state().rotor_rev_s, found.rotor_rev_s);
    vehicle.step(dt_s, all(0.0), calm);
    const Vec3 went = vehicle.state().X_WB.translation() - found.X_WB.translation();
    EXPECT_NEAR(went.x(), 3.0 * dt_s, 1e-4);
    EXPECT_LT((vehicle.state().X_WB.linear() - found.X_WB.linear()).norm(), 0.01);
  }
}

TEST(Vehicle, holds_its_cameras_axis_while_somebody_else_moves_it) {
  Vehicle vehicle{in_vacuum(), 0.0, {{0.0, 0.0, 500.0}, 0.0, 0.0}, GimbalSpec{}};
  vehicle.aim({0.3, 0.6});
  VehicleState found;
  double most_rad = 0.0;
  for (double t_s = 0.0; t_s < 4.0; t_s += dt_s) {
    found.X_WB.linear() =
        Eigen::AngleAxisd{0.3 * std::sin(2.0 * t_s), Vec3::UnitX()}.toRotationMatrix();
    vehicle.place(dt_s, found);
    const Vec3 axis_W = vehicle.camera_pose().linear().col(2);
    const double error_rad = std::abs(std::asin(-axis_W.z()) - 0.6);
    most_rad = t_s > 1.0 ? std::max(most_rad, error_rad) : 0.0;
  }
  EXPECT_LT(most_rad, 0.05);  // 25 ms behind a body that leans at .6 rad/s, and some of a turn.
  EXPECT_EQ(vehicle.gimbal_work_j(), 0.0);
}

/// A body alone is computed in closed form, one with a gimbal by Simbody: with a gimbal that weighs
/// nothing, both are the same body.
TEST(Vehicle, moves_alone_as_the_multibody_system_does) {
  const Airframe airframe = shipped_airframe("matrice_100");
  GimbalSpec weightless;
  weightless.mass_kg = 1e-9;
  const VehicleStart start{{0.0, 0.0, 0.5 * airframe.body_height_m + 0.3}, 0.4, 0.0};
  Vehicle alone{airframe, 0.7, start};
  Vehicle multibody{airframe, 0.7, start, weightless};
  const double hover = hover_rev_s(airframe, alone.mass_kg());
  double fastest_rad_s = 0.0;
  for (int i = 0; i < 3000; ++i) {  // Falls on a foot, leaves the ground, turns about all axes.
    const double t_s = i * dt_s;
    const double turn = 4.0 * std::sin(5.0 * t_s);
    const double lift = t_s < 0.5 ? 0.3 * hover : 1.1 * hover;
    const RotorSpeeds command{lift + turn, lift - 0.5 * turn, lift, lift + 0.3 * turn};
    const Vec3 wind_W{3.0 * std::cos(t_s), -2.0, 0.5};
    alone.step(dt_s, command, wind_W);
    multibody.step(dt_s, command, wind_W);
    const VehicleState& a = alone.state();
    const VehicleState& b = multibody.state();
    ASSERT_LT((a.X_WB.matrix() - b.X_WB.matrix()).cwiseAbs().maxCoeff(), 1e-6) << t_s;
    ASSERT_LT((a.a_WB - b.a_WB).norm(), 1e-4) << t_s;
    ASSERT_LT((a.w_WB_B - b.w_WB_B).norm(), 1e-5) << t_s;
    fastest_rad_s = std::max(fastest_rad_s, a.w_WB_B.norm());
  }
  EXPECT_GT(fastest_rad_s, 1.0);
  EXPECT_GT(alone.contact_loss_j(), 1.0);
  EXPECT_NEAR(alone.kinetic_j(), multibody.kinetic_j(), 1e-3);
  EXPECT_NEAR(alone.potential_j(), multibody.potential_j(), 1e-3);
}

TEST(Vehicle, goes_on_when_the_payload_leaves) {
  const Airframe airframe = in_vacuum();
  Vehicle vehicle{airframe, 1.0, {{0.0, 0.0, 100.0}, 0.4, 0.0}};
  const double hover = hover_rev_s(airframe, vehicle.mass_kg());
  for (int i = 0; i < 1000; ++i) {
    vehicle.step(dt_s, {hover, hover, hover + 0.01, hover}, calm);
  }
  const VehicleState before = vehicle.state();
  vehicle.set_payload(0.0);
  EXPECT_DOUBLE_EQ(vehicle.mass_kg(), airframe.mass_kg);
  EXPECT_EQ(vehicle.state().X_WB.matrix(), before.X_WB.matrix());
  vehicle.step(1e-9, before.rotor_rev_s, calm);
  EXPECT_LT((vehicle.state().v_WB - before.v_WB).norm(), 1e-7);
  EXPECT_LT((vehicle.state().w_WB_B - before.w_WB_B).norm(), 1e-7);
  EXPECT_LT((vehicle.state().X_WB.matrix() - before.X_WB.matrix()).norm(), 1e-7);
  // The same thrust now lifts less: a = (m_before / m_after) (a + g) - g along the thrust.
  const double lift_m_s2 = (vehicle.state().a_WB + gravity_m_s2 * Vec3::UnitZ()).norm();
  EXPECT_NEAR(lift_m_s2, gravity_m_s2 * (airframe.mass_kg + 1.0) / airframe.mass_kg, 0.01);
}

TEST(Vehicle, repeats_itself_bit_for_bit) {
  const auto fly = [] {
    Flight flight{0.5};
    flight.wind_W = {1.0, 2.0, 0.0};
    flight.follow(2.0, Turn{});
    return flight.state();
  };
  const VehicleState a = fly();
  const VehicleState b = fly();
  EXPECT_EQ(std::memcmp(a.X_WB.data(), b.X_WB.data(), 16 * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(a.v_WB.data(), b.v_WB.data(), 3 * sizeof(double)), 0);
  EXPECT_EQ(a.rotor_rev_s, b.rotor_rev_s);
}

TEST(VehicleDeathTest, refuses_a_step_that_is_not_positive_or_finite) {
  Vehicle vehicle{in_vacuum(), 0.0, {{0.0, 0.0, 100.0}, 0.0, 0.0}};
  EXPECT_DEATH(vehicle.step(0.0, all(0.0), calm), "dt_s=0");
  EXPECT_DEATH(vehicle.step(dt_s, {0.0, NAN, 0.0, 0.0}, calm), "not finite");
}

}  // namespace
}  // namespace flyball

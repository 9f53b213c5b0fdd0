// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/motion/setpoint_motion.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double tiny = 1e-9;  // Roundings of sums of some hundred numbers near 1.

Setpoint moving(const Vec3& v_WB, const Vec3& a_WB) {
  Setpoint setpoint;
  setpoint.v_WB = v_WB;
  setpoint.a_WB = a_WB;
  return setpoint;
}

TEST(SetpointMotion, a_braking_set_point_ends_where_it_stops) {
  const Setpoint braking = moving({2.0, 0.0, 0.0}, {-4.0, 0.0, 0.0});
  EXPECT_NEAR(extrapolated(braking, 0.25).p_WB.x(), 2.0 * 0.25 - 2.0 * 0.0625, tiny);
  const Setpoint stopped = extrapolated(braking, 3.0);
  EXPECT_NEAR(stopped.p_WB.x(), 0.5, tiny);  // 2^2 / (2 * 4)
  EXPECT_EQ(stopped.v_WB, Vec3::Zero());
  EXPECT_EQ(stopped.a_WB, Vec3::Zero());
}

TEST(SetpointMotion, a_set_point_speeds_up_for_a_tenth_of_a_second_only) {
  const Setpoint later = extrapolated(moving({1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}), 1.1);
  EXPECT_NEAR(later.v_WB.x(), 1.2, tiny);
  EXPECT_NEAR(later.p_WB.x(), 0.1 + 0.01 + 1.2, tiny);
}

TEST(SetpointMotion, the_yaw_goes_on_at_its_rate) {
  Setpoint turning;
  turning.yaw_rad = 0.5;
  turning.yaw_rate_rad_s = 0.2;
  EXPECT_NEAR(extrapolated(turning, 2.0).yaw_rad, 0.9, tiny);
}

TEST(SetpointMotion, a_reference_brakes_to_zero_and_not_beyond) {
  Setpoint reference = moving({0.0, 1.0, 0.0}, Vec3::Zero());
  for (int i = 0; i < 100; ++i) {
    const Vec3 before = reference.v_WB;
    brake_reference(reference, 0.01);
    move_reference(reference, before, 0.01);
    EXPECT_LE(reference.a_WB.norm(), 5.0 + tiny);
  }
  EXPECT_EQ(reference.v_WB, Vec3::Zero());
  EXPECT_NEAR(reference.p_WB.y(), 0.1, 0.005 + tiny);  // 1 / (2 * 5), and half a step.
}

TEST(SetpointMotion, a_reference_climbs_to_its_height_and_sinks_to_a_lower_one) {
  for (const double height_m : {3.0, -1.0}) {
    Setpoint reference;
    for (int i = 0; i < 500; ++i) {
      const Vec3 before = reference.v_WB;
      climb_reference(reference, height_m, 0.01);
      move_reference(reference, before, 0.01);
      EXPECT_LE(reference.v_WB.norm(), 1.5 + tiny);
    }
    EXPECT_EQ(reference.p_WB.z(), height_m);
    EXPECT_EQ(reference.v_WB, Vec3::Zero());
  }
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/setpoint_stream.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr double tiny = 1e-9;  // Roundings of sums of some hundred numbers near 1.

VehicleMotion moving(const Vec3& p_WB, const Vec3& v_WB) {
  VehicleMotion motion;
  motion.X_WB.translation() = p_WB;
  motion.v_WB = v_WB;
  return motion;
}

Setpoint at(Duration stamp, const Vec3& p_WB, const Vec3& v_WB) {
  Setpoint setpoint;
  setpoint.stamp = MissionTime{stamp};
  setpoint.p_WB = p_WB;
  setpoint.v_WB = v_WB;
  return setpoint;
}

TEST(SetpointStream, says_nothing_until_it_is_told_something) {
  SetpointStream stream;
  EXPECT_FALSE(stream.due(1s, moving(Vec3::Zero(), Vec3::Zero())));
}

TEST(SetpointStream, sends_fifty_in_a_second_however_often_it_is_asked) {
  SetpointStream stream;
  const VehicleMotion still = moving({1.0, 2.0, 3.0}, Vec3::Zero());
  stream.stop(still, 0s);
  int sent = 0;
  for (Duration now{}; now < 1s; now += 1ms) {
    const auto setpoint = stream.due(now, still);
    sent += setpoint ? 1 : 0;
    EXPECT_TRUE(!setpoint || setpoint->p_WB.isApprox(Vec3{1.0, 2.0, 3.0}));
  }
  EXPECT_EQ(sent, 50);
}

TEST(SetpointStream, sends_one_and_not_a_heap_after_a_pause) {
  SetpointStream stream;
  const VehicleMotion still = moving(Vec3::Zero(), Vec3::Zero());
  stream.stop(still, 0s);
  EXPECT_TRUE(stream.due(0s, still));
  EXPECT_TRUE(stream.due(500ms, still));
  EXPECT_FALSE(stream.due(501ms, still));
  EXPECT_TRUE(stream.due(520ms, still));
}

TEST(SetpointStream, moves_the_flights_set_point_on_between_two_of_them) {
  SetpointStream stream;
  stream.follow(at(1s, {0.0, 0.0, 2.0}, {3.0, 0.0, 0.0}));
  const auto sent = stream.due(1100ms, moving(Vec3::Zero(), Vec3::Zero()));
  ASSERT_TRUE(sent);
  EXPECT_NEAR(sent->p_WB.x(), 0.3, tiny);
  EXPECT_NEAR(sent->v_WB.x(), 3.0, tiny);
}

TEST(SetpointStream, stops_where_the_vehicle_is_when_no_set_point_came_for_half_a_second) {
  SetpointStream stream;
  stream.follow(at(1s, {0.0, 0.0, 2.0}, {2.0, 0.0, 0.0}));
  const VehicleMotion vehicle = moving({0.9, 0.0, 2.0}, {2.0, 0.0, 0.0});
  EXPECT_TRUE(stream.due(1500ms, vehicle));
  EXPECT_EQ(stream.motion(), SetpointStream::Motion::follow);
  std::optional<Setpoint> last;
  for (Duration now = 1510ms; now < 3s; now += 10ms) {
    const auto sent = stream.due(now, vehicle);
    last = sent ? sent : last;
  }
  EXPECT_EQ(stream.motion(), SetpointStream::Motion::stop);
  ASSERT_TRUE(last);
  // From 2 m/s at 5 m/s^2: 2^2 / (2 * 5) = .4 m, and up to a period of 20 ms less.
  EXPECT_NEAR(last->p_WB.x(), 0.9 + 0.4, 0.5 * 2.0 * 0.02 + tiny);
  EXPECT_EQ(last->v_WB, Vec3::Zero());
}

TEST(SetpointStream, climbs_straight_up_and_stays_there) {
  SetpointStream stream;
  const VehicleMotion ground = moving({1.0, 1.0, 0.1}, {0.1, 0.0, 0.0});
  stream.climb(ground, 2.1, 0s);
  double fastest_m_s = 0.0;
  std::optional<Setpoint> last;
  for (Duration now{}; now < 4s; now += 20ms) {
    if (const auto sent = stream.due(now, ground)) {
      fastest_m_s = std::max(fastest_m_s, sent->v_WB.z());
      EXPECT_TRUE(sent->p_WB.head<2>().isApprox(Eigen::Vector2d{1.0, 1.0}));
      last = sent;
    }
  }
  EXPECT_NEAR(fastest_m_s, 1.5, tiny);
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->p_WB.z(), 2.1, tiny);
  EXPECT_EQ(last->v_WB, Vec3::Zero());
}

TEST(SetpointStream, keeps_the_yaw_that_it_streamed_last) {
  SetpointStream stream;
  Setpoint turned = at(0s, Vec3::Zero(), Vec3::Zero());
  turned.yaw_rad = 1.2;
  stream.follow(turned);
  const VehicleMotion vehicle = moving(Vec3::Zero(), Vec3::Zero());  // Whose yaw is still 0.
  EXPECT_TRUE(stream.due(0s, vehicle));
  stream.stop(vehicle, 20ms);
  const auto sent = stream.due(20ms, vehicle);
  ASSERT_TRUE(sent);
  EXPECT_EQ(sent->yaw_rad, 1.2);
}

}  // namespace
}  // namespace flyball

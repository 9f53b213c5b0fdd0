// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/speed_limit.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(SpeedLimit, gives_the_speeds_that_MAVBench_prints) {
  // MICRO 2018: 8.83 to 1.57 m/s for 0 to 4 s of response time; d = 6.5 m, a = 6 m/s^2.
  const SpeedLimit limit{6.0};
  EXPECT_NEAR(limit.speed_m_s(0.0, 6.5), 8.83, 0.005);
  EXPECT_NEAR(limit.speed_m_s(4.0, 6.5), 1.57, 0.005);
}

TEST(SpeedLimit, uses_its_distance_up_by_reacting_and_braking) {
  const SpeedLimit limit{3.0};
  for (const double latency_s : {0.0, 0.3, 2.0, 20.0}) {
    for (const double distance_m : {0.01, 1.0, 7.0, 25.0}) {
      const double v = limit.speed_m_s(latency_s, distance_m);
      EXPECT_NEAR(v * latency_s + v * v / (2.0 * 3.0), distance_m, 1e-9);
    }
  }
}

TEST(SpeedLimit, prices_a_second_of_latency_by_what_it_costs_in_joules_per_metre) {
  const SpeedLimit limit{6.0};
  const double latency_s = 0.6;
  const double distance_m = 6.35;
  const double power_w = 360.0;
  const double slope_w_s_m = -2.595;  // eq. 1 of the same paper, Matrice 100
  const auto joules_per_metre = [&](double latency) {
    const double v = limit.speed_m_s(latency, distance_m);
    const double here_m_s = limit.speed_m_s(latency_s, distance_m);
    return (power_w + slope_w_s_m * (v - here_m_s)) / v;
  };
  const double h = 1e-6;
  const double v = limit.speed_m_s(latency_s, distance_m);
  const double worth =
      v * (joules_per_metre(latency_s + h) - joules_per_metre(latency_s - h)) / (2.0 * h);
  EXPECT_NEAR(limit.watts_per_second(power_w, latency_s, distance_m, slope_w_s_m), worth, 1e-4);
}

TEST(SpeedLimit, at_2_s_and_3_m_s_a_tenth_of_a_second_is_worth_more_than_a_computer_takes) {
  const SpeedLimit limit{3.0};
  const double distance_m = 3.0 * 2.0 + 3.0 * 3.0 / (2.0 * 3.0);
  EXPECT_NEAR(0.1 * limit.watts_per_second(500.0, 2.0, distance_m), 50.0 / 3.0, 1e-9);
}

TEST(SpeedLimit, stands_still_without_room) {
  EXPECT_EQ(SpeedLimit{}.speed_m_s(0.1, 0.0), 0.0);
  EXPECT_EQ(SpeedLimit{}.watts_per_second(300.0, 0.1, 0.0), 0.0);
}

}  // namespace
}  // namespace flyball

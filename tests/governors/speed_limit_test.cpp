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

TEST(SpeedLimit, is_its_own_inverse_in_latency_and_in_distance) {
  const SpeedLimit limit{3.0};
  for (const double latency_s : {0.0, 0.3, 2.0, 20.0}) {
    for (const double distance_m : {0.01, 1.0, 7.0, 25.0}) {
      const double v = limit.speed_m_s(latency_s, distance_m);
      EXPECT_NEAR(limit.latency_s(v, distance_m), latency_s, 1e-9);
      EXPECT_NEAR(limit.distance_m(v, latency_s), distance_m, 1e-9);
    }
  }
}

TEST(SpeedLimit, has_no_latency_left_for_a_speed_that_cannot_be_stopped) {
  EXPECT_EQ(SpeedLimit{6.0}.latency_s(10.0, 5.0), 0.0);  // needs 8.3 m for braking alone
}

TEST(SpeedLimit, derivatives_agree_with_differences) {
  const SpeedLimit limit{6.0};
  const double h = 1e-6;
  for (const double latency_s : {0.1, 0.8, 3.0}) {
    for (const double distance_m : {0.5, 6.5, 25.0}) {
      const double by_latency = (limit.speed_m_s(latency_s + h, distance_m) -
                                 limit.speed_m_s(latency_s - h, distance_m)) /
                                (2.0 * h);
      const double by_distance = (limit.speed_m_s(latency_s, distance_m + h) -
                                  limit.speed_m_s(latency_s, distance_m - h)) /
                                 (2.0 * h);
      // A central difference of a quotient: h^2 and rounding / h are both below 1e-7 here.
      EXPECT_NEAR(limit.speed_per_latency_m_s2(latency_s, distance_m), by_latency, 1e-6);
      EXPECT_NEAR(limit.speed_per_distance_1_s(latency_s, distance_m), by_distance, 1e-6);
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
  const double distance_m = limit.distance_m(3.0, 2.0);
  EXPECT_NEAR(0.1 * limit.watts_per_second(500.0, 2.0, distance_m), 50.0 / 3.0, 1e-9);
}

TEST(SpeedLimit, stands_still_without_room) {
  EXPECT_EQ(SpeedLimit{}.speed_m_s(0.1, 0.0), 0.0);
  EXPECT_EQ(SpeedLimit{}.speed_per_latency_m_s2(0.1, 0.0), 0.0);
  EXPECT_EQ(SpeedLimit{}.watts_per_second(300.0, 0.1, 0.0), 0.0);
}

}  // namespace
}  // namespace flyball

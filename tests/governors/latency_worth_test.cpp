// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/latency_worth.h"

#include "flyball/runtime/guard.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(LatencyWorth, is_what_a_second_costs_in_joules_per_metre) {
  const double a_m_s2 = 6.0;
  const double latency_s = 0.6;
  const double distance_m = 6.35;
  const double power_w = 360.0;
  const double slope_w_s_m = -2.595;  // eq. 1 of the same paper, Matrice 100
  const double v = safe_speed(a_m_s2, latency_s, distance_m);
  const auto joules_per_metre = [&](double latency) {
    const double then_m_s = safe_speed(a_m_s2, latency, distance_m);
    return (power_w + slope_w_s_m * (then_m_s - v)) / then_m_s;
  };
  const double h = 1e-6;
  const double worth =
      v * (joules_per_metre(latency_s + h) - joules_per_metre(latency_s - h)) / (2.0 * h);
  EXPECT_NEAR(watts_per_second(a_m_s2, latency_s, v, power_w, slope_w_s_m), worth, 1e-4);
}

TEST(LatencyWorth, at_2_s_and_3_m_s_a_tenth_of_a_second_is_more_than_a_computer_takes) {
  EXPECT_NEAR(0.1 * watts_per_second(3.0, 2.0, 3.0, 500.0, 0.0), 50.0 / 3.0, 1e-9);
}

TEST(LatencyWorth, is_nothing_for_who_stands) {
  EXPECT_EQ(watts_per_second(6.0, 0.1, 0.0, 300.0, 0.0), 0.0);
}

}  // namespace
}  // namespace flyball

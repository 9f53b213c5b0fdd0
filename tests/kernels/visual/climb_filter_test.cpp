// SPDX-License-Identifier: BSD-3-Clause
#include "visual/climb_filter.h"

#include "flyball/runtime/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at(int sample) {
  return MissionTime{from_seconds(0.01 * sample)};
}

TEST(ClimbFilter, begins_with_its_first_sample) {
  ClimbFilter filter;
  filter.update(412.0, at(0));
  EXPECT_EQ(filter.height_m(), 412.0);
  EXPECT_EQ(filter.climb_m_s(), 0.0);
}

TEST(ClimbFilter, does_not_lag_in_a_steady_climb) {
  ClimbFilter filter;
  for (int i = 0; i <= 1000; ++i) {
    filter.update(400.0 + 1.5 * 0.01 * i, at(i));
  }
  EXPECT_NEAR(filter.height_m(), 415.0, 1e-3);
  EXPECT_NEAR(filter.climb_m_s(), 1.5, 1e-3);
}

TEST(ClimbFilter, knows_within_a_second_that_a_climb_began) {
  ClimbFilter filter;
  double height_m = 0.0;
  for (int i = 0; i <= 200; ++i) {
    height_m += i > 100 ? 0.015 : 0.0;
    filter.update(height_m, at(i));
  }
  EXPECT_NEAR(filter.climb_m_s(), 1.5, 0.3);
  EXPECT_NEAR(filter.height_m(), height_m, 0.05);
}

TEST(ClimbFilter, makes_3_cm_of_a_decimetre_of_noise) {
  ClimbFilter filter;
  RandomStream noise{3, "climb_filter_test"};
  double squares = 0.0;
  constexpr int samples = 20000;
  for (int i = 0; i < samples; ++i) {
    filter.update(0.1 * noise.normal(), at(i));
    squares += filter.height_m() * filter.height_m();
  }
  EXPECT_NEAR(std::sqrt(squares / samples), 0.025, 0.01);
}

TEST(ClimbFilter, begins_anew_after_a_gap) {
  ClimbFilter filter;
  for (int i = 0; i <= 100; ++i) {
    filter.update(1.5 * 0.01 * i, at(i));
  }
  filter.update(30.0, at(200));
  EXPECT_EQ(filter.height_m(), 30.0);
  EXPECT_EQ(filter.climb_m_s(), 0.0);
}

}  // namespace
}  // namespace flyball

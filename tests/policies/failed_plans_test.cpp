// SPDX-License-Identifier: BSD-3-Clause
#include "mission_energy/failed_plans.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Observation flying(double t_s, std::uint32_t failures) {
  Observation seen;
  seen.now = MissionTime{from_seconds(t_s)};
  seen.speed_m_s = 5.0;
  seen.planner_failures = failures;
  return seen;
}

TEST(FailedPlans, become_rarer_with_the_distance_flown_in_large_cells) {
  FailedPlans plans;
  EXPECT_DOUBLE_EQ(plans.per_m(), 0.002);
  for (int i = 0; i <= 60; ++i) {
    plans.note(flying(i, 0), true);
  }
  EXPECT_NEAR(plans.per_m(), 0.5 / 550.0, 1e-9);
}

TEST(FailedPlans, count_once_for_each_row_of_failures) {
  FailedPlans plans;
  plans.note(flying(0.0, 0), true);
  plans.note(flying(0.0, 1), true);
  plans.note(flying(0.0, 2), true);
  EXPECT_DOUBLE_EQ(plans.per_m(), 0.006);
  plans.note(flying(0.0, 0), true);
  plans.note(flying(0.0, 1), true);
  EXPECT_DOUBLE_EQ(plans.per_m(), 0.01);
}

TEST(FailedPlans, say_nothing_about_large_cells_where_there_are_none) {
  FailedPlans plans;
  for (int i = 0; i <= 60; ++i) {
    plans.note(flying(i, i % 2 == 0 ? 0U : 1U), false);
  }
  EXPECT_DOUBLE_EQ(plans.per_m(), 0.002);
}

TEST(FailedPlans, survive_what_is_no_number) {
  FailedPlans plans;
  Observation seen = flying(0.0, 0);
  plans.note(seen, true);
  seen.now += std::chrono::seconds{1};
  for (const double speed_m_s : {std::numeric_limits<double>::quiet_NaN(), -3.0, 1e300}) {
    seen.speed_m_s = speed_m_s;
    plans.note(seen, true);
  }
  EXPECT_DOUBLE_EQ(plans.per_m(), 0.002);
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "mission_energy/failed_plans.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

const std::vector<double> cells_m{0.15, 0.30, 0.60, 1.20};
constexpr double begins = 0.5 / 250.0;

Observation flying(double t_s, std::uint32_t failures) {
  Observation seen;
  seen.now = MissionTime{from_seconds(t_s)};
  seen.speed_m_s = 5.0;
  seen.planner_failures = failures;
  return seen;
}

TEST(FailedPlans, have_a_price_in_large_cells_only) {
  EXPECT_EQ((FailedPlans{cells_m, 0.35}.per_m()), (std::vector<double>{0.0, 0.0, begins, begins}));
}

TEST(FailedPlans, become_rarer_with_the_distance_flown_in_cells_that_are_no_finer) {
  FailedPlans plans{cells_m, 0.35};
  for (int i = 0; i <= 60; ++i) {
    plans.note(flying(i, 0), 1.20);
  }
  EXPECT_NEAR(plans.per_m()[2], 0.5 / 550.0, 1e-9) << "what 1.2 m leaves open, .6 m leaves open";
  EXPECT_NEAR(plans.per_m()[3], 0.5 / 550.0, 1e-9);
  for (int i = 61; i <= 120; ++i) {
    plans.note(flying(i, 0), 0.60);
  }
  EXPECT_NEAR(plans.per_m()[2], 0.5 / 850.0, 1e-9);
  EXPECT_NEAR(plans.per_m()[3], 0.5 / 550.0, 1e-9) << ".6 m says nothing about 1.2 m";
}

TEST(FailedPlans, count_once_for_each_row_of_failures) {
  FailedPlans plans{cells_m, 0.35};
  plans.note(flying(0.0, 0), 0.60);
  plans.note(flying(0.0, 1), 0.60);
  plans.note(flying(0.0, 2), 0.60);
  EXPECT_DOUBLE_EQ(plans.per_m()[2], 0.006);
  plans.note(flying(0.0, 0), 0.60);
  plans.note(flying(0.0, 1), 0.60);
  EXPECT_DOUBLE_EQ(plans.per_m()[2], 0.01);
}

TEST(FailedPlans, count_for_coarser_cells_too_and_not_for_finer_ones) {
  FailedPlans plans{cells_m, 0.35};
  plans.note(flying(0.0, 1), 1.20);
  EXPECT_DOUBLE_EQ(plans.per_m()[2], begins);
  EXPECT_DOUBLE_EQ(plans.per_m()[3], 0.006);
  plans.note(flying(0.0, 0), 0.60);
  plans.note(flying(0.0, 1), 0.60);
  EXPECT_DOUBLE_EQ(plans.per_m()[2], 0.006);
  EXPECT_DOUBLE_EQ(plans.per_m()[3], 0.01);
}

TEST(FailedPlans, say_nothing_about_large_cells_where_there_are_none) {
  FailedPlans plans{cells_m, 0.35};
  for (int i = 0; i <= 60; ++i) {
    plans.note(flying(i, i % 2 == 0 ? 0U : 1U), 0.30);
  }
  EXPECT_EQ(plans.per_m().back(), begins);
}

TEST(FailedPlans, survive_what_is_no_number) {
  FailedPlans plans{cells_m, 0.35};
  Observation seen = flying(0.0, 0);
  plans.note(seen, 1.20);
  seen.now += std::chrono::seconds{1};
  for (const double speed_m_s : {std::numeric_limits<double>::quiet_NaN(), -3.0, 1e300}) {
    seen.speed_m_s = speed_m_s;
    plans.note(seen, 1.20);
  }
  EXPECT_EQ(plans.per_m().back(), begins);
}

}  // namespace
}  // namespace flyball

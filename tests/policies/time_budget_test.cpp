// SPDX-License-Identifier: BSD-3-Clause
#include "roborun/time_budget.h"

#include <array>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(TimeBudget, with_braking_is_the_latency_of_the_speed_limit) {
  const TimeBudget budget{StoppingDistance::braking(6.0), 1.0, 100.0};
  for (const double v : {0.5, 2.0, 6.0}) {
    EXPECT_DOUBLE_EQ(budget.budget_s(v, 7.0), 7.0 / v - v / (2.0 * 6.0));
  }
}

TEST(TimeBudget, of_RoboRun_follows_its_polynomial) {
  const TimeBudget budget{StoppingDistance::roborun(), 1.0, 15.0};
  // (10 - .05494 * 4 - .3549 * 2 + .2038) / 2
  EXPECT_NEAR(budget.budget_s(2.0, 10.0), 4.63712, 1e-12);
  const TimeBudget halved{StoppingDistance::roborun(), 0.5, 15.0};
  EXPECT_NEAR(halved.budget_s(2.0, 10.0), 2.31856, 1e-12);
}

TEST(TimeBudget, is_the_cap_at_rest_and_nothing_without_room) {
  const TimeBudget budget{StoppingDistance::roborun(), 0.5, 15.0};
  EXPECT_EQ(budget.budget_s(0.0, 5.0), 15.0);
  EXPECT_EQ(budget.budget_s(1e-300, 5.0), 15.0);
  EXPECT_EQ(budget.budget_s(6.0, 0.0), 0.0);
  EXPECT_EQ(budget.budget_s(0.0, -1.0), 0.0);
}

TEST(RolledBudget, of_one_way_point_is_its_own) {
  EXPECT_EQ(rolled_budget_s(nullptr, 0, 0.2), 0.0);
  const double here = 1.3;
  EXPECT_EQ(rolled_budget_s(&here, 1, 0.2), 1.3);
}

TEST(RolledBudget, in_space_that_stays_as_open_is_the_first_budget) {
  const std::array<double, 4> local{1.0, 1.0, 1.0, 1.0};
  EXPECT_NEAR(rolled_budget_s(local.data(), local.size(), 0.2), 1.0, 1e-12);
}

TEST(RolledBudget, is_cut_by_a_narrower_place_ahead) {
  // .4 s to the third way-point, which leaves .1 s.
  const std::array<double, 4> local{5.0, 5.0, 0.1, 0.0};
  EXPECT_NEAR(rolled_budget_s(local.data(), local.size(), 0.2), 0.5, 1e-12);
}

TEST(RolledBudget, ends_where_there_is_nothing_left) {
  const std::array<double, 3> local{5.0, 0.0, 5.0};
  EXPECT_NEAR(rolled_budget_s(local.data(), local.size(), 0.2), 0.2, 1e-12);
}

TEST(BudgetAhead, is_that_of_a_cruising_vehicle_at_its_speed) {
  // Each step takes its own time off what is left, and as much off the next way-point's budget.
  const TimeBudget budget{StoppingDistance::braking(3.0), 0.5, 15.0};
  EXPECT_NEAR(budget_ahead_s(budget, {6.0, 6.0, 3.0}, 18.0), budget.budget_s(6.0, 18.0), 1e-9);
}

TEST(BudgetAhead, of_a_vehicle_that_starts_is_what_it_has_until_it_must_stop_at_speed) {
  // 2 s and 6 m to 6 m/s; then 12 m are left, 6 m of them for the stop: 1 s.
  const TimeBudget budget{StoppingDistance::braking(3.0), 1.0, 15.0};
  EXPECT_NEAR(budget_ahead_s(budget, {0.0, 6.0, 3.0}, 18.0), 3.0, 0.15);
  EXPECT_EQ(budget_ahead_s(budget, {0.0, 6.0, 3.0}, 0.0), 0.0);
}

TEST(BudgetAhead, is_longer_for_a_slow_vehicle_and_shorter_the_less_is_known) {
  const TimeBudget budget{StoppingDistance::roborun(), 0.5, 15.0};
  double before_s = 0.0;
  for (const double known_m : {1.0, 5.0, 12.0, 25.0}) {
    const double now_s = budget_ahead_s(budget, {1.0, 6.0, 3.0}, known_m);
    EXPECT_GT(now_s, before_s) << known_m;
    EXPECT_GT(now_s, budget_ahead_s(budget, {6.0, 6.0, 3.0}, known_m)) << known_m;
    before_s = now_s;
  }
}

TEST(BudgetAhead, is_cut_to_its_share_of_the_cap) {
  const TimeBudget budget{StoppingDistance::braking(3.0), 0.5, 2.0};
  EXPECT_EQ(budget_ahead_s(budget, {0.5, 0.5, 3.0}, 1000.0), 1.0);
}

TEST(BudgetAhead, takes_the_commanded_speed_at_once_where_no_acceleration_is_known) {
  const TimeBudget budget{StoppingDistance::braking(3.0), 0.5, 15.0};
  EXPECT_NEAR(budget_ahead_s(budget, {0.0, 6.0, 0.0}, 18.0), budget.budget_s(6.0, 18.0), 1e-9);
}

}  // namespace
}  // namespace flyball

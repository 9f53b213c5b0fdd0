// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/plan_failures.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(PlanFailures, are_over_when_a_path_is_found_or_another_goal_is_flown_to) {
  PlanFailures failures;
  failures.search_failed();
  failures.search_failed();
  EXPECT_EQ(failures.count(), 2);
  failures.path_found();
  EXPECT_EQ(failures.count(), 0);
  failures.search_failed();
  failures.begin_goal();
  EXPECT_EQ(failures.count(), 0);
}

TEST(PlanFailures, count_stalls_until_the_vehicle_moves_on) {
  PlanFailures failures;
  failures.stalled();
  failures.path_found();
  EXPECT_EQ(failures.count(), 1) << "the path may end where the last one did";
  failures.stalled();
  failures.search_failed();
  EXPECT_EQ(failures.count(), 3);
  failures.moved();
  EXPECT_EQ(failures.count(), 0);
}

TEST(PlanFailures, outlast_moving_where_nothing_has_stalled) {
  PlanFailures failures;
  failures.search_failed();
  failures.moved();
  EXPECT_EQ(failures.count(), 1) << "a vehicle flies on while it searches";
}

TEST(PlanFailures, count_refused_paths_until_one_is_joined) {
  PlanFailures failures;
  failures.path_refused();
  failures.path_refused();
  failures.path_found();
  failures.moved();
  EXPECT_EQ(failures.refusals(), 2);
  EXPECT_EQ(failures.count(), 0);
  failures.path_joined();
  EXPECT_EQ(failures.refusals(), 0);
}

}  // namespace
}  // namespace flyball

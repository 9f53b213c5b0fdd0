// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/goal_patience.h"

#include <optional>
#include <utility>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr MissionTime start{100s};
constexpr double limit_s = 90.0;

GoalPatience begun() {
  GoalPatience patience{limit_s};
  patience.begin(start);
  return patience;
}

TEST(GoalPatience, ends_where_the_vehicle_stands_without_a_path) {
  GoalPatience patience = begun();
  EXPECT_FALSE(patience.note(start + 90s, 50.0, true));
  EXPECT_TRUE(patience.note(start + 91s, 50.0, true));
}

TEST(GoalPatience, begins_anew_when_the_vehicle_moves_or_has_no_goal) {
  using Moment = std::pair<std::optional<double>, bool>;
  for (const auto& [to_goal_m, rests] : {Moment{50.0, false}, Moment{std::nullopt, true}}) {
    GoalPatience patience = begun();
    EXPECT_FALSE(patience.note(start + 80s, to_goal_m, rests));
    EXPECT_FALSE(patience.note(start + 170s, 50.0, true));
    EXPECT_TRUE(patience.note(start + 171s, 50.0, true));
  }
}

TEST(GoalPatience, ends_also_where_the_goal_is_the_place_of_the_vehicle) {
  GoalPatience patience = begun();
  EXPECT_FALSE(patience.note(start + 90s, 0.0, true));
  EXPECT_TRUE(patience.note(start + 91s, 0.0, true)) << "there is no path that ends there";
}

TEST(GoalPatience, tells_whether_the_vehicle_has_come_nearer_for_a_limit) {
  GoalPatience patience = begun();
  (void)patience.note(start + 50s, 50.0, false);
  EXPECT_FALSE(patience.comes_no_nearer(start + 140s));
  EXPECT_TRUE(patience.comes_no_nearer(start + 141s));
  (void)patience.note(start + 141s, 40.0, false);
  EXPECT_FALSE(patience.comes_no_nearer(start + 231s));
}

TEST(GoalPatience, begins_anew_when_the_way_goes_on_after_something_else) {
  GoalPatience patience = begun();
  patience.resume(start + 80s);
  EXPECT_FALSE(patience.note(start + 170s, 50.0, true));
}

TEST(GoalPatience, allows_three_doubts_in_one_room_on_the_way_to_a_goal) {
  GoalPatience patience = begun();
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(patience.may_doubt(Vec3{1.0 * i, 0.0, 1.5}), i < 3);
  }
  EXPECT_TRUE(patience.may_doubt(Vec3{20.0, 0.0, 1.5})) << "elsewhere";
  patience.resume(start + 10s);
  EXPECT_FALSE(patience.may_doubt(Vec3::Zero())) << "it is the same goal";
  patience.begin(start + 20s);
  EXPECT_TRUE(patience.may_doubt(Vec3::Zero())) << "another goal";
}

TEST(GoalPatience, ends_after_a_doubt_where_the_vehicle_moves_but_comes_no_nearer) {
  for (const bool doubts : {false, true}) {
    GoalPatience patience = begun();
    EXPECT_FALSE(patience.note(start, 50.0, false));
    if (doubts) {
      ASSERT_TRUE(patience.may_doubt(Vec3::Zero()));
    }
    EXPECT_FALSE(patience.note(start + 270s, 49.5, false)) << "an evasion is no progress";
    EXPECT_EQ(patience.note(start + 271s, 49.5, false), doubts);
  }
}

TEST(GoalPatience, lasts_as_long_as_the_vehicle_comes_nearer) {
  GoalPatience patience = begun();
  ASSERT_TRUE(patience.may_doubt(Vec3::Zero()));
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(patience.note(start + i * 200s, 50.0 - 1.5 * i, false));
  }
}

}  // namespace
}  // namespace flyball

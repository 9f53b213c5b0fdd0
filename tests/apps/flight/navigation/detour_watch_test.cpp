// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/detour_watch.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

DetourWatch searched_in(double cells_m) {
  DetourWatch watch;
  watch.begin();
  watch.searched(cells_m);
  return watch;
}

TEST(DetourWatch, tells_once_that_cells_are_smaller_than_those_of_the_last_search) {
  DetourWatch watch = searched_in(0.3);
  EXPECT_FALSE(watch.shows_more(0.6));
  EXPECT_FALSE(watch.shows_more(0.3 - 1e-9)) << "rounding";
  EXPECT_TRUE(watch.shows_more(0.15));
  EXPECT_FALSE(watch.shows_more(0.15));
  EXPECT_TRUE(watch.shows_more(0.075));
  watch.searched(0.6);
  EXPECT_TRUE(watch.shows_more(0.15)) << "larger ones have been searched in since then";
}

TEST(DetourWatch, awaits_each_size_of_cells_once_on_the_way_to_a_goal) {
  DetourWatch watch = searched_in(0.3);
  EXPECT_FALSE(watch.may_await(0.3));
  EXPECT_TRUE(watch.may_await(0.15));
  watch.hold_back({}, 0.15);
  EXPECT_FALSE(watch.may_await(0.15));
  EXPECT_FALSE(watch.may_await(0.2)) << "smaller ones have been awaited";
  EXPECT_TRUE(watch.may_await(0.075));
  watch.begin();
  EXPECT_TRUE(watch.may_await(0.15)) << "another goal";
}

TEST(DetourWatch, keeps_a_detour_until_another_path_is_flown_or_another_goal_set) {
  const KnownPath detour{{Vec3{0, 0, 1}, Vec3{5, 5, 1}}, {0.4, 0.2}};
  DetourWatch watch = searched_in(0.3);
  EXPECT_FALSE(watch.holds_back());
  EXPECT_FALSE(watch.is_found_again(0.3)) << "nothing is held back";
  watch.hold_back(detour, 0.15);
  EXPECT_TRUE(watch.is_found_again(0.3));
  EXPECT_FALSE(watch.is_found_again(0.2)) << "any smaller cells may show more";
  watch.searched(0.2);
  EXPECT_FALSE(watch.is_found_again(0.2)) << "it was found in cells of .3 m";
  EXPECT_EQ(watch.take().waypoints_W, detour.waypoints_W);
  EXPECT_FALSE(watch.holds_back());

  watch.hold_back(detour, 0.1);
  watch.drop();
  EXPECT_FALSE(watch.holds_back());
  watch.hold_back(detour, 0.05);
  watch.begin();
  EXPECT_FALSE(watch.holds_back());
}

TEST(DetourWatchDeathTest, has_nothing_to_take_where_nothing_is_held_back) {
  DetourWatch watch = searched_in(0.3);
  EXPECT_DEATH((void)watch.take(), "no detour is held back");
}

}  // namespace
}  // namespace flyball

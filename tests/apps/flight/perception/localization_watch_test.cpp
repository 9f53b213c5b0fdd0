// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/localization_watch.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

VisualFix fix(bool tracked) {
  VisualFix made;
  made.tracked = tracked;
  return made;
}

PoseEstimate pose_at(double x_m) {
  PoseEstimate pose;
  pose.X_WB.translation() = Vec3{x_m, 0.0, 2.0};
  return pose;
}

LocalizationWatch lost_after(double path_m) {
  LocalizationWatch watch;
  for (double x = 0.0; x <= path_m; x += 0.05) {
    watch.passed(pose_at(x));
  }
  watch.fixed(at(9.0), fix(true));
  watch.fixed(at(10.0), fix(false));
  return watch;
}

TEST(LocalizationWatch, is_lost_from_the_first_frame_without_a_pose_to_the_next_with_one) {
  LocalizationWatch watch = lost_after(5.0);
  EXPECT_TRUE(watch.is_lost());
  watch.fixed(at(12.0), fix(false));
  EXPECT_TRUE(watch.is_lost());
  watch.fixed(at(13.0), fix(true));
  EXPECT_FALSE(watch.is_lost());
  const LocalizationStatus status = watch.status(at(20.0), 2.0, true);
  EXPECT_FALSE(status.is_lost || status.search);
  EXPECT_EQ(status.times_lost, 1);
  EXPECT_NEAR(status.lost_s, 3.0, 1e-9);
}

TEST(LocalizationWatch, stops_then_looks_to_both_sides_then_flies_back) {
  LocalizationWatch watch = lost_after(6.0);
  ASSERT_TRUE(watch.search(at(10.0), 2.0));
  EXPECT_NEAR(watch.search(at(11.0), 2.0)->p_WB.x(), 6.0, 0.2);
  EXPECT_EQ(watch.search(at(11.0), 2.0)->yaw_rad, 0.0) << "stopping";
  double left = 0.0;
  double right = 0.0;
  for (double t = 11.5; t < 17.4; t += 0.1) {
    const auto look = watch.search(at(t), 2.0);
    ASSERT_TRUE(look);
    EXPECT_GT(look->p_WB.x(), 5.75) << "in place";
    left = std::max(left, look->yaw_rad);
    right = std::min(right, look->yaw_rad);
  }
  EXPECT_NEAR(left, 1.047, 0.02);
  EXPECT_NEAR(right, -1.047, 0.02);
  const auto back = watch.search(at(21.5), 2.0);
  EXPECT_NEAR(back->p_WB.x(), 3.0, 0.5) << "along its own path";
  EXPECT_NEAR(back->yaw_rad, 0.0, 0.01) << "looking as it did when it came";
}

TEST(LocalizationWatch, searches_at_the_height_that_it_had_when_the_search_began) {
  LocalizationWatch watch = lost_after(6.0);
  EXPECT_EQ(watch.search(at(10.0), 3.5)->p_WB.z(), 3.5);
  EXPECT_EQ(watch.search(at(20.0), 1.0)->p_WB.z(), 3.5);
  watch.fixed(at(21.0), fix(true));
  watch.fixed(at(22.0), fix(false));
  EXPECT_EQ(watch.search(at(22.1), 1.5)->p_WB.z(), 1.5);
}

TEST(LocalizationWatch, begins_its_search_when_it_may_fly_one) {
  LocalizationWatch watch = lost_after(6.0);
  for (double t = 10.0; t < 20.0; t += 0.5) {
    EXPECT_FALSE(watch.status(at(t), 0.1 * t, false).search) << "the vehicle climbs";
  }
  const auto first = watch.status(at(20.0), 15.0, true).search;
  ASSERT_TRUE(first);
  EXPECT_EQ(first->p_WB.z(), 15.0);
  EXPECT_NEAR(first->p_WB.x(), 6.0, 0.2);
  EXPECT_GT(watch.status(at(23.0), 14.0, true).search->yaw_rad, 0.5) << "it looks aside after that";
  EXPECT_FALSE(watch.has_given_up(at(35.0)));
  EXPECT_TRUE(watch.has_given_up(at(45.0)));
}

TEST(LocalizationWatch, flies_back_no_farther_than_it_came) {
  LocalizationWatch watch = lost_after(1.0);
  (void)watch.search(at(10.0), 2.0);
  EXPECT_GE(watch.search(at(29.0), 2.0)->p_WB.x(), 0.0);
}

TEST(LocalizationWatch, gives_up_when_all_was_in_vain) {
  const LocalizationWatch watch = lost_after(5.0);
  EXPECT_FALSE(watch.has_given_up(at(25.0)));
  EXPECT_TRUE(watch.has_given_up(at(35.0)));
  EXPECT_FALSE(LocalizationWatch{}.has_given_up(at(1000.0)));
}

TEST(LocalizationWatch, asks_to_search_while_it_is_lost) {
  LocalizationWatch watch = lost_after(6.0);
  const LocalizationStatus status = watch.status(at(11.0), 2.0, true);
  EXPECT_TRUE(status.is_lost);
  ASSERT_TRUE(status.search);
  EXPECT_NEAR(status.search->p_WB.x(), 6.0, 0.2);
  EXPECT_NEAR(status.lost_s, 1.0, 1e-9);
}

TEST(LocalizationWatch, is_lost_when_the_camera_says_nothing_for_two_seconds) {
  LocalizationWatch watch;
  watch.waited(at(9.0));
  EXPECT_FALSE(watch.is_lost()) << "it has not begun";
  watch.fixed(at(10.0), fix(true));
  watch.waited(at(11.9));
  EXPECT_FALSE(watch.is_lost());
  watch.waited(at(12.1));
  EXPECT_TRUE(watch.is_lost());
  watch.waited(at(30.0));
  EXPECT_FALSE(watch.has_given_up(at(20.0)));
  EXPECT_TRUE(watch.has_given_up(at(40.0))) << "lost since 12.1 s, not since the last question";
  watch.fixed(at(41.0), fix(true));
  EXPECT_FALSE(watch.is_lost());
}

}  // namespace
}  // namespace flyball

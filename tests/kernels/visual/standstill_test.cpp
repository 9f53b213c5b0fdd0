// SPDX-License-Identifier: BSD-3-Clause
#include "visual/standstill.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double focal_px = 100.0;

MissionTime at_time(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

/// So many corners, three metres away, all shifted by so many pixels.
std::vector<TrackedPoint> corners(double shift_px, std::uint64_t count = 20) {
  std::vector<TrackedPoint> points;
  for (std::uint64_t id = 0; id < count; ++id) {
    const Eigen::Vector2d ray{0.02 * static_cast<double>(id), 0.1};
    points.push_back({id, ray + Eigen::Vector2d{shift_px / focal_px, 0.0}, 3.0, shift_px});
  }
  return points;
}

TEST(RestWatch, compares_with_the_same_view_while_nothing_moves) {
  RestWatch watch;
  for (int i = 0; i < 10; ++i) {
    const auto view = watch.compare(corners(0.0), at_time(0.1 * i), focal_px);
    EXPECT_EQ(view.has_value(), i == 5) << "twice a second";
  }
  const auto later = watch.compare(corners(0.2), at_time(1.0), focal_px);
  ASSERT_TRUE(later);
  EXPECT_NEAR(later->lasted_s, 1.0, 1e-9) << "since the first one";
  EXPECT_NEAR(later->moved_ray, 0.002, 1e-9);
  EXPECT_EQ(later->depth_m, 3.0);
}

TEST(RestWatch, begins_anew_after_motion_and_where_the_corners_have_changed) {
  RestWatch watch;
  (void)watch.compare(corners(0.0), at_time(0.0), focal_px);
  const auto moved = watch.compare(corners(5.0), at_time(0.5), focal_px);
  ASSERT_TRUE(moved);
  EXPECT_NEAR(moved->moved_ray, 0.05, 1e-9);
  const auto after = watch.compare(corners(5.0), at_time(1.0), focal_px);
  ASSERT_TRUE(after);
  EXPECT_NEAR(after->lasted_s, 0.5, 1e-9);
  EXPECT_NEAR(after->moved_ray, 0.0, 1e-9);
  EXPECT_FALSE(watch.compare(corners(0.0, 3), at_time(2.0), focal_px))
      << "three corners say nothing";
  EXPECT_FALSE(watch.compare(corners(0.0), at_time(2.4), focal_px)) << "nor is there a view before";
}

TEST(Standstill, corrects_speed_tilt_and_biases) {
  InertialFilter filter{{}};
  filter.start(Pose::Identity(), 0.05);
  const ImuSample sample{at_time(0.0), Vec3{0.01, 0.0, 0.0}, Vec3{0.0, 0.0, 9.80665}};
  for (int i = 0; i < 200; ++i) {
    filter.propagate(sample, 0.01, 0.0);
  }
  const double drifted_m_s = filter.v_WB().norm();
  EXPECT_GT(drifted_m_s, 0.1);
  filter.correct(standing(filter, sample, 0.01, 0.0));
  EXPECT_LT(filter.v_WB().norm(), 0.05 * drifted_m_s);
  EXPECT_NEAR(filter.gyro_bias_now().x(), 0.01, 0.003);
}

TEST(Standstill, weighs_a_slow_view_by_what_it_allows_for) {
  InertialFilter filter{{}};
  filter.start(Pose::Identity(), 0.05);
  for (int i = 0; i < 200; ++i) {
    filter.propagate({at_time(0.0), Vec3::Zero(), Vec3{0.1, 0.0, 9.80665}}, 0.01, 0.0);
  }
  InertialFilter vague = filter;
  filter.correct(slow(filter, 0.01));
  vague.correct(slow(vague, 1.0));
  EXPECT_LT(filter.v_WB().norm(), 0.01);
  EXPECT_GT(vague.v_WB().norm(), 0.05);
}

TEST(Shaking, is_the_spread_of_what_is_felt_and_nothing_at_first) {
  std::deque<Vec3> forces_B;
  for (std::size_t i = 0; i < shake_samples; ++i) {
    EXPECT_EQ(shaking(forces_B), 0.0);
    const double by = i % 2 == 0 ? 3.0 : -3.0;
    forces_B.emplace_back(by, by, 9.8 + by);
  }
  EXPECT_NEAR(shaking(forces_B), 3.0, 1e-9);
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "visual/dead_reckoning.h"

#include "flyball/runtime/atmosphere.h"

#include "visual/motion.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

NavigationSample sample(double t_s, double yaw_rad) {
  NavigationSample sample;
  sample.stamp = at(t_s);
  sample.q_WB_ahrs = Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()};
  return sample;
}

VisualFix fix(double t_s, const Vec3& p_WB, const Vec3& v_WB) {
  VisualFix made;
  made.captured = at(t_s);
  made.tracked = true;
  made.X_WB.translation() = p_WB;
  made.v_WB = v_WB;
  return made;
}

TEST(DeadReckoning, stands_where_it_was_placed_until_the_first_fix) {
  DeadReckoning reckoning;
  Pose X_WB = Pose::Identity();
  X_WB.translation() = Vec3{3, 4, 5};
  reckoning.start(X_WB);
  EXPECT_EQ(reckoning.estimate(sample(1.0, 0.0)).X_WB.translation(), (Vec3{3, 4, 5}));
}

TEST(DeadReckoning, carries_an_old_fix_on_to_now) {
  DeadReckoning reckoning;
  reckoning.start(Pose::Identity());
  (void)reckoning.estimate(sample(1.0, 0.0));
  reckoning.correct(fix(1.0, {10, 0, 2}, {3, 0, 0}));
  const auto now = reckoning.estimate(sample(1.2, 0.0));
  EXPECT_LT((now.X_WB.translation() - Vec3{10.6, 0, 2}).norm(), 1e-9);
  EXPECT_EQ(now.v_WB, (Vec3{3, 0, 0}));
}

TEST(DeadReckoning, turns_as_the_attitude_did_since_the_fix) {
  DeadReckoning reckoning;
  reckoning.start(Pose::Identity());
  for (int i = 0; i <= 20; ++i) {
    (void)reckoning.estimate(sample(0.01 * i, 1.0 + 0.02 * i));
  }
  VisualFix seen = fix(0.1, {0, 0, 0}, {0, 0, 0});
  seen.X_WB.linear() = rotation_of({0.0, 0.0, 0.5});  // The map's north is not the compass's.
  reckoning.correct(seen);
  const auto now = reckoning.estimate(sample(0.21, 1.42));
  EXPECT_NEAR(yaw_of(now.X_WB.linear().col(0)), 0.5 + 0.22, 1e-9);
}

TEST(DeadReckoning, knows_how_it_has_turned_since_a_fix_that_is_older_than_its_samples) {
  for (const int fixed_at : {-1, 110}) {  // Before the first sample, too.
    DeadReckoning reckoning;
    reckoning.start(Pose::Identity());
    PoseEstimate now;
    for (int i = fixed_at; i <= 1000; ++i) {
      if (i == fixed_at) {
        reckoning.correct(fix(0.01 * i, {0, 0, 0}, {0, 0, 0}));
      }
      now = reckoning.estimate(sample(0.01 * i + 0.005, 0.002 * i));
    }
    EXPECT_NEAR(yaw_of(now.X_WB.linear().col(0)), 0.002 * (1000 - fixed_at), 1e-9) << fixed_at;
  }
}

TEST(DeadReckoning, stands_still_when_fixes_fail_to_come) {
  DeadReckoning reckoning;
  reckoning.start(Pose::Identity());
  (void)reckoning.estimate(sample(0.0, 0.0));
  reckoning.correct(fix(0.0, {0, 0, 2}, {2, 0, 0}));
  VisualFix none = fix(0.1, {50, 50, 50}, {9, 9, 9});
  none.tracked = false;
  reckoning.correct(none);
  const auto late = reckoning.estimate(sample(5.0, 0.0));
  EXPECT_LT((late.X_WB.translation() - Vec3{1, 0, 2}).norm(), 1e-9);
  EXPECT_EQ(late.v_WB, (Vec3{0, 0, 0}));
}

NavigationSample climbing(double t_s, double height_m) {
  NavigationSample high = sample(t_s, 0.0);
  high.pressure_pa = standard_pressure_pa(400.0 + height_m);
  return high;
}

TEST(DeadReckoning, knows_how_high_it_has_climbed_without_a_fix) {
  DeadReckoning reckoning;
  Pose X_WB = Pose::Identity();
  X_WB.translation() = Vec3{3, 4, 0.1};
  reckoning.start(X_WB);
  PoseEstimate now;
  for (int i = 0; i <= 300; ++i) {
    now = reckoning.estimate(climbing(0.01 * i, 0.01 * i));
  }
  EXPECT_LT((now.X_WB.translation() - Vec3{3, 4, 3.1}).norm(), 0.02);
  EXPECT_NEAR(now.v_WB.z(), 1.0, 0.02);
}

TEST(DeadReckoning, climbs_from_an_old_fix_as_the_barometer_says) {
  DeadReckoning reckoning;
  reckoning.start(Pose::Identity());
  PoseEstimate now;
  for (int i = 0; i <= 1000; ++i) {  // Longer than attitudes are remembered.
    now = reckoning.estimate(climbing(0.01 * i, 0.005 * i));
    if (i == 110) {
      reckoning.correct(fix(1.0, {5, 0, 0.6}, {0, 0, 0}));
    }
  }
  EXPECT_LT((now.X_WB.translation() - Vec3{5, 0, 0.6 + 4.5}).norm(), 0.02);
  EXPECT_NEAR(now.v_WB.z(), 0.5, 0.02);
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/step_back.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr Duration dt = 20ms;

/// Has come 2 m along x, around a corner, and 1 m along y.
StepBack after_a_corner() {
  StepBack back;
  for (int i = 0; i <= 40; ++i) {
    back.flew(Vec3{0.05 * i, 0.0, 1.5});
  }
  for (int i = 1; i <= 20; ++i) {
    back.flew(Vec3{2.0, 0.05 * i, 1.5});
  }
  return back;
}

struct BackRide {
  StepBack back{after_a_corner()};
  StepBack::Hover hover{Vec3{2.0, 1.0, 1.5}, 0.0};
  MissionTime now{10s};
  double farthest_off_m{};  ///< From the way that it came.

  void tick(int n, bool is_at_it = true) {
    for (int i = 0; i < n; ++i) {
      now += dt;
      hover = back.tick(now, dt, hover, is_at_it);
      const double off_x = std::abs(hover.p_W.x() - 2.0);
      farthest_off_m = std::max(farthest_off_m, std::min(off_x, std::abs(hover.p_W.y())));
    }
  }
};

TEST(BlindZone, begins_where_the_camera_sees_a_whole_cell) {
  // A cell of .3 m above the body's .2 m ends .5 m above the axis: seen 1 m off with a tangent of
  // .5; .3 m for what is nearer of it, .4 m of body.
  EXPECT_NEAR(blind_m(0.3, {0.4, 0.2}, 0.5), 1.0 + 0.3 - 0.4, 1e-12);
  EXPECT_GT(blind_m(1.2, {0.4, 0.2}, 0.5), 2.0);
}

TEST(StepBack, flies_back_along_its_own_track) {
  BackRide ride;
  ASSERT_TRUE(ride.back.begin(2.0, 0.0));
  ride.tick(300);
  EXPECT_NEAR(ride.hover.p_W.x(), 1.0, 0.1);
  EXPECT_NEAR(ride.hover.p_W.y(), 0.0, 1e-9);
  EXPECT_LT(ride.farthest_off_m, 0.05) << "it cuts the corner";
}

TEST(StepBack, goes_no_farther_than_it_has_come) {
  BackRide ride;
  ASSERT_TRUE(ride.back.begin(20.0, 0.0));
  ride.tick(1000);
  EXPECT_NEAR(ride.hover.p_W.norm(), 1.5, 1e-9);  // Where it began.
}

TEST(StepBack, does_not_begin_without_a_track) {
  StepBack back;
  EXPECT_FALSE(back.begin(1.0, 0.0));
  back.flew(Vec3::Zero());
  EXPECT_FALSE(back.begin(1.0, 0.0));
  BackRide ride;
  ride.back.forget();
  EXPECT_FALSE(ride.back.begin(1.0, 0.0));
  EXPECT_FALSE(ride.back.is_active());
}

TEST(StepBack, ends_with_a_frame_that_was_taken_at_rest) {
  BackRide ride;
  ASSERT_TRUE(ride.back.begin(1.0, 1.5));
  EXPECT_FALSE(ride.back.has_looked(ride.now + 1h)) << "it has not arrived yet";
  ride.tick(50);
  const MissionTime under_way = ride.now;
  ride.tick(200, false);
  EXPECT_FALSE(ride.back.has_looked(ride.now)) << "the vehicle is not where its reference is";
  ride.tick(10);
  EXPECT_NEAR(ride.hover.yaw_rad, 1.5, 0.05);
  EXPECT_FALSE(ride.back.has_looked(under_way));
  EXPECT_TRUE(ride.back.has_looked(ride.now));
  EXPECT_FALSE(ride.back.is_active());
}

TEST(StepBack, gives_up_where_it_has_been_back_three_times) {
  StepBack back;
  int begun = 0;
  for (int i = 0; i < 10; ++i) {
    for (int k = 0; k <= 20; ++k) {
      back.flew(Vec3{0.1 * k, 0.0, 1.5});
    }
    begun += back.begin(1.0, 0.0) ? 1 : 0;
  }
  EXPECT_EQ(begun, 3);
  back.begin_goal();
  EXPECT_TRUE(back.begin(1.0, 0.0)) << "towards another goal";
  back.flew(Vec3{9.0, 0.0, 1.5});
  EXPECT_TRUE(back.begin(1.0, 0.0)) << "elsewhere it may help";
}

}  // namespace
}  // namespace flyball

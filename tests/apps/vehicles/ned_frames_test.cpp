// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/ned_frames.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double exact = 1e-12;  // A few roundings of numbers near 1.

TEST(NedFrames, east_is_x_north_is_y_and_up_is_z) {
  // 3 m north, 4 m east, 5 m down.
  EXPECT_TRUE(north_east_down_turned({3.0, 4.0, 5.0}).isApprox(Vec3{4.0, 3.0, -5.0}));
  EXPECT_TRUE(north_east_down_turned({4.0, 3.0, -5.0}).isApprox(Vec3{3.0, 4.0, 5.0}));
}

TEST(NedFrames, left_is_minus_right_and_up_is_minus_down) {
  EXPECT_TRUE(forward_right_down_turned({1.0, 2.0, 3.0}).isApprox(Vec3{1.0, -2.0, -3.0}));
}

TEST(NedFrames, yaw_counts_from_east_to_the_left_and_from_north_to_the_right) {
  EXPECT_NEAR(yaw_turned(0.0), 0.5 * pi, exact);           // Facing east.
  EXPECT_NEAR(yaw_turned(0.5 * pi), 0.0, exact);           // North.
  EXPECT_NEAR(std::abs(yaw_turned(-0.5 * pi)), pi, 1e-9);  // South, by either sign.
  EXPECT_NEAR(yaw_turned(yaw_turned(2.0)), 2.0, exact);
}

TEST(NedFrames, a_vehicle_that_faces_north_level_has_forward_on_y) {
  const Eigen::Matrix3d R_WB = q_WB_of(Eigen::Quaterniond::Identity()).toRotationMatrix();
  EXPECT_TRUE(R_WB.col(0).isApprox(Vec3::UnitY()));   // Forward is north.
  EXPECT_TRUE(R_WB.col(1).isApprox(-Vec3::UnitX()));  // Left is west.
  EXPECT_TRUE(R_WB.col(2).isApprox(Vec3::UnitZ()));
}

TEST(NedFrames, yaw_pitch_and_roll_keep_their_meaning) {
  // Facing east, nose up by 10 degrees: forward has a part upwards.
  const double up = pi / 18.0;
  const Eigen::Quaterniond q_ND = Eigen::AngleAxisd{0.5 * pi, Vec3::UnitZ()} *
                                  Eigen::AngleAxisd{up, Vec3::UnitY()} *
                                  Eigen::AngleAxisd{0.0, Vec3::UnitX()};
  const Eigen::Matrix3d R_WB = q_WB_of(q_ND).toRotationMatrix();
  EXPECT_TRUE(R_WB.col(0).isApprox(Vec3{std::cos(up), 0.0, std::sin(up)}));
  EXPECT_TRUE(R_WB.col(1).isApprox(Vec3::UnitY()));
  // Facing north, right side down by 10 degrees: left points up.
  const Eigen::Quaterniond rolled{Eigen::AngleAxisd{up, Vec3::UnitX()}};
  EXPECT_NEAR(q_WB_of(rolled).toRotationMatrix().col(1).z(), std::sin(up), exact);
}

TEST(NedFrames, the_start_is_where_both_sides_say) {
  const LocalOrigin origin{{10.0, 20.0, -1.0}, {5.0, 6.0, 0.5}};
  EXPECT_TRUE(origin.to_W({10.0, 20.0, -1.0}).isApprox(Vec3{5.0, 6.0, 0.5}));
  // 2 m north, 3 m east and 4 m above the start.
  EXPECT_TRUE(origin.to_W({12.0, 23.0, -5.0}).isApprox(Vec3{8.0, 8.0, 4.5}));
  EXPECT_TRUE(origin.to_N({8.0, 8.0, 4.5}).isApprox(Vec3{12.0, 23.0, -5.0}));
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/geometry.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double pi = 3.14159265358979323846;

TEST(Geometry, knows_the_point_of_a_box_that_is_nearest_to_another) {
  const Aabb box{Vec3{0, 0, 0}, Vec3{2, 4, 1}};
  EXPECT_EQ(box.nearest(Vec3{5, 8, 1}), (Vec3{2, 4, 1})) << "an edge";
  EXPECT_EQ(box.nearest(Vec3{1, -3, 0.5}), (Vec3{1, 0, 0.5})) << "a side";
  EXPECT_DOUBLE_EQ(box.distance_m(Vec3{5, 8, 1}), 5.0);
  EXPECT_TRUE(box.contains(box.nearest(Vec3{5, 8, 1})));
  const Vec3 inside{1, 1, 0.5};
  EXPECT_EQ(box.nearest(inside), inside);
  EXPECT_EQ(box.distance_m(inside), 0.0);
}

TEST(Geometry, wraps_angles_and_measures_headings_from_x_to_y) {
  EXPECT_NEAR(yaw_of(Vec3{0, 2, 7}), 0.5 * pi, 1e-12);
  EXPECT_NEAR(wrap_angle(yaw_of(Vec3{-1, 0, 0}) + 0.5 * pi), -0.5 * pi, 1e-12);
  EXPECT_NEAR(wrap_angle(7.0 * pi / 3.0), pi / 3.0, 1e-12);
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/camera_spec.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Pinhole, sees_half_its_field_from_the_axis_to_the_edge_of_the_image) {
  const Intrinsics camera = pinhole(640, 480, 1.2);
  EXPECT_NEAR(std::atan2(0.5 * camera.width_px, camera.focal_px), 0.6, 1e-12);
  EXPECT_DOUBLE_EQ(camera.centre_x_px, 319.5);
  EXPECT_DOUBLE_EQ(camera.centre_y_px, 239.5);
}

TEST(DepthCameraSpec, has_the_lens_that_its_field_of_view_asks_for) {
  DepthCameraSpec spec;
  spec.width_px = 100;
  spec.height_px = 50;
  spec.horizontal_field_rad = 1.5707963267948966;
  const Intrinsics camera = spec.intrinsics();
  EXPECT_EQ(camera.width_px, 100);
  EXPECT_EQ(camera.height_px, 50);
  EXPECT_NEAR(camera.focal_px, 50.0, 1e-9);
}

TEST(DepthCameraSpec, has_the_noise_of_its_two_sources_together) {
  DepthCameraSpec spec;
  EXPECT_EQ(spec.noise_m(0.5), 0.0) << "never below";
  EXPECT_NEAR(spec.noise_m(5.0), 0.0152, 1e-9);
  EXPECT_NEAR(spec.noise_m(10.0), 0.2377, 1e-9);
  spec.extra_noise_m = 0.1;
  EXPECT_NEAR(spec.noise_m(10.0), std::sqrt(0.2377 * 0.2377 + 0.01), 1e-9);
  spec.rgbd_noise = false;
  EXPECT_NEAR(spec.noise_m(10.0), 0.1, 1e-9);
}

TEST(DepthCameraSpec, has_a_noise_that_does_not_fall_with_the_depth) {
  const DepthCameraSpec spec;
  EXPECT_NEAR(spec.noise_m(6.0), 0.0251, 1e-9);
  EXPECT_NEAR(spec.noise_m(6.38), 0.0251, 1e-9) << "where the second line crosses zero";
  for (double depth_m = 0.0; depth_m < 20.0; depth_m += 0.01) {
    EXPECT_LE(spec.noise_m(depth_m), spec.noise_m(depth_m + 0.01)) << depth_m;
  }
}

}  // namespace
}  // namespace flyball

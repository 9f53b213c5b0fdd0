// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/view.h"

#include "flyball/sim/colour_camera.h"
#include "flyball/sim/depth_camera.h"

#include "circle_flight.h"
#include "simulation/seeing_setup.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(View, has_grey_and_depth_through_one_lens) {
  DepthCameraSpec spec;
  spec.width_px = 64;
  spec.height_px = 48;
  spec.rgbd_noise = false;
  World world;
  world.bounds_W = {Vec3{-20, -20, 0}, Vec3{20, 20, 10}};
  world.has_ground = false;
  world.boxes.push_back({Vec3{-4, 5, 0}, Vec3{0, 6, 10}});  // Ahead, to the left.
  const DepthCamera depth{world, spec, 1};
  const auto rgb = ColourCamera::make(world, colour_beside(spec));
  ASSERT_TRUE(rgb) << rgb.error().message;
  Pose X_WC = kit::circle_pose(0.0);
  X_WC.translation() = Vec3{0.0, 0.0, 5.0};
  const MissionTime now{from_seconds(2.0)};
  View view{depth.frame(X_WC, now, 3), (*rgb)->frame({X_WC, Pose::Identity()}, now, 3),
            Pose::Identity()};
  const VisualFrame frame = visual_frame(view);
  EXPECT_EQ(frame.captured, now);
  ASSERT_EQ(frame.grey.size(), 64U * 48U);
  ASSERT_EQ(frame.depth_m.size(), 64U * 48U);
  const auto pixel = [](int row, int column) {
    return static_cast<std::size_t>(row * 64 + column);
  };
  EXPECT_NEAR(frame.depth_m[pixel(24, 16)], 5.0, 0.01) << "the box";
  EXPECT_FALSE(std::isfinite(frame.depth_m[pixel(24, 48)])) << "the sky";
  // The box's edge stands in the middle in both images.
  const auto step = [&](int column) {
    return std::abs(int{frame.grey[pixel(24, column)]} - int{frame.grey[pixel(24, column + 2)]});
  };
  EXPECT_GT(step(30), 4 * std::max(1, step(50))) << "sky is even";
}

std::vector<std::uint8_t> grey_of(std::vector<std::uint8_t> rgb) {
  View view;
  DepthImage depth;
  depth.camera = {3, 1, 1.0, 1.0, 0.0};
  depth.depth_m = {1.0F, 1.0F, 1.0F};
  ColourImage colour;
  colour.camera = depth.camera;
  colour.rgb = std::move(rgb);
  view.depth.image = Deferred<DepthImage>{[depth] { return depth; }};
  view.colour.image = DeferredImage::of(colour);
  return visual_frame(view).grey;
}

TEST(View, turns_colour_into_grey_as_the_eye_weighs_it) {
  EXPECT_EQ(grey_of({255, 0, 0, 0, 255, 0, 255, 255, 255}),
            (std::vector<std::uint8_t>{76, 150, 255}));
}

TEST(View, opens_the_exposure_in_the_shade_and_no_farther_than_four_times) {
  EXPECT_EQ(grey_of({40, 40, 40, 60, 60, 60, 77, 77, 77}),
            (std::vector<std::uint8_t>{80, 120, 154}))
      << "a mean of 59 becomes 118";
  EXPECT_EQ(grey_of({1, 1, 1, 2, 2, 2, 3, 3, 3}), (std::vector<std::uint8_t>{4, 8, 12}));
  EXPECT_EQ(grey_of({0, 0, 0, 0, 0, 0, 240, 240, 240}), (std::vector<std::uint8_t>{0, 0, 255}))
      << "what is too bright then stays white";
  EXPECT_EQ(grey_of({0, 0, 0, 0, 0, 0, 0, 0, 0}), (std::vector<std::uint8_t>{0, 0, 0}));
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "scans/whole_view.h"

#include "wall_scan.h"
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double viewed_range_m = 7.0;

/// A camera of 90 x 59 degrees in the origin of W that looks along +x.
struct LookAhead {
  DepthImage image{};

  explicit LookAhead(float depth_m) {
    image.camera = {256, 144, 128.0, 127.5, 71.5};
    image.max_range_m = 20.0;
    image.depth_m.assign(std::size_t{256} * 144, depth_m);
  }
  [[nodiscard]] float& depth_m(int u, int v) {
    return image.depth_m[static_cast<std::size_t>(256 * v + u)];
  }
  [[nodiscard]] bool sees_through(const Aabb& cube) const {
    const RangeImage pixels{Deferred<DepthImage>::of(image), viewed_range_m};
    return WholeView{pixels, kit::looking_along_x(), viewed_range_m}.sees_through(cube);
  }
};

Aabb cube_at(const Vec3& centre_W) {
  const Vec3 half = Vec3::Constant(0.075);
  return {centre_W - half, centre_W + half};
}

TEST(WholeView, sees_through_a_cube_with_the_wall_behind_it) {
  const LookAhead wall{3.0F};
  EXPECT_TRUE(wall.sees_through(cube_at({2.0, 0.5, 0.2})));
  EXPECT_TRUE(wall.sees_through(cube_at({2.92, -2.0, 0.0})));
  EXPECT_FALSE(wall.sees_through(cube_at({2.93, -2.0, 0.0})));
  EXPECT_FALSE(wall.sees_through(cube_at({4.0, 0.0, 0.0})));
}

TEST(WholeView, sees_nothing_through_in_parts_out_of_view) {
  const LookAhead sky{std::numeric_limits<float>::infinity()};
  EXPECT_TRUE(sky.sees_through(cube_at({1.0, 0.8, 0.0})));
  EXPECT_FALSE(sky.sees_through(cube_at({1.0, 0.9, 0.0})));
  EXPECT_FALSE(sky.sees_through(cube_at({1.0, 0.0, -0.5})));
  EXPECT_FALSE(sky.sees_through(cube_at({0.1, 0.0, 0.0})));
  EXPECT_FALSE(sky.sees_through(cube_at({-1.0, 0.0, 0.0})));
}

TEST(WholeView, knows_nothing_beyond_the_range) {
  const LookAhead sky{std::numeric_limits<float>::infinity()};
  EXPECT_TRUE(sky.sees_through(cube_at({6.9, 0.0, 0.0})));
  EXPECT_FALSE(sky.sees_through(cube_at({6.95, 0.0, 0.0})));
}

TEST(WholeView, is_stopped_by_a_single_pixel_that_sees_less_or_nothing) {
  for (const float depth_m : {1.9F, 2.0F, 0.0F, std::numeric_limits<float>::quiet_NaN()}) {
    LookAhead wall{3.0F};
    wall.depth_m(128, 72) = depth_m;
    EXPECT_FALSE(wall.sees_through(cube_at({2.0, 0.0, 0.0}))) << depth_m;
    EXPECT_TRUE(wall.sees_through(cube_at({2.0, 0.5, 0.0}))) << depth_m;
  }
}

/// The wall is nearer on one side of the cube's image than the cube's far end on the other side.
TEST(WholeView, sees_through_a_cube_that_touches_a_slanting_wall) {
  LookAhead wall{3.0F};
  for (int u = 0; u < 256; ++u) {
    const double right = (u - wall.image.camera.centre_x_px) / wall.image.camera.focal_px;
    for (int v = 0; v < 144; ++v) {  // The plane x = 2 + 0.9 (to the right), and that is right * x.
      wall.depth_m(u, v) = static_cast<float>(2.0 / (1.0 - 0.9 * right));
    }
  }
  EXPECT_TRUE(wall.sees_through(cube_at({2.0 - 0.15, 0.0, 0.0})));
  EXPECT_FALSE(wall.sees_through(cube_at({2.0 - 0.13, 0.0, 0.0})));
}

}  // namespace
}  // namespace flyball

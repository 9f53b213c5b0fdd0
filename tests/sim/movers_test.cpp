// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/movers.h"

#include "flyball/sim/depth_camera.h"

#include "world/mover_view.h"
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A person's size, 1 m/s along y from 0 to 10 m and back, 20 m ahead.
Mover walker() {
  Mover mover;
  mover.size_m = {0.5, 0.5, 1.8};
  mover.from_W = {20.0, 0.0, 0.0};
  mover.to_W = {20.0, 10.0, 0.0};
  mover.speed_m_s = 1.0;
  return mover;
}

double y_at(const Mover& mover, Duration after) {
  const Aabb box = box_at(mover, MissionTime{after});
  return 0.5 * (box.min.y() + box.max.y());
}

/// Level, looking east.
Pose camera_at(const Vec3& p_W) {
  Pose X_WC = Pose::Identity();  // clang-format off
  X_WC.linear() << 0, 0, 1,
                  -1, 0, 0,
                   0, -1, 0;  // clang-format on
  X_WC.translation() = p_W;
  return X_WC;
}

TEST(Movers, go_to_and_fro_at_their_speed) {
  EXPECT_NEAR(y_at(walker(), 3s), 3.0, 1e-12);
  EXPECT_NEAR(y_at(walker(), 10s), 10.0, 1e-12);
  EXPECT_NEAR(y_at(walker(), 12s), 8.0, 1e-12);
  EXPECT_NEAR(y_at(walker(), 20s), 0.0, 1e-12);
  EXPECT_NEAR(y_at(walker(), 2005s), 5.0, 1e-9);
  Mover late = walker();
  late.ahead_m = 15.0;
  EXPECT_NEAR(y_at(late, 0s), 5.0, 1e-12);
}

TEST(Movers, stand_on_their_feet) {
  const Aabb box = box_at(walker(), MissionTime{});
  EXPECT_TRUE(box.min.isApprox(Vec3{19.75, -0.25, 0.0}));
  EXPECT_TRUE(box.max.isApprox(Vec3{20.25, 0.25, 1.8}));
  Mover post = walker();
  post.to_W = post.from_W;
  EXPECT_TRUE(box_at(post, MissionTime{7s}).min.isApprox(box.min));
}

TEST(Movers, are_as_far_as_their_nearest_face) {
  const Cylinder body{0.3, 0.1};
  const std::vector<Mover> movers{walker()};
  const auto distance = [&](const Vec3& p_W) {
    return clearance_m(movers, MissionTime{}, p_W, body, 5.0);
  };
  EXPECT_NEAR(distance({18.0, 0.0, 1.0}), 1.75 - 0.3, 1e-12);
  EXPECT_NEAR(distance({20.0, 0.0, 3.0}), 1.2 - 0.1, 1e-12);
  EXPECT_NEAR(distance({20.25 + 0.3 + 3.0, 0.0, 1.8 + 0.1 + 4.0}), 5.0, 1e-12);
  EXPECT_EQ(distance({20.4, 0.0, 1.0}), 0.0);
  EXPECT_EQ(distance({0.0, 0.0, 1.0}), 5.0);
}

TEST(Movers, are_hit_by_a_ray_where_it_enters_and_by_no_other) {
  const Aabb box{{1, -1, -1}, {3, 1, 1}};
  EXPECT_EQ(ray_enters(box, Vec3::Zero(), {1, 0, 0}), 1.0);
  EXPECT_EQ(ray_enters(box, Vec3::Zero(), {0.5, 0.1, 0}), 2.0);
  EXPECT_EQ(ray_enters(box, {2, 0, 0}, {1, 0, 0}), 0.0);
  EXPECT_EQ(ray_enters(box, Vec3::Zero(), {-1, 0, 0}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(ray_enters(box, {0, 2, 0}, {1, 0, 0}), std::numeric_limits<double>::infinity());
}

TEST(Movers, are_seen_by_the_depth_camera_where_they_are_at_that_moment) {
  World world;
  world.has_ground = false;
  world.movers = {walker()};
  DepthCameraSpec spec;
  spec.rgbd_noise = false;
  spec.max_range_m = 30.0;
  const DepthCamera camera{world, spec, 1};
  const auto depth_at = [&](MissionTime now, double y_m) {
    const DepthImage image = camera.capture(camera_at({0.0, y_m, 1.0}), now, 0);
    return static_cast<double>(
        image.depth_m[static_cast<std::size_t>(72 * image.camera.width_px + 128)]);
  };
  EXPECT_NEAR(depth_at(MissionTime{}, 0.0), 19.75, 1e-4);
  EXPECT_TRUE(std::isinf(depth_at(MissionTime{4s}, 0.0)));
  EXPECT_NEAR(depth_at(MissionTime{4s}, 4.0), 19.75, 1e-4);
}

TEST(Movers, hide_what_is_behind_them_and_not_what_is_before) {
  DepthImage image;
  image.camera = DepthCameraSpec{}.intrinsics();
  image.max_range_m = 30.0;
  image.depth_m.assign(256 * 144, 25.0F);
  const std::size_t middle = 72 * 256 + 128;
  draw({walker()}, camera_at({0.0, 0.0, 1.0}), image);
  EXPECT_NEAR(static_cast<double>(image.depth_m[middle]), 19.75, 1e-4);
  EXPECT_EQ(image.depth_m[0], 25.0F);
  image.depth_m.assign(256 * 144, 4.0F);
  draw({walker()}, camera_at({0.0, 0.0, 1.0}), image);
  EXPECT_EQ(image.depth_m[middle], 4.0F);
  // So near that its corners are beside the lens: still seen.
  draw({walker()}, camera_at({19.6, 0.0, 1.0}), image);
  EXPECT_NEAR(static_cast<double>(image.depth_m[middle]), 0.15, 1e-4);
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/sim/depth_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

// Looking along +x of W, upright.
Pose looking_east(const Vec3& p_WC) {
  Pose X_WC = Pose::Identity();
  X_WC.linear().col(0) = -Vec3::UnitY();
  X_WC.linear().col(1) = -Vec3::UnitZ();
  X_WC.linear().col(2) = Vec3::UnitX();
  X_WC.translation() = p_WC;
  return X_WC;
}

DepthCameraSpec noiseless() {
  DepthCameraSpec spec;
  spec.rgbd_noise = false;
  return spec;
}

World with_wall(double x_m) {
  World world;
  world.has_ground = false;
  world.boxes = {{{x_m, -100.0, -100.0}, {x_m + 1.0, 100.0, 100.0}}};
  return world;
}

float pixel(const DepthImage& image, int x, int y) {
  return image.depth_m[static_cast<std::size_t>(y * image.camera.width_px + x)];
}

TEST(DepthCamera, measures_along_its_axis_not_along_the_ray) {
  const DepthCamera camera{with_wall(5.0), noiseless(), 1};
  const DepthImage image = camera.capture(looking_east(Vec3::Zero()), MissionTime{}, 1);
  ASSERT_EQ(image.depth_m.size(), 256U * 144U);
  for (const float depth : image.depth_m) {
    EXPECT_NEAR(depth, 5.0F, 2e-6F);
  }
}

TEST(DepthCamera, sees_the_ground_where_the_pinhole_model_says) {
  World world;
  world.bounds_W = {{-50.0, -50.0, 0.0}, {50.0, 50.0, 5.0}};
  const DepthCamera camera{world, noiseless(), 1};
  const double height_m = 1.2;
  const DepthImage image = camera.capture(looking_east({0.0, 0.0, height_m}), MissionTime{}, 1);
  for (int y = 0; y < 144; ++y) {
    const double down = (y - image.camera.centre_y_px) / image.camera.focal_px;
    const double depth_m = down > 0.0 ? height_m / down : 1e9;
    for (int x = 0; x < 256; x += 17) {
      if (depth_m > 20.0) {
        EXPECT_EQ(pixel(image, x, y), nothing);
      } else {
        EXPECT_NEAR(pixel(image, x, y), depth_m, 1e-4 * depth_m);
      }
    }
  }
}

TEST(DepthCamera, sees_nothing_beyond_its_range) {
  const DepthCamera near{with_wall(19.9), noiseless(), 1};
  const DepthCamera far{with_wall(20.1), noiseless(), 1};
  EXPECT_EQ(pixel(near.capture(looking_east(Vec3::Zero()), MissionTime{}, 1), 3, 3), 19.9F);
  for (const float depth : far.capture(looking_east(Vec3::Zero()), MissionTime{}, 1).depth_m) {
    EXPECT_EQ(depth, nothing);
  }
}

TEST(DepthCamera, has_the_field_of_view_that_was_asked_for) {
  // A wall's edge at 45 degrees: half the field of 90.
  World world;
  world.has_ground = false;
  world.boxes = {{{4.0, 3.9, -100.0}, {4.001, 100.0, 100.0}}};  // To the left: +y.
  const DepthCamera camera{world, noiseless(), 1};
  const DepthImage image = camera.capture(looking_east(Vec3::Zero()), MissionTime{}, 1);
  EXPECT_NEAR(pixel(image, 0, 70), 4.0F, 1e-5F);
  EXPECT_EQ(pixel(image, 10, 70), nothing);
  EXPECT_EQ(pixel(image, 255, 70), nothing);
}

TEST(DepthCamera, sees_a_pillar_a_little_too_large_never_too_small) {
  World world;
  world.has_ground = false;
  world.pillars = {{{6.0, 0.0, -5.0}, 0.3, 10.0}};
  const DepthCamera camera{world, noiseless(), 1};
  const DepthImage image = camera.capture(looking_east(Vec3::Zero()), MissionTime{}, 1);
  const double focal = image.camera.focal_px;
  for (int x = 0; x < 256; ++x) {
    const double slope = (x - image.camera.centre_x_px) / focal;
    // Where the ray (1, slope) enters the circle, in depth.
    const double a = 1.0 + slope * slope;
    const double root = 36.0 - a * (36.0 - 0.09);
    if (root > 0.0) {
      const double depth_m = (6.0 - std::sqrt(root)) / a;
      EXPECT_LE(pixel(image, x, 72), depth_m + 1e-5);
      EXPECT_GT(pixel(image, x, 72), depth_m - 0.06);
    }
  }
  EXPECT_EQ(pixel(image, 100, 72), nothing);
}

TEST(DepthCamera, in_a_closed_room_has_a_return_in_every_pixel) {
  World world;
  world.has_ground = false;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-3.0, 2.9}) {
      Aabb wall{{-3.0, -3.0, -3.0}, {3.0, 3.0, 3.0}};
      wall.min[axis] = side;
      wall.max[axis] = side + 0.1;
      world.boxes.push_back(wall);
    }
  }
  const DepthCamera camera{world, noiseless(), 1};
  for (int turn = 0; turn < 8; ++turn) {
    Pose X_WC = looking_east({0.3, -0.2, 0.1});
    X_WC.linear() = Eigen::AngleAxisd{0.7 * turn, Vec3{0.1, 0.2, 1.0}.normalized()} * X_WC.linear();
    for (const float depth : camera.capture(X_WC, MissionTime{}, 1).depth_m) {
      ASSERT_LT(depth, 6.0F);
    }
  }
}

struct Noise {
  double mean_m;
  double sigma_m;
};

Noise noise_at(double wall_m, const DepthCameraSpec& spec) {
  const DepthCamera camera{with_wall(wall_m), spec, 5};
  const DepthImage image = camera.capture(looking_east(Vec3::Zero()), MissionTime{}, 9);
  double sum = 0.0;
  double squares = 0.0;
  for (const float depth : image.depth_m) {
    const double error = static_cast<double>(depth) - wall_m;
    sum += error;
    squares += error * error;
  }
  const auto n = static_cast<double>(image.depth_m.size());
  return {sum / n, std::sqrt(squares / n - sum / n * (sum / n))};
}

TEST(DepthCamera, has_the_noise_of_an_rgbd_camera) {
  // 36 864 draws: the mean is known to sigma / 192, sigma to sigma / 271; five of those.
  for (const auto& [wall_m, sigma_m] : {std::pair{4.0, 0.0117}, std::pair{10.0, 0.2377}}) {
    const Noise noise = noise_at(wall_m, DepthCameraSpec{});
    EXPECT_NEAR(noise.mean_m, 0.0, 0.026 * sigma_m);
    EXPECT_NEAR(noise.sigma_m, sigma_m, 0.019 * sigma_m);
  }
  DepthCameraSpec extra;
  extra.extra_noise_m = 0.5;
  EXPECT_NEAR(noise_at(6.5, extra).sigma_m, std::hypot(0.5, 0.0657 * 6.5 - 0.4193), 0.01);
}

TEST(DepthCamera, gives_the_same_frame_whatever_was_read_before) {
  const DepthCamera camera{with_wall(5.0), DepthCameraSpec{}, 3};
  const Pose X_WC = looking_east(Vec3::Zero());
  const DepthImage first = camera.capture(X_WC, MissionTime{}, 7);
  const DepthImage other = camera.capture(X_WC, MissionTime{}, 8);
  EXPECT_NE(first.depth_m, other.depth_m);
  EXPECT_EQ(first.depth_m, camera.capture(X_WC, MissionTime{}, 7).depth_m);
  const DepthCamera reseeded{with_wall(5.0), DepthCameraSpec{}, 4};
  EXPECT_NE(first.depth_m, reseeded.capture(X_WC, MissionTime{}, 7).depth_m);
}

TEST(DepthCamera, captures_a_frame_late_as_it_was_at_its_time) {
  const DepthCamera camera{with_wall(5.0), DepthCameraSpec{}, 3};
  Pose X_WC = looking_east(Vec3::Zero());
  const DepthImage at_once = camera.capture(X_WC, MissionTime{std::chrono::seconds{2}}, 7);
  const DepthFrame frame = camera.frame(X_WC, MissionTime{std::chrono::seconds{2}}, 7);
  EXPECT_EQ(frame.pixels, 256 * 144);
  X_WC.translation() = Vec3{1.0, 0.0, 0.0};  // Flown on.
  (void)camera.capture(X_WC, MissionTime{std::chrono::seconds{3}}, 8);
  const DepthImage& late = frame.image.value();
  EXPECT_EQ(late.depth_m, at_once.depth_m);
  EXPECT_EQ(late.captured, frame.captured);
  EXPECT_EQ(late.sequence, 7U);
}

TEST(DepthCamera, leaves_denormal_numbers_alone) {
  const DepthCamera camera{with_wall(5.0), DepthCameraSpec{}, 3};
  (void)camera.capture(looking_east(Vec3::Zero()), MissionTime{}, 1);
  volatile double smallest = std::numeric_limits<double>::min();
  volatile double half = smallest * 0.5;
  EXPECT_GT(half, 0.0);
}

TEST(DepthCamera, handles_sizes_that_are_no_multiple_of_its_tiles) {
  DepthCameraSpec spec = noiseless();
  spec.width_px = 37;
  spec.height_px = 11;
  const DepthCamera camera{with_wall(5.0), spec, 1};
  const DepthImage image = camera.capture(looking_east(Vec3::Zero()), MissionTime{}, 1);
  ASSERT_EQ(image.depth_m.size(), 37U * 11U);
  EXPECT_TRUE(std::all_of(image.depth_m.begin(), image.depth_m.end(),
                          [](float depth) { return std::abs(depth - 5.0F) < 2e-6F; }));
}

float middle(const DepthImage& image) {
  return pixel(image, image.camera.width_px / 2, image.camera.height_px / 2);
}

/// Walls 5 m ahead, 3 m to the left, 7 m behind and 2 m to the right.
World around_the_origin() {
  World world;
  world.has_ground = false;
  world.boxes = {{{5.0, -50.0, -50.0}, {6.0, 50.0, 50.0}},
                 {{-50.0, 3.0, -50.0}, {50.0, 4.0, 50.0}},
                 {{-8.0, -50.0, -50.0}, {-7.0, 50.0, 50.0}},
                 {{-50.0, -3.0, -50.0}, {50.0, -2.0, 50.0}}};
  return world;
}

TEST(DepthCamera, one_of_four_looks_to_each_side) {
  DepthCameraSpec spec = noiseless();
  spec.count = 4;
  const DepthCamera camera{around_the_origin(), spec, 1};
  const DepthFrame frame = camera.frame(looking_east(Vec3::Zero()), MissionTime{}, 9);
  EXPECT_NEAR(middle(frame.image.value()), 5.0F, 1e-4F);
  ASSERT_EQ(frame.sides.size(), 3U);
  EXPECT_NEAR(middle(frame.sides[0].image.value()), 3.0F, 1e-4F) << "left";
  EXPECT_NEAR(middle(frame.sides[1].image.value()), 7.0F, 1e-4F) << "behind";
  EXPECT_NEAR(middle(frame.sides[2].image.value()), 2.0F, 1e-4F) << "right";
}

TEST(DepthCamera, a_ring_that_looks_down_stays_upright) {
  World world;  // The ground alone.
  world.bounds_W = {{-50.0, -50.0, 0.0}, {50.0, 50.0, 5.0}};
  DepthCameraSpec spec = noiseless();
  spec.count = 6;
  spec.pitch_down_rad = 0.5;
  const DepthCamera camera{world, spec, 1};
  Pose X_WC = looking_east({0.0, 0.0, 2.0});
  X_WC.linear() *= Eigen::AngleAxisd{-spec.pitch_down_rad, Vec3::UnitX()}.toRotationMatrix();
  const DepthFrame frame = camera.frame(X_WC, MissionTime{}, 1);
  const float ahead_m = middle(frame.image.value());
  EXPECT_NEAR(ahead_m, 2.0 / std::sin(0.5), 0.05);
  for (const SideView& side : frame.sides) {
    EXPECT_NEAR(middle(side.image.value()), ahead_m, 1e-3F);
  }
}

TEST(DepthCamera, each_camera_of_a_ring_has_its_own_noise) {
  DepthCameraSpec spec;
  spec.extra_noise_m = 0.1;
  spec.count = 2;
  World world = with_wall(5.0);
  world.boxes.push_back({{-6.0, -100.0, -100.0}, {-5.0, 100.0, 100.0}});
  const DepthCamera camera{world, spec, 1};
  const DepthFrame frame = camera.frame(looking_east(Vec3::Zero()), MissionTime{}, 3);
  EXPECT_NE(frame.image.value().depth_m, frame.sides[0].image.value().depth_m);
}

}  // namespace
}  // namespace flyball

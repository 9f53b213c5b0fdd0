// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/point_cloud.h"

#include "flyball/kernels/kernels.h"
#include "flyball/kernels/pixel_point.h"
#include "flyball/runtime/registry.h"

#include <limits>
#include <memory>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::unique_ptr<PointCloudBuilder> make_builder() {
  Registry registry;
  register_kernels(registry);
  return registry.make<PointCloudBuilder>("depth_to_points");
}

DepthImage image_of(float depth_m) {
  DepthImage image;
  image.captured = MissionTime{std::chrono::seconds{3}};
  image.sequence = 17;
  image.camera = {9, 5, 4.0, 4.0, 2.0};
  image.max_range_m = 20.0;
  image.depth_m.assign(45, depth_m);
  return image;
}

PointCloud points_of(const DepthImage& image, double range_m, Work& work) {
  const DepthFrame frame{image.captured, image.sequence,
                         image.camera.width_px * image.camera.height_px,
                         Deferred<DepthImage>::of(image)};
  return make_builder()->build(frame, range_m, work).cloud_C.value();
}

TEST(DepthToPoints, makes_the_point_of_each_pixel_to_the_bit) {
  DepthImage image = image_of(1.0F);
  for (std::size_t pixel = 0; pixel < image.depth_m.size(); ++pixel) {
    image.depth_m[pixel] = 0.37F * static_cast<float>(pixel) - 1.0F;  // also behind the camera
  }
  constexpr double reach_m = 9.0;
  std::vector<Eigen::Vector3f> hits_C;
  std::vector<Eigen::Vector3f> clear_C;
  for (int pixel = 0; pixel < 45; ++pixel) {
    const double x = (pixel % 9 - image.camera.centre_x_px) / image.camera.focal_px;
    const double y = (pixel / 9 - image.camera.centre_y_px) / image.camera.focal_px;
    const float depth_m = image.depth_m[static_cast<std::size_t>(pixel)];
    if (const auto point = point_of_pixel(x, y, static_cast<double>(depth_m), reach_m)) {
      (point->is_hit ? hits_C : clear_C).push_back(point->p_C);
    }
  }
  DepthFrame frame;
  frame.image = Deferred<DepthImage>::of(image);
  Work work;
  const PointCloudFrame made = make_builder()->build(frame, reach_m, work);
  EXPECT_EQ(made.cloud_C.value().hits_C, hits_C);
  EXPECT_EQ(made.cloud_C.value().clear_C, clear_C);
  EXPECT_GT(hits_C.size(), 5U);
  EXPECT_GT(clear_C.size(), 5U);
  ASSERT_TRUE(made.pixels);
  EXPECT_EQ(made.pixels->reach_m, reach_m);
}

TEST(DepthToPoints, puts_each_pixel_on_its_ray_at_its_depth) {
  Work work;
  const PointCloud cloud = points_of(image_of(2.0F), 10.0, work);
  ASSERT_EQ(cloud.hits_C.size(), 45U);
  EXPECT_TRUE(cloud.clear_C.empty());
  EXPECT_EQ(cloud.captured, MissionTime{std::chrono::seconds{3}});
  EXPECT_EQ(cloud.sequence, 17U);
  EXPECT_EQ(work.count("pixels"), 45);
  EXPECT_TRUE(cloud.hits_C[2 * 9 + 4].isApprox(Eigen::Vector3f{0, 0, 2}));
  EXPECT_TRUE(cloud.hits_C[2 * 9 + 8].isApprox(Eigen::Vector3f{2, 0, 2}));  // right: x
  EXPECT_TRUE(cloud.hits_C[4 * 9 + 4].isApprox(Eigen::Vector3f{0, 1, 2}));  // down: y
  EXPECT_TRUE(cloud.hits_C[0].isApprox(Eigen::Vector3f{-2, -1, 2}));
}

TEST(DepthToPoints, measures_the_range_along_the_ray_not_along_the_axis) {
  Work work;
  // The centre is 2 m away; the outermost columns are 2 sqrt(2) = 2.83 m away, and more.
  const PointCloud cloud = points_of(image_of(2.0F), 2.8, work);
  EXPECT_EQ(cloud.clear_C.size(), 2U * 5U);
  EXPECT_EQ(cloud.hits_C.size(), 35U);
  for (const auto& p_C : cloud.clear_C) {
    EXPECT_NEAR(p_C.norm(), 2.8 * 1.001, 1e-5);
  }
}

TEST(DepthToPoints, turns_a_pixel_without_return_into_a_clear_ray) {
  DepthImage image = image_of(3.0F);
  image.depth_m[2 * 9 + 4] = infinity;
  Work work;
  const PointCloud cloud = points_of(image, 7.0, work);
  ASSERT_EQ(cloud.clear_C.size(), 1U);
  EXPECT_TRUE(cloud.clear_C[0].isApprox(Eigen::Vector3f{0, 0, 7.007F}));
}

TEST(DepthToPoints, clears_no_farther_than_the_sensor_sees) {
  DepthImage image = image_of(infinity);
  image.max_range_m = 4.0;
  Work work;
  for (const auto& p_C : points_of(image, 7.0, work).clear_C) {
    EXPECT_NEAR(p_C.norm(), 4.004, 1e-5);
  }
}

TEST(DepthToPoints, drops_broken_pixels_so_that_they_clear_nothing) {
  DepthImage image = image_of(2.0F);
  image.depth_m[0] = std::numeric_limits<float>::quiet_NaN();
  image.depth_m[1] = 0.0F;
  image.depth_m[2] = -1.0F;
  image.depth_m[3] = -infinity;
  Work work;
  const PointCloud cloud = points_of(image, 7.0, work);
  EXPECT_EQ(cloud.hits_C.size(), 41U);
  EXPECT_TRUE(cloud.clear_C.empty());
}

TEST(DepthToPoints, knows_its_work_before_the_frame_is_rendered) {
  int rendered = 0;
  const DepthFrame frame{MissionTime{std::chrono::seconds{3}}, 17, 45, Deferred<DepthImage>{[&] {
                           ++rendered;
                           return image_of(2.0F);
                         }}};
  Work work;
  const PointCloudFrame cloud = make_builder()->build(frame, 10.0, work);
  EXPECT_EQ(work.count("pixels"), 45);
  EXPECT_EQ(cloud.captured, frame.captured);
  EXPECT_EQ(cloud.sequence, 17U);
  EXPECT_EQ(rendered, 0);
  EXPECT_EQ(cloud.cloud_C.value().hits_C.size(), 45U);
  EXPECT_EQ(rendered, 1);
}

TEST(DepthToPoints, puts_what_another_camera_saw_where_it_looked) {
  SideView left;
  left.R_CS = Eigen::AngleAxisd{-1.5707963267948966, Vec3::UnitY()}.toRotationMatrix();
  left.image = Deferred<DepthImage>::of(image_of(2.0F));
  const DepthImage ahead = image_of(infinity);
  DepthFrame frame{ahead.captured, ahead.sequence, 45, Deferred<DepthImage>::of(ahead)};
  frame.sides = {left};
  Work work;
  const PointCloud cloud = make_builder()->build(frame, 10.0, work).cloud_C.value();
  EXPECT_EQ(work.count("pixels"), 90.0);
  EXPECT_EQ(cloud.clear_C.size(), 45U);
  ASSERT_EQ(cloud.hits_C.size(), 45U);
  for (const Eigen::Vector3f& p : cloud.hits_C) {
    EXPECT_NEAR(p.x(), -2.0F, 1e-5F);  // x of C points to the right.
  }
  EXPECT_FALSE(cloud.camera) << "no longer one image";
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "visual/undistortion.h"

#include "flyball/kernels/kernels.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/registry.h"

#include "bent_camera.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

// EuRoC's first camera, and a lens of 100 degrees as TUM's visual-inertial recordings have it.
const CameraModel radial{752,
                         480,
                         458.654,
                         457.296,
                         367.215,
                         248.375,
                         {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}};
const CameraModel fisheye{512,
                          512,
                          190.98,
                          190.97,
                          254.93,
                          256.90,
                          {0.0034823894, 0.0007150348, -0.0020532361, 0.00020293673},
                          DistortionModel::equidistant};

std::vector<Eigen::Vector2d> directions() {
  std::vector<Eigen::Vector2d> rays;
  for (const double radius : {0.0, 0.2, 0.5, 0.8}) {
    for (const double angle : {0.3, 1.4, 2.9, 4.4, 5.8}) {
      rays.push_back(radius * Eigen::Vector2d{std::cos(angle), std::sin(angle)});
    }
  }
  return rays;
}

TEST(Undistortion, finds_the_direction_that_the_formula_bent) {
  for (const CameraModel& camera : {radial, fisheye}) {
    for (const Eigen::Vector2d& ray : directions()) {
      const Eigen::Vector2d pixel = kit::bent_pixel(camera, ray);
      const auto found = straight_rays(camera, {pixel.cast<float>()});
      ASSERT_TRUE(found.front());
      EXPECT_NEAR(static_cast<double>(found.front()->x()), ray.x(), 2e-3);
      EXPECT_NEAR(static_cast<double>(found.front()->y()), ray.y(), 2e-3);
    }
  }
}

TEST(Undistortion, leaves_pixels_of_a_straight_lens_where_they_are) {
  CameraModel straight = radial;
  straight.distortion = {};
  EXPECT_FALSE(is_distorted(straight));
  const Eigen::Vector2f pixel{17.25F, 200.75F};
  EXPECT_EQ(*straightened(straight, {pixel}).front(), pixel);
  EXPECT_TRUE(is_distorted(fisheye));
  CameraModel ideal = fisheye;
  ideal.distortion = {};
  EXPECT_TRUE(is_distorted(ideal)) << "the angle itself is bent";
}

TEST(Undistortion, has_no_answer_where_the_lens_has_none) {
  // 1.5 rad from the axis; and radii to which this formula never bends anything.
  EXPECT_FALSE(straight_rays(fisheye, {Eigen::Vector2f{254.93F + 286.0F, 256.9F}}).front());
  EXPECT_FALSE(straight_rays(radial, {Eigen::Vector2f{2000.0F, 248.0F}}).front());
}

/// Error after 2 m of the circle, seen through a lens that the localizer is told to be `told`.
double miss_m(const CameraModel& lens, const CameraModel& told) {
  Registry registry;
  register_kernels(registry);
  const auto slam = registry.make<Localizer>("visual_slam");
  slam->start({});
  slam->set_initial_pose(kit::circle_pose(0.0));
  const kit::BentCamera camera{kit::circle_world(1), lens, 1};
  Work work;
  double worst_m = 0.0;
  for (int i = 0; i < 10; ++i) {
    const Pose X_WC = kit::circle_pose(0.2 * i);
    VisualFrame frame =
        camera.capture(X_WC, MissionTime{from_seconds(0.1 * i)}, static_cast<std::uint64_t>(i));
    frame.camera = told;
    const auto fix = slam->track_frame(frame, work);
    worst_m = std::max(worst_m, fix && fix->tracked
                                    ? (fix->X_WB.translation() - X_WC.translation()).norm()
                                    : 10.0);
  }
  return worst_m;
}

TEST(Undistortion, lets_a_localizer_see_through_bent_lenses) {
  const CameraModel small_fisheye{
      224, 224, 84.0, 84.0, 111.5, 111.5, fisheye.distortion, DistortionModel::equidistant};
  const CameraModel small_radial{224, 168, 112.0, 112.0, 111.5, 83.5, radial.distortion};
  for (const CameraModel& lens : {small_fisheye, small_radial}) {
    CameraModel straight = lens;
    straight.distortion = {};
    straight.distortion_model = DistortionModel::radial_tangential;
    EXPECT_LT(miss_m(lens, lens), 0.08);
    EXPECT_GT(miss_m(lens, straight), 0.12) << "the lens would not matter";
  }
}

}  // namespace
}  // namespace flyball

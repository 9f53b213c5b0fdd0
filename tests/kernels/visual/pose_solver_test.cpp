// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "visual/pose_solver.h"

#include "flyball/runtime/random.h"

#include "visual/feature.h"
#include "visual/motion.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

const CameraModel camera{320, 240, 160.0, 160.0, 159.5, 119.5, {}};

Pose somewhere() {
  Pose X_WC = Pose::Identity();
  X_WC.linear() = rotation_of({0.3, -0.8, 0.2});
  X_WC.translation() = Vec3{4.0, -2.0, 1.5};
  return X_WC;
}

/// Landmarks in view, seen with noise of so many pixels.
std::vector<LandmarkSighting> sightings(int count, double sigma_px, std::uint64_t seed) {
  RandomStream random{seed, "sightings"};
  std::vector<LandmarkSighting> all;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d pixel{random.uniform(5.0, 315.0), random.uniform(5.0, 235.0)};
    const double depth_m = random.uniform(2.0, 12.0);
    LandmarkSighting seen;
    seen.p_W = somewhere() * back_projected(camera, pixel, depth_m);
    seen.covariance_W = 1e-4 * Eigen::Matrix3d::Identity();
    seen.pixel = pixel + sigma_px * Eigen::Vector2d{random.normal(), random.normal()};
    seen.sigma_px = std::max(sigma_px, 0.1);
    all.push_back(seen);
  }
  return all;
}

TEST(PoseSolver, finds_the_pose_from_anywhere) {
  Work work;
  const auto solved = solve_pose(sightings(60, 0.0, 1), camera, 15, work);
  ASSERT_TRUE(solved);
  EXPECT_LT((solved->X_WC.translation() - somewhere().translation()).norm(), 1e-3);
  EXPECT_LT(rotation_vector(solved->X_WC.linear().transpose() * somewhere().linear()).norm(), 1e-4);
  EXPECT_EQ(solved->inliers, 60);
  EXPECT_EQ(work.count("ransac_iterations"), 1.0) << "every sample was good";
}

TEST(PoseSolver, leaves_out_what_was_taken_for_something_else) {
  auto seen = sightings(60, 0.5, 2);
  for (std::size_t i = 0; i < 25; ++i) {
    seen[i].pixel = Eigen::Vector2d{320.0, 240.0} - seen[i].pixel;
  }
  Work work;
  const auto solved = solve_pose(seen, camera, 15, work);
  ASSERT_TRUE(solved);
  EXPECT_LT((solved->X_WC.translation() - somewhere().translation()).norm(), 0.05);
  EXPECT_GE(solved->inliers, 30);
  EXPECT_LE(solved->inliers, 38) << "a mirrored pixel agrees only by chance";
  EXPECT_GT(work.count("ransac_iterations"), 10.0);
}

// OpenCV then draws all the samples that it may.
TEST(PoseSolver, that_found_no_pose_counts_all_samples) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    auto seen = sightings(15, 0.0, 3);
    RandomStream random{seed, "pixels"};
    for (LandmarkSighting& one : seen) {
      one.pixel = {random.uniform(0.0, 320.0), random.uniform(0.0, 240.0)};
    }
    Work work;
    EXPECT_FALSE(solve_pose(seen, camera, 15, work));
    EXPECT_GE(work.count("ransac_iterations"), 100.0) << seed;
  }
}

TEST(PoseSolver, gives_no_pose_when_nothing_agrees) {
  auto seen = sightings(60, 0.0, 3);
  RandomStream random{9, "pixels"};
  for (LandmarkSighting& one : seen) {
    one.pixel = {random.uniform(0.0, 320.0), random.uniform(0.0, 240.0)};
  }
  Work work;
  EXPECT_FALSE(solve_pose(seen, camera, 15, work));
  EXPECT_FALSE(solve_pose(sightings(10, 0.0, 3), camera, 15, work)) << "too few";
}

// Landmarks whose depth is wrong by a metre say nothing about where the camera is, if they admit
// it.
TEST(PoseSolver, trusts_a_landmark_as_far_as_it_is_known) {
  auto honest = sightings(80, 0.2, 4);
  RandomStream random{5, "depth"};
  for (std::size_t i = 0; i < 60; ++i) {
    const Vec3 ray_W = (honest[i].p_W - somewhere().translation()).normalized();
    honest[i].p_W += random.normal() * ray_W;
    honest[i].covariance_W += 1.0 * ray_W * ray_W.transpose();
  }
  auto vain = honest;
  for (LandmarkSighting& one : vain) {
    one.covariance_W = 1e-4 * Eigen::Matrix3d::Identity();
  }
  // Seen from half a metre beside: from the same place, wrong depths do not show.
  Pose X_WC = somewhere();
  X_WC.translation() += X_WC.linear() * Vec3{0.5, 0.0, 0.0};
  const auto error_m = [&](std::vector<LandmarkSighting>& seen) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Vec3 real_W = sightings(80, 0.0, 4)[i].p_W;
      seen[i].pixel = project(camera, X_WC.inverse() * real_W).pixel;
    }
    return (refine(seen, camera, somewhere()).X_WC.translation() - X_WC.translation()).norm();
  };
  const double honest_m = error_m(honest);
  EXPECT_LT(honest_m, 0.03);
  EXPECT_LT(honest_m, error_m(vain));
}

TEST(PoseSolver, uses_measured_depth_where_pixels_say_little) {
  auto far = sightings(40, 0.3, 6);
  for (LandmarkSighting& one : far) {
    one.p_W =
        somewhere() *
        back_projected(camera, {160.0 + one.pixel.x() / 40.0, 120.0 + one.pixel.y() / 40.0}, 8.0);
    one.pixel = project(camera, somewhere().inverse() * one.p_W).pixel;
  }
  auto measured = far;
  for (LandmarkSighting& one : measured) {
    one.depth_m = 8.0;
  }
  Pose guess = somewhere();
  guess.translation() += guess.linear() * Vec3{0.0, 0.0, 0.4};
  const Vec3 truth_W = somewhere().translation();
  EXPECT_LT((refine(measured, camera, guess).X_WC.translation() - truth_W).norm(), 0.02);
}

TEST(Projection, is_undone_by_its_depth_and_has_the_slope_it_says) {
  const Vec3 p_C{0.7, -0.4, 3.0};
  const Projection at = project(camera, p_C);
  EXPECT_LT((back_projected(camera, at.pixel, 3.0) - p_C).norm(), 1e-12);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = 1e-6 * Vec3::Unit(axis);
    const Eigen::Vector2d slope =
        (project(camera, p_C + step).pixel - project(camera, p_C - step).pixel) / 2e-6;
    EXPECT_LT((slope - at.by_p_C.col(axis)).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The simplest scan there is, for tests of mappers, and what every mapper must refuse.

#include "flyball/kernels/mapper.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball::kit {

/// A camera at the origin that looks along +x and sees a wall, 2 m wide and high, `distance_m`
/// away.
inline PointCloud wall_scan(float distance_m) {
  PointCloud cloud_C;
  for (int i = 0; i < 81 * 81; ++i) {
    const float right = 0.025F * static_cast<float>(i % 81 - 40);
    const float down = 0.025F * static_cast<float>(i / 81 - 40);
    cloud_C.hits_C.emplace_back(right, down, distance_m);
  }
  return cloud_C;
}

inline Pose looking_along_x() {
  Pose X_WC = Pose::Identity();
  X_WC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return X_WC;
}

inline void insert(Mapper& mapper, const PointCloud& cloud_C, const MapperSettings& settings) {
  const auto work = mapper.prepare(cloud_C, looking_along_x(), settings);
  ASSERT_TRUE(work.ok()) << work.error().message;
  mapper.commit();
}

inline void expect_image_without_all_depths_refused(Mapper& mapper) {
  DepthImage image;
  image.camera = {640, 480, 320.0, 319.5, 239.5};
  image.depth_m.assign(1000, 3.0F);
  PointCloudFrame frame;
  frame.pixels = RangeImage{Deferred<DepthImage>::of(image), 7.0};
  const auto work = mapper.prepare_frame(frame, looking_along_x(), {0.15, 7.0});
  ASSERT_FALSE(work);
  EXPECT_EQ(work.error().message, "a depth image of 640 x 480 pixels has 1000 depths");
  mapper.commit();
  EXPECT_TRUE(mapper.occupied().empty());
}

/// Also drops what was prepared before the input that is refused.
inline void expect_bad_input_refused(Mapper& mapper) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const PointCloud wall = wall_scan(3.0F);
  PointCloud broken = wall;
  broken.hits_C[5].y() = nan;
  PointCloud broken_clear;
  broken_clear.clear_C = {{nan, 0.0F, 0.0F}};
  const Pose X_WC = looking_along_x();
  Pose far = X_WC;
  far.translation().x() = 1e5;
  Pose broken_pose = X_WC;
  broken_pose.translation().z() = nan;
  ASSERT_TRUE(mapper.prepare(wall, X_WC, {0.15, 7.0}).ok());
  const struct {
    const PointCloud& cloud_C;
    const Pose& X_WC;
    MapperSettings settings;
  } refused[] = {
      {broken, X_WC, {0.15, 7.0}}, {broken_clear, X_WC, {0.15, 7.0}},
      {wall, far, {0.15, 7.0}},    {wall, broken_pose, {0.15, 7.0}},
      {wall, X_WC, {0.0, 7.0}},    {wall, X_WC, {0.15, -7.0}},
      {wall, X_WC, {nan, 7.0}},    {wall, X_WC, {0.001, 7.0}},
  };
  for (const auto& input : refused) {
    const auto work = mapper.prepare(input.cloud_C, input.X_WC, input.settings);
    ASSERT_FALSE(work) << "input " << &input - refused;
    EXPECT_EQ(work.error().code, ErrorCode::invalid_input) << work.error().message;
  }
  mapper.commit();
  EXPECT_EQ(mapper.view().state({1.5, 0.0, 0.0}), CellState::unknown);
}

}  // namespace flyball::kit

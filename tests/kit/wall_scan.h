// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The simplest scan there is, for tests of mappers.

#include "flyball/kernels/mapper.h"

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

}  // namespace flyball::kit

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/flight_settings.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(FlightSettings, price_a_map_as_its_mapper_unless_another_kernel_is_named) {
  KernelSettings kernels;
  kernels.mapper = "flyball";
  EXPECT_EQ(mapper_cost(kernels), "flyball");
  kernels.mapper_parameters["cost_of"] = std::string{"octomap"};
  EXPECT_EQ(mapper_cost(kernels), "octomap");
}

TEST(FlightSettings, price_a_detection_as_its_detector_unless_another_kernel_is_named) {
  FlightSettings settings;
  settings.kernels.detector = "haar";
  EXPECT_EQ(detector_cost(settings), "haar");
  settings.detector.cost_of = "hog";
  EXPECT_EQ(detector_cost(settings), "hog");
}

TEST(FlightSettings, have_the_guard_of_their_deceleration_and_brake_lag) {
  FlightSettings settings;
  settings.mission.max_acceleration_m_s2 = 3.5;
  settings.brake_lag = std::chrono::milliseconds{300};
  const GuardSettings guard = guard_settings(settings);
  EXPECT_EQ(guard.max_deceleration_m_s2, 3.5);
  EXPECT_EQ(guard.brake_lag, settings.brake_lag);
  EXPECT_EQ(guard_settings(FlightSettings{}).brake_lag, GuardSettings{}.brake_lag);
}

}  // namespace
}  // namespace flyball

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

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/operating_points.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

KnobSettings knobs() {
  KnobSpec resolution;
  resolution.name = "map.resolution_m";
  resolution.min = 0.1;
  resolution.max = 2.0;
  resolution.fallback = 0.15;
  KnobSpec clock;
  clock.name = "cpu.frequency_hz";
  clock.legal = {1e9, 2e9};
  clock.fallback = 2e9;
  return KnobSettings{{resolution, clock}};
}

OperatingPoints six() {
  return *OperatingPoints::lattice(
      {{"map.resolution_m", {0.15, 0.3, 0.6}}, {"cpu.frequency_hz", {1e9, 2e9}}}, knobs());
}

TEST(OperatingPoints, are_all_combinations_the_last_axis_fastest) {
  const OperatingPoints points = six();
  ASSERT_EQ(points.size(), 6U);
  EXPECT_EQ(points.values(0)[0], 0.15);
  EXPECT_EQ(points.values(0)[1], 1e9);
  EXPECT_EQ(points.values(1)[0], 0.15);
  EXPECT_EQ(points.values(1)[1], 2e9);
  EXPECT_EQ(points.values(5)[0], 0.6);
  EXPECT_EQ(points.values(5)[1], 2e9);
}

TEST(OperatingPoints, refuse_what_no_knob_can_be) {
  EXPECT_FALSE(OperatingPoints::lattice({}, knobs()).ok());
  EXPECT_FALSE(OperatingPoints::lattice({{"map.resolution_m", {}}}, knobs()).ok());
  EXPECT_FALSE(OperatingPoints::lattice({{"warp.factor", {1.0}}}, knobs()).ok());
  const auto wrong = OperatingPoints::lattice({{"cpu.frequency_hz", {1.4e9}}}, knobs());
  ASSERT_FALSE(wrong.ok());
  EXPECT_NE(wrong.error().message.find("1000000000"), std::string::npos);
  EXPECT_FALSE(OperatingPoints::lattice({{"map.resolution_m", {0.15, 0.3}}}, knobs(), 1).ok());
}

}  // namespace
}  // namespace flyball

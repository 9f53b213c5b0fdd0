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

TEST(OperatingPoints, keep_only_what_is_not_dominated) {
  OperatingPoints points = six();
  // The slow clock costs less and computes as fast as the other: the fast one has no reason.
  points.prune(2, [](const double* values, std::vector<double>& costs) {
    costs[0] = values[0];
    costs[1] = values[1];
  });
  ASSERT_EQ(points.size(), 1U);  // finest and slowest is best by both
  EXPECT_EQ(points.values(0)[0], 0.15);
  EXPECT_EQ(points.values(0)[1], 1e9);
}

TEST(OperatingPoints, keep_what_trades_one_criterion_for_another) {
  OperatingPoints points = six();
  points.prune(3, [](const double* values, std::vector<double>& costs) {
    costs[0] = values[0];                                  // coarser sees less
    costs[1] = 1.0 / (values[0] * values[0] * values[1]);  // time
    costs[2] = values[1];                                  // power
  });
  EXPECT_EQ(points.size(), 6U);
}

TEST(OperatingPoints, of_equal_points_the_first_stays) {
  OperatingPoints points = six();
  points.prune(1, [](const double* /*values*/, std::vector<double>& costs) { costs[0] = 1.0; });
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points.values(0)[0], 0.15);
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

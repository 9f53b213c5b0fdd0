// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/known_path.h"

#include "grid_map.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

const std::vector<Vec3> right_turn_W{{0, 0, 1}, {10, 0, 1}, {10, -5, 1}};

TEST(KnownPath, is_a_detour_by_what_it_is_longer_than_the_line) {
  EXPECT_NEAR(detour_m(right_turn_W), 15.0 - std::sqrt(125.0), 1e-12);
  EXPECT_EQ(detour_m({{1, 2, 3}}), 0.0);
}

constexpr Cylinder body{0.3, 0.2};

kit::GridMap open_ground() {
  return {{Vec3{-2, -8, 0}, Vec3{14, 4, 2}}, 0.15, CellState::free};
}

TEST(KnownPath, begins_where_the_vehicle_is_by_now) {
  const auto joined = joined_to(Vec3{4, 1, 1}, {right_turn_W, body}, open_ground());
  const std::vector<Vec3> expected{{4, 1, 1}, {10, 0, 1}, {10, -5, 1}};
  EXPECT_EQ(joined, expected);
}

TEST(KnownPath, leaves_out_a_corner_that_the_vehicle_has_passed) {
  const auto joined = joined_to(Vec3{12, -1, 1}, {right_turn_W, body}, open_ground());
  const std::vector<Vec3> expected{{12, -1, 1}, {10, -5, 1}};
  EXPECT_EQ(joined, expected);
}

TEST(KnownPath, goes_back_to_a_corner_that_something_stands_behind) {
  kit::GridMap map = open_ground();
  map.fill({Vec3{10.6, -4, 0}, Vec3{11.4, -2, 2}}, CellState::occupied);
  const auto joined = joined_to(Vec3{12, -1, 1}, {right_turn_W, body}, map);
  const std::vector<Vec3> expected{{12, -1, 1}, {10, 0, 1}, {10, -5, 1}};
  EXPECT_EQ(joined, expected);
}

TEST(KnownPath, turns_back_where_it_begins_against_the_flight) {
  EXPECT_FALSE(turns_back(right_turn_W, Vec3::UnitX()));
  EXPECT_TRUE(turns_back(right_turn_W, Vec3{-1, 3, 0}));
  EXPECT_FALSE(turns_back(right_turn_W, Vec3::Zero())) << "from a standstill";
}

TEST(KnownPath, keeps_its_end) {
  const KnownPath straight{{{0, 0, 1}, {10, 0, 1}}, body};
  const std::vector<Vec3> expected{{12, 0, 1}, {10, 0, 1}};
  EXPECT_EQ(joined_to(Vec3{12, 0, 1}, straight, open_ground()), expected);
}

}  // namespace
}  // namespace flyball

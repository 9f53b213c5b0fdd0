// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/second_look.h"

#include "grid_map.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

const Cylinder body{0.35, 0.1};
const Aabb room_W{{0.5, 0.5, 0.0}, {9.5, 9.5, 3.0}};
const Vec3 from_W{3, 5, 1};

class SecondLook : public testing::Test {
 protected:
  [[nodiscard]] Viewpoint at(const Vec3& place_W, double apart_m = 0.25) const {
    return second_look(map, body, room_W, {place_W, from_W}, apart_m).value_or(Viewpoint{});
  }
  kit::GridMap map{{{0, 0, 0}, {10, 10, 3}}, 0.1};
};

TEST_F(SecondLook, goes_nearer_to_somebody_far_off_and_keeps_its_height) {
  const Viewpoint view = at({8, 5, 0.3});
  EXPECT_NEAR((view.p_W - Vec3(3.75, 5, 1)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(view.yaw_rad, 0.0, 1e-9);
}

TEST_F(SecondLook, goes_aside_from_somebody_near_by_and_faces_them) {
  const Viewpoint view = at({5, 5, 1});
  EXPECT_NEAR((view.p_W - Vec3(3, 5.75, 1)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(view.yaw_rad, std::atan2(-0.75, 2.0), 1e-9);
}

TEST_F(SecondLook, takes_the_next_side_where_one_is_blocked) {
  map.fill({{2.5, 5.9, 0}, {5, 6.5, 3}}, CellState::occupied);
  EXPECT_NEAR((at({5, 5, 1}).p_W - Vec3(3, 4.25, 1)).norm(), 0.0, 1e-9);
  map.fill({{2.5, 3.5, 0}, {5, 4.1, 3}}, CellState::occupied);
  EXPECT_NEAR((at({5, 5, 1}).p_W - Vec3(2.25, 5, 1)).norm(), 0.0, 1e-9);
}

TEST_F(SecondLook, goes_as_far_as_another_sighting_must_be_away) {
  EXPECT_NEAR((at({8, 5, 0.3}, 1.5).p_W - Vec3(5, 5, 1)).norm(), 0.0, 1e-9);
}

TEST_F(SecondLook, is_none_where_there_is_no_way) {
  const Aabb nowhere_W{from_W, from_W};
  EXPECT_FALSE(second_look(map, body, nowhere_W, {{3, 9, 1}, from_W}, 0.25));
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/exploration/known_share.h"

#include "grid_map.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

const Aabb volume{Vec3{0, 0, 0}, Vec3{4.0, 2.0, 1.0}};

/// Unknown everywhere but where a test says something else.
kit::GridMap unknown_map() {
  return kit::GridMap{volume, 0.1, CellState::unknown};
}

TEST(KnownShare, is_zero_while_nothing_is_known) {
  KnownShare share{volume, 0.1};
  EXPECT_EQ(share.percent(unknown_map()), 0.0);
}

TEST(KnownShare, counts_what_can_still_be_reached_through_unknown_space) {
  kit::GridMap map = unknown_map();
  map.fill({Vec3{0, 0, 0}, Vec3{1.0, 2.0, 1.0}}, CellState::free);
  KnownShare share{volume, 0.1};
  EXPECT_NEAR(share.percent(map), 25.0, 1e-9);
  EXPECT_NEAR(share.known_m3(), 2.0, 1e-9);
}

TEST(KnownArea, counts_the_squares_that_are_known_at_a_height) {
  kit::GridMap map = unknown_map();
  EXPECT_EQ(known_area_m2(map, volume, 0.45, 0.2), 0.0);
  map.fill({Vec3{0, 0, 0}, Vec3{1.0, 2.0, 0.5}}, CellState::free);
  map.fill({Vec3{1.0, 0, 0}, Vec3{1.2, 2.0, 1.0}}, CellState::occupied);
  EXPECT_NEAR(known_area_m2(map, volume, 0.45, 0.2), 2.4, 1e-9);
  EXPECT_NEAR(known_area_m2(map, volume, 0.75, 0.2), 0.4, 1e-9) << "above what is free";
}

TEST(KnownShare, forgets_what_is_enclosed_by_known_surfaces) {
  kit::GridMap map = unknown_map();
  map.fill({Vec3{0, 0, 0}, Vec3{1.9, 2.0, 1.0}}, CellState::free);
  map.fill({Vec3{1.9, 0, 0}, Vec3{2.0, 2.0, 1.0}}, CellState::occupied);  // A wall.
  KnownShare share{volume, 0.1};
  EXPECT_NEAR(share.percent(map), 100.0, 1e-9);
}

TEST(KnownShare, sees_a_room_behind_an_open_door) {
  kit::GridMap map = unknown_map();
  map.fill({Vec3{0, 0, 0}, Vec3{1.9, 2.0, 1.0}}, CellState::free);
  map.fill({Vec3{1.9, 0, 0}, Vec3{2.0, 2.0, 1.0}}, CellState::occupied);
  map.fill({Vec3{1.9, 0.9, 0}, Vec3{2.0, 1.1, 1.0}}, CellState::free);
  KnownShare share{volume, 0.1};
  EXPECT_NEAR(share.percent(map), 50.0, 1.0);
}

TEST(KnownShare, is_zero_while_only_a_floor_is_known) {
  kit::GridMap map = unknown_map();
  map.fill({Vec3{0, 0, 0}, Vec3{1.0, 1.0, 0.1}}, CellState::occupied);
  KnownShare share{volume, 0.1};
  EXPECT_EQ(share.percent(map), 0.0);
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/observable_space.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double cell_m = 0.3;

/// A room of 4 x 3 x 2.4 m, and beside it one of the same size, without a door between them.
World two_closed_rooms() {
  World world;
  world.volume_W = {{0, 0, 0}, {8.3, 3, 2.4}};
  world.bounds_W = {{0, 0, 0.5}, {8.3, 3, 1.9}};
  world.start_W = {2.0, 1.5, 0.0};
  world.boxes = {{{-0.3, -0.3, 0}, {0, 3.3, 2.7}},     {{8.3, -0.3, 0}, {8.6, 3.3, 2.7}},
                 {{-0.3, -0.3, 0}, {8.6, 0, 2.7}},     {{-0.3, 3, 0}, {8.6, 3.3, 2.7}},
                 {{-0.3, -0.3, 2.4}, {8.6, 3.3, 2.7}}, {{4, 0, 0}, {4.3, 3, 2.4}}};
  return world;
}

ObservableRequest request_in(const World& world) {
  ObservableRequest request;
  request.body = {0.325, 0.125};
  request.start_W = world.start_W + Vec3{0.0, 0.0, 1.2};
  request.cell_m = cell_m;
  return request;
}

bool has(const std::vector<GridCell>& cells, const Vec3& p_W) {
  return std::find(cells.begin(), cells.end(), grid_cell_of(p_W, cell_m)) != cells.end();
}

TEST(ObservableSpace, is_the_room_with_its_walls_and_nothing_behind_them) {
  const World world = two_closed_rooms();
  const ObservableSpace space = observable_space(world, request_in(world));
  const double room_m3 = 4.0 * 3.0 * 2.4;
  const double seen_m3 = static_cast<double>(space.cells.size()) * cell_m * cell_m * cell_m;
  EXPECT_NEAR(seen_m3, room_m3, 0.12 * room_m3);
  EXPECT_TRUE(has(space.cells, {1.0, 1.0, 1.0}));
  EXPECT_TRUE(has(space.surfaces, {4.05, 1.5, 1.2}));
  EXPECT_FALSE(has(space.surfaces, {1.0, 1.0, 1.0}));
  EXPECT_FALSE(has(space.cells, {6.0, 1.5, 1.2}));
  EXPECT_TRUE(std::is_sorted(space.cells.begin(), space.cells.end(),
                             [](const GridCell& a, const GridCell& b) {
                               return std::array{a[2], a[1], a[0]} < std::array{b[2], b[1], b[0]};
                             }));
}

TEST(ObservableSpace, goes_on_behind_a_door_that_the_body_fits_through) {
  World world = two_closed_rooms();
  world.boxes.back() = {{4, 0, 0}, {4.3, 1.2, 2.4}};
  const double open = static_cast<double>(observable_space(world, request_in(world)).cells.size());
  const double closed =
      static_cast<double>(observable_space(two_closed_rooms(), request_in(world)).cells.size());
  EXPECT_GT(open, 1.8 * closed);
}

TEST(ObservableSpace, holds_nothing_where_the_body_does_not_fit_at_the_start) {
  World world = two_closed_rooms();
  world.start_W = {4.1, 1.5, 0.0};
  EXPECT_TRUE(observable_space(world, request_in(world)).cells.empty());
}

TEST(ObservableSpace, of_a_camera_that_looks_down_ends_below_the_ceiling) {
  const World world = two_closed_rooms();
  ObservableRequest request = request_in(world);
  request.camera.pitch_down_rad = 0.6;  // More than half its field of view.
  const ObservableSpace space = observable_space(world, request);
  const auto level = observable_space(world, request_in(world));
  EXPECT_LT(space.cells.size(), level.cells.size());
  EXPECT_GT(space.cells.size(), level.cells.size() / 2);
  EXPECT_TRUE(has(space.cells, {1.0, 1.0, 0.2}));
  EXPECT_FALSE(has(space.cells, {2.0, 1.5, 2.3})) << "above all places where the camera can be";
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/gap_scan.h"

#include "grid_map.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

const Aabb space_W{{-5.0, -20.0, 0.0}, {40.0, 20.0, 3.0}};
const Vec3 here_W{0.0, 0.0, 1.5};
const Vec3 goal_W{100.0, 0.0, 1.5};

GapScan within_bounds() {
  GapScan scan;
  scan.bounds_W = space_W;
  return scan;
}

kit::GridMap open_space() {
  return kit::GridMap{space_W, 0.1};
}

/// Across the whole space at this x, but for one opening.
void build_wall(kit::GridMap& map, double x_m, double depth_m, double from_y_m, double to_y_m) {
  map.fill({{x_m, -20.0, 0.0}, {x_m + depth_m, from_y_m, 3.0}}, CellState::occupied);
  map.fill({{x_m, to_y_m, 0.0}, {x_m + depth_m, 20.0, 3.0}}, CellState::occupied);
}

TEST(GapScan, has_nothing_narrow_in_the_open) {
  const GapsAhead gaps = gaps_ahead(open_space(), here_W, goal_W, within_bounds());
  EXPECT_EQ(gaps.narrowest_m, 24.0);
  EXPECT_EQ(gaps.narrowest_at_m, 24.0);
  EXPECT_EQ(gaps.mean_m, 24.0);
}

TEST(GapScan, finds_a_door_in_a_thin_wall_and_how_far_it_is) {
  for (const double x_m : {9.5, 10.0, 10.25, 10.8}) {
    kit::GridMap map = open_space();
    build_wall(map, x_m, 0.2, -3.0, -2.2);
    const GapsAhead gaps = gaps_ahead(map, here_W, goal_W, within_bounds());
    EXPECT_NEAR(gaps.narrowest_m, 0.8, 0.5) << x_m;
    EXPECT_LT(gaps.narrowest_m, 1.2) << x_m;
    EXPECT_NEAR(gaps.narrowest_at_m, x_m, 0.75) << x_m;
  }
}

TEST(GapScan, measures_the_widest_of_several_openings) {
  kit::GridMap map = open_space();
  map.fill({{10.0, -20.0, 0.0}, {14.0, -8.0, 3.0}}, CellState::occupied);
  map.fill({{10.0, -6.0, 0.0}, {14.0, 1.0, 3.0}}, CellState::occupied);
  map.fill({{10.0, 6.0, 0.0}, {14.0, 20.0, 3.0}}, CellState::occupied);
  const GapsAhead gaps = gaps_ahead(map, here_W, goal_W, within_bounds());
  EXPECT_NEAR(gaps.narrowest_m, 5.0, 0.3);
}

TEST(GapScan, sees_no_opening_outside_the_flight_area) {
  kit::GridMap map = open_space();
  map.fill({{10.0, -4.0, 0.0}, {12.0, 4.0, 3.0}}, CellState::occupied);
  GapScan scan = within_bounds();
  EXPECT_GT(gaps_ahead(map, here_W, goal_W, scan).narrowest_m, 7.0);
  scan.bounds_W.min.y() = -4.0;
  scan.bounds_W.max.y() = 4.0;
  EXPECT_EQ(gaps_ahead(map, here_W, goal_W, scan).narrowest_m, 0.0);
}

TEST(GapScan, ends_at_the_goal) {
  kit::GridMap map = open_space();
  build_wall(map, 10.0, 0.2, -3.0, -2.2);
  EXPECT_EQ(gaps_ahead(map, here_W, {8.0, 0.0, 1.5}, within_bounds()).narrowest_m, 24.0);
  EXPECT_EQ(gaps_ahead(map, here_W, here_W, within_bounds()).narrowest_m, 24.0);
}

PathWidth width_on(const kit::GridMap& map, const Path& path, double horizon_m = 8.0) {
  return narrowest_on(map, {&path, 0.0, horizon_m}, 0.3);
}

TEST(PathWidth, has_no_narrow_place_in_the_open) {
  const Path path = Path::polyline({here_W, Vec3{10.0, 0.0, 1.5}});
  const PathWidth narrowest = width_on(open_space(), path);
  EXPECT_EQ(narrowest.width_m, 6.0);
  EXPECT_EQ(narrowest.at_m, 8.0);
}

TEST(PathWidth, is_that_of_the_gap_on_the_path_whatever_is_open_beside_it) {
  kit::GridMap map = open_space();
  map.fill({{5.0, -2.0, 0.0}, {5.2, -0.6, 3.0}}, CellState::occupied);
  map.fill({{5.0, 0.6, 0.0}, {5.2, 2.0, 3.0}}, CellState::occupied);
  const Path path = Path::polyline({here_W, Vec3{10.0, 0.0, 1.5}});
  const PathWidth narrowest = width_on(map, path);
  EXPECT_NEAR(narrowest.width_m, 1.2, 0.15);  // The line across it may miss the wall by .1 m.
  EXPECT_NEAR(narrowest.at_m, 5.0, 0.5);
  EXPECT_EQ(gaps_ahead(map, here_W, goal_W, within_bounds()).narrowest_m > 6.0, true);
}

TEST(PathWidth, is_not_narrow_beside_a_single_obstacle) {
  kit::GridMap map = open_space();
  map.fill({{3.0, 0.8, 0.0}, {6.0, 3.0, 3.0}}, CellState::occupied);
  const Path path = Path::polyline({here_W, Vec3{10.0, 0.0, 1.5}});
  EXPECT_NEAR(width_on(map, path).width_m, 0.8 + 3.0, 0.1);
}

TEST(PathWidth, looks_no_farther_than_the_path_or_its_span_reaches) {
  kit::GridMap map = open_space();
  map.fill({{5.0, 0.5, 0.0}, {6.0, 3.0, 3.0}}, CellState::occupied);
  const Path path = Path::polyline({here_W, Vec3{10.0, 0.0, 1.5}});
  EXPECT_EQ(width_on(map, path, 4.0).width_m, 6.0);
  const Path ends = Path::polyline({here_W, Vec3{4.0, 0.0, 1.5}});
  EXPECT_EQ(width_on(map, ends).width_m, 6.0);
  EXPECT_EQ(width_on(map, ends).at_m, 4.0);
}

TEST(PathWidth, takes_a_climb_for_no_gap) {
  kit::GridMap map = open_space();
  map.fill({{0.4, -3.0, 0.0}, {0.6, 3.0, 3.0}}, CellState::occupied);
  const Path path = Path::polyline({Vec3{0.0, 0.0, 0.5}, Vec3{0.0, 0.0, 2.5}});
  EXPECT_EQ(width_on(map, path).width_m, 6.0);
}

}  // namespace
}  // namespace flyball

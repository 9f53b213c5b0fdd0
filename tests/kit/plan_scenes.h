// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Maps and requests for tests of planners and smoothers.

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/random.h"

#include "grid_map.h"
#include <cmath>

namespace flyball::kit {

/// A .65 m vehicle, .2 m high, with .03 m of tracking tube.
inline Cylinder slow_body() {
  return {0.355, 0.13};
}

struct Scene {
  GridMap map;
  PlanRequest request;
};

/// Through a facade and on to a goal 30 m behind it, in a .15 m map. The doors are five cells wide
/// (.75 m for a .71 m body) and lie apart, so that the way is a slalom. What the vehicle has not
/// seen from before the first door is unknown.
///
/// @param known_doors  Walls behind the facade whose doors are mapped; the others are unknown.
inline Scene office(int known_doors, std::uint64_t seed) {
  Scene scene{GridMap{{{0, -15, 0}, {45, 15, 3}}, 0.15, CellState::unknown}, {}};
  auto& map = scene.map;
  RandomStream random{seed, "office"};
  map.fill({{0, -15, 0}, {10.05, 15, 3}}, CellState::free);
  for (int wall = 0; wall <= known_doors; ++wall) {
    const double x_m = 10.05 + 6.0 * wall;
    const double door_m = 0.15 * std::round(random.uniform(-6.0, 6.0) / 0.15);
    map.fill({{x_m, -15, 0}, {x_m + 0.15, 15, 3}}, CellState::occupied);
    map.fill({{x_m, door_m, 0}, {x_m + 0.15, door_m + 0.75, 2.1}}, CellState::free);
    map.fill({{x_m + 0.15, door_m - 2, 0}, {x_m + 4, door_m + 3, 2.1}}, CellState::free);
  }
  scene.request.start_W = {5.0, random.uniform(-2.0, 2.0), 1.5};
  scene.request.goal_W = {40.0, random.uniform(-5.0, 5.0), 1.5};
  scene.request.bounds_W = {{0.5, -14.5, 0.6}, {44.5, 14.5, 2.6}};
  scene.request.body = slow_body();
  scene.request.max_iterations = 40000;
  scene.request.seed = seed;
  return scene;
}

/// Trunks and boxes of random size and place, 24 m by 16 m; start and goal at the ends are clear.
inline Scene random_world(std::uint64_t seed) {
  Scene scene{GridMap{{{0, -8, 0}, {24, 8, 4.5}}, 0.15}, {}};
  RandomStream random{seed, "random_world"};
  const int obstacles = 10 + static_cast<int>(random.uniform(0.0, 25.0));
  for (int i = 0; i < obstacles; ++i) {
    const Vec3 foot{random.uniform(2.5, 21.5), random.uniform(-8.0, 8.0), 0.0};
    const Vec3 size{random.uniform(0.2, 1.8), random.uniform(0.2, 1.8), random.uniform(1.0, 4.5)};
    scene.map.fill({foot, foot + size}, CellState::occupied);
  }
  scene.map.fill({{0, -8, 0}, {2.2, 8, 4.5}}, CellState::free);
  scene.map.fill({{21.8, -8, 0}, {24, 8, 4.5}}, CellState::free);
  scene.request.start_W = {1.0, random.uniform(-6.0, 6.0), random.uniform(1.0, 2.5)};
  scene.request.goal_W = {23.0, random.uniform(-6.0, 6.0), random.uniform(1.0, 2.5)};
  scene.request.bounds_W = {{0.5, -7.5, 0.5}, {23.5, 7.5, 4.0}};
  scene.request.body = slow_body();
  scene.request.seed = seed;
  return scene;
}

}  // namespace flyball::kit

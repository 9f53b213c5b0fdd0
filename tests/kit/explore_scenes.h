// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Maps and requests for tests of explorers.

#include "flyball/kernels/explorer.h"

#include "grid_map.h"

namespace flyball::kit {

/// Two rooms of 6 m side by side along x, [0, 6] and [6, 12], 3 m high, with a wall between them
/// that has a door in its middle, 1.05 m wide. The first room is known, the second one is not.
inline GridMap two_rooms() {
  GridMap map{{{0, 0, 0}, {12, 6, 3}}, 0.15, CellState::unknown};
  map.fill({{0, 0, 0}, {6, 6, 3}}, CellState::free);
  map.fill({{6, 0, 0}, {6.15, 6, 3}}, CellState::occupied);
  map.fill({{6, 2.55, 0}, {6.15, 3.6, 2.1}}, CellState::free);
  return map;
}

inline ExploreRequest request_from(const Vec3& p_W, double yaw_rad) {
  ExploreRequest request;
  request.from = {p_W, yaw_rad};
  request.volume_W = {{0, 0, 0}, {12, 6, 3}};
  request.bounds_W = {{0, 0, 0.5}, {12, 6, 2.1}};
  request.body = {0.355, 0.155};
  request.seed = 1;
  return request;
}

}  // namespace flyball::kit

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What of a volume a vehicle could ever see: the true answer, by which explorations are judged.

#include "flyball/runtime/grid_walk.h"
#include "flyball/sim/depth_camera.h"
#include "flyball/sim/world.h"

#include <cstddef>
#include <vector>

namespace flyball {

struct ObservableRequest {
  Cylinder body{};
  Vec3 start_W{Vec3::Zero()};  ///< Of the body's centre, in the air.
  DepthCameraSpec camera{};  ///< Its field of view and mount; noise and pixel count do not matter.
  double range_m{7.0};
  double cell_m{0.15};
};

/// Cells of a lattice in the world's volume, each at most once, in ascending order of (z, y, x).
struct ObservableSpace {
  double cell_m{};
  std::vector<GridCell> cells{};  ///< That can be seen: their centre, or a solid's surface in them.
  std::vector<GridCell> surfaces{};  ///< Those of them where a ray ends on a solid.
};

/// Floods the true world with the body from the start, within the world's bounds, and looks from
/// places all over what it reaches, .9 m apart, in every heading.
///
/// @return  Nothing to see where the body does not fit at the start.
/// @cost    About a second for 200 m^2 of rooms.
[[nodiscard]] ObservableSpace observable_space(const World& world,
                                               const ObservableRequest& request);

}  // namespace flyball

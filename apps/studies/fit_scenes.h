// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The scenes on which a platform file is fitted and checked, and what the kernels do there.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"
#include "flyball/scenario/scenario.h"

#include <map>
#include <string>
#include <vector>

namespace flyball {

/// What one kernel did, call by call.
struct KernelLoad {
  std::vector<Work> calls{};
  [[nodiscard]] Work mean() const;
};

using KernelLoads = std::map<std::string, KernelLoad>;  ///< By the name on the price list.

/// The outdoor part of a delivery, without dynamics: look, map, check the path to the goal, plan
/// again where it is blocked, go on by a step. Ends where the world's speed zone, its building,
/// begins.
struct DeliveryScene {
  Scenario scenario{};
  double step_m{};
  double checked_m{};            ///< Length of the path that the priced check looks at.
  double coarse_resolution_m{};  ///< Each frame is also counted at this resolution.
  int localizes_every{};         ///< After so many steps a localizer sees the path ahead once,
  double localizes_s{};          ///< for so long,
  double speed_m_s{};            ///< at the mean speed of `fixed_fine` there.
};

struct DeliveryLoads {
  KernelLoads kernels{};
  KernelLoad coarse_map{};
};

/// A look around in the middle of each room of a building.
struct RoomsScene {
  Scenario scenario{};
  Vec3 first_room_W{Vec3::Zero()};  ///< The room's middle at least x and y, at camera height.
  int rows{};                       ///< Along x.
  int columns{};                    ///< Along y.
  double row_pitch_m{};
  double column_pitch_m{};
  int headings{};        ///< Evenly spread, the first along x.
  double localizes_s{};  ///< From each room's middle a localizer sees straight ahead for so long,
  double speed_m_s{};    ///< at the speed that the delivery's zone allows.
};

/// The shipped delivery_outdoor_to_indoor, seed 1, from take-off to the door.
[[nodiscard]] DeliveryScene scene_a();
/// The rooms of the same building as MAVBench's 3-D mapping sees them: same camera, same map.
[[nodiscard]] RoomsScene scene_b();
/// MAVBench's scanning: 100 x 100 m in five lanes.
[[nodiscard]] Scenario paper_survey();

/// @error `not_found`, `invalid_input` (the scenario), `failed` (a kernel, or no path to the goal).
[[nodiscard]] Result<DeliveryLoads> record(const DeliveryScene& scene);
/// Perception only. Places that furniture takes are left out.
[[nodiscard]] Result<KernelLoads> record(const RoomsScene& scene);
/// The plan of a scenario's survey, which is asked for once in a mission.
[[nodiscard]] Result<KernelLoads> record(const Scenario& survey);

}  // namespace flyball

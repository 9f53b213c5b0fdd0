// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// An exploration without dynamics, to record what its kernels do: look, ask for the next view, be
/// there.

#include "studies/fit_scenes.h"

namespace flyball {

/// From the world's start, until so much of what can be seen is known.
struct ExplorationScene {
  Scenario scenario{};
  int most_views{};
  int localizes_every{};  ///< After so many looks along a path, a localizer sees the path ahead
                          ///< once,
  double localizes_s{};   ///< for so long; never when `localizes_every` is 0,
  double speed_m_s{};     ///< at the speed that the world allows.
};

/// The shipped mapping_office, seed 1.
[[nodiscard]] ExplorationScene scene_c();
/// The ruin of search_collapsed_building, seed 1, with bays as large as the rooms of `scene_b`,
/// searched all over.
[[nodiscard]] ExplorationScene scene_d();

struct ExplorationLoads {
  KernelLoads kernels{};
  int views{};
  double coverage_percent{};
};

/// @error `not_found`, `invalid_input` (the scenario), `failed` (a kernel).
[[nodiscard]] Result<ExplorationLoads> record(const ExplorationScene& scene);

}  // namespace flyball

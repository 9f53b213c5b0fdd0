// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Views of the borders between known-free and unknown space, anywhere in the volume (Yamauchi
/// 1997, doi:10.1109/CIRA.1997.613851): where to go when nothing is left to see nearby.

#include "planning/standing_places.h"
#include "planning/view_gain.h"

namespace flyball {

/// A stretch of border.
struct Frontier {
  GridCell cell{};  ///< One of its free cells, near its middle.
  double faces{};   ///< Between free and unknown cells.
};

/// Free cells of the volume that touch unknown ones, gathered in cubes of about a metre.
[[nodiscard]] std::vector<Frontier> find_frontiers(const StateGrid& grid, const Aabb& volume_W);

struct FrontierView {
  Viewpoint view{};
  double path_m{};
  double gain_m3{};
};

struct WantedGain {
  double least_m3{};   ///< Less is not worth going for.
  double enough_m3{};  ///< With as much, frontiers that promise less are not looked at.
};

/// The view that shows most per metre flown. Frontiers are looked at in batches, those with most
/// unknown faces per metre first; faces promise little where a wall stands behind them.
///
/// @return  Empty when no place shows a frontier; adds to `gain`'s counts.
[[nodiscard]] std::optional<FrontierView> best_frontier_view(const ExploreRequest& request,
                                                             const StandingPlaces& places,
                                                             ViewGain& gain,
                                                             const WantedGain& wanted,
                                                             double& ray_cells);

/// Whether the view was had already, or cannot be got to.
[[nodiscard]] bool is_spent(const ExploreRequest& request, const Viewpoint& view);

}  // namespace flyball

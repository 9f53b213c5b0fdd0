// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Blocks on a grid, the denser the nearer to a place where they crowd, for the world generators.

#include "flyball/runtime/random.h"
#include "flyball/sim/world.h"

#include <vector>

namespace flyball {

/// RoboRun's obstacles (DAC 2021, arXiv 2108.13354): 4 m x 4 m blocks on a 10 m grid that follows
/// the axes of W, so that passages between them are at least 6 m wide.
struct CongestionPlan {
  std::vector<Vec3> peaks_W{};
  double density{0.3};    ///< Probability of a block at a peak, 0..1.
  double spread_m{40.0};  ///< Two standard deviations of the profile around a peak.
  Aabb area_W{};          ///< Blocks stand wholly inside of it.
  double height_m{6.0};
  std::vector<Vec3> clear_W{};  ///< Nothing within `clear_radius_m` of these places.
  double clear_radius_m{6.0};
};

/// At a distance d from the nearest peak a grid point has a block with the probability
/// density exp(-d^2 / 2 sigma^2), sigma = spread / 2.
[[nodiscard]] std::vector<Aabb> congested_blocks(const CongestionPlan& plan, RandomStream& random);

}  // namespace flyball

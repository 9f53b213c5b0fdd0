// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Narrow passages between occupied cells: doors, windows, the space between two trees.

#include "planning/motion_checker.h"
#include <vector>

namespace flyball {

/// A place in the middle between two obstacles.
struct Gap {
  Vec3 centre_W{Vec3::Zero()};
  Vec3 across_W{Vec3::UnitX()};  ///< Horizontal unit vector from one obstacle to the other.
  double width_m{};
};

/// Gaps that lie close together (two cells of a door frame give many), narrowest first.
using GapGroup = std::vector<Gap>;

/// All gaps at the height of the box's centre that are wider than the body and narrower than
/// twice its diameter. Their centres need not be free: something else may be in the way.
///
/// The bridge test of Hsu et al. 2003 (doi:10.1109/ROBOT.2003.1242285), but exhaustive: the map
/// gives the occupied columns quickly, so both ends of each bridge are found without luck.
/// @param region_W  Where to look; its height is what must be clear for the body.
/// @cost            O(occupied columns); gives up (no gaps) on regions of over 16 million columns.
[[nodiscard]] std::vector<GapGroup> find_gaps(MotionChecker& checker, const Aabb& region_W);

}  // namespace flyball

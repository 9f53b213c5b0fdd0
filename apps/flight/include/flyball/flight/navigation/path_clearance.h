// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the node `check` finds of the committed path in each new map.

#include "flyball/flight/navigation/path_follower.h"
#include "flyball/flight/perception/map_revision.h"
#include "flyball/runtime/numbers.h"

#include <optional>

namespace flyball {

struct PathClearance {
  MapRevision revision{};
  MissionTime published{};      ///< When that revision came.
  std::uint64_t path_number{};  ///< Of the path that was checked; the navigator may have another.
  std::optional<double> blocked_at_m{};  ///< Arc length of the first occupied place.
  TierDistances free_until_m{};
};

inline void visit_numbers(PathClearance& clearance, NumberVisitor& visitor) {
  if (clearance.blocked_at_m) {
    visitor.visit("blocked_at", Quantity::distance, *clearance.blocked_at_m);
  }
  for (double& free_until_m : clearance.free_until_m) {
    visitor.visit("free_until", Quantity::distance, free_until_m);
  }
}

}  // namespace flyball

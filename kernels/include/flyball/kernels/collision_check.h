// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Collision check along the path that is being flown.

#include "flyball/runtime/kernel.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/trajectory.h"
#include "flyball/runtime/work.h"

#include <optional>

namespace flyball {

struct PathCheck {
  std::optional<double>
      blocked_at_m{};     ///< Arc length of the first place where an occupied cube hits the body.
  double known_free_m{};  ///< From `from_m`, at most the horizon.
};

class CollisionChecker : public Kernel {
 public:
  /// Looks for occupied cubes from the span's beginning to the path's end, and for unknown ones
  /// within the horizon.
  /// Adds `poses` to `work`.
  [[nodiscard]] virtual PathCheck check(const OccupancyView& map,
                                        const PathSpan& span,
                                        const Cylinder& body,
                                        Work& work) = 0;
};

}  // namespace flyball

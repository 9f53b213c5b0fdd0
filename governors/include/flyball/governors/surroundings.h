// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What an observation tells of all that limits the vehicle's speed besides the latency of maps.

#include "flyball/runtime/observation.h"

namespace flyball {

/// Width of a path that has nothing beside it, as an observation tells it [m].
constexpr double open_path_m = 6.0;

struct Surroundings {
  double speed_limit_m_s{};    ///< The mission's own.
  double deceleration_m_s2{};  ///< Of MAVBench's eq. 2.
  /// How far the camera can see along the path before the world, not the range, ends the view.
  double visibility_m{};
};

/// The limits of an observation, or usual ones where its values make no sense. The visibility is
/// what `shown_free_m` says.
[[nodiscard]] Surroundings surroundings_of(const Observation& seen);

/// How far the newest map showed the committed path as free, from the place where its frame was
/// taken [m]: d of eq. 2, without the allowance for body and tube. It also ends where the path
/// ends, because before a place where the vehicle will stop, latency slows it down further. 0 where
/// the values of an observation make no sense.
[[nodiscard]] double shown_free_m(const Observation& seen);

/// Whether something beside the latency of maps makes the vehicle slower than the mission allows:
/// it stands, a plan has failed, or obstacles narrow its path. The price of a metre does not count
/// what plans and turns cost there, so a lower clock may lose more than that price says.
[[nodiscard]] bool is_held_up(const Observation& seen);

}  // namespace flyball

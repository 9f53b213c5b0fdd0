// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How a mission ends.

#include <cstdint>

namespace flyball {

enum class MissionStatus : std::uint8_t { succeeded, failed, interrupted };
enum class MissionFailure : std::uint8_t {
  none,
  collision,
  battery_empty,
  no_plan,
  time_limit,
  target_lost,        ///< The followed person was lost, or tracked for too short a time.
  localization_lost,  ///< The localizer lost track and did not find it again.
  not_found,          ///< Everything was searched; the person was not seen.
  incomplete,         ///< Less was covered or mapped than the mission asks for.
  false_alarm,        ///< A person was reported where nobody stands.
  misdelivered,       ///< The payload was released elsewhere than at the goal.
  autopilot           ///< It refused a command, or somebody took the vehicle over.
};

[[nodiscard]] const char* to_string(MissionStatus status);
[[nodiscard]] const char* to_string(MissionFailure failure);

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What differs between the autopilots that can be flown.

#include "flyball/runtime/result.h"

#include "vehicles/mavlink_messages.h"
#include <cstdint>
#include <string>

namespace flyball {

enum class AutopilotKind : std::uint8_t { px4, ardupilot };

/// @error `invalid_input`: another autopilot, or no multirotor.
[[nodiscard]] Result<AutopilotKind> autopilot_kind(const MavHeartbeat& heartbeat);

[[nodiscard]] const char* to_string(AutopilotKind kind);

/// The mode, as HEARTBEAT says it, in which a companion computer's set-points are flown.
[[nodiscard]] std::uint32_t commanded_mode(AutopilotKind kind);
/// In which the autopilot lands by itself.
[[nodiscard]] std::uint32_t landing_mode(AutopilotKind kind);
/// As pilots know it: "offboard", "RTL"; its number where it is a rare one.
[[nodiscard]] std::string mode_name(AutopilotKind kind, std::uint32_t custom_mode);
/// Asks for `commanded_mode`. Whom it is for is not set.
[[nodiscard]] MavCommandLong command_to_be_commanded(AutopilotKind kind);

}  // namespace flyball

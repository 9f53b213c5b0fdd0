// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/mavlink_messages.h"

namespace flyball {

std::string mavlink_result_name(std::uint8_t result) {
  static constexpr std::array<const char*, 10> names{
      "ACCEPTED",         "TEMPORARILY_REJECTED",
      "DENIED",           "UNSUPPORTED",
      "FAILED",           "IN_PROGRESS",
      "CANCELLED",        "COMMAND_LONG_ONLY",
      "COMMAND_INT_ONLY", "COMMAND_UNSUPPORTED_MAV_FRAME"};
  return result < names.size() ? names[result] : "result " + std::to_string(result);
}

std::vector<MavlinkKind> kinds_from_autopilot() {
  return {MavHeartbeat::kind,          MavSystemStatus::kind,  MavParamValue::kind,
          MavAttitudeQuaternion::kind, MavLocalPosition::kind, MavCommandAck::kind,
          MavExtendedState::kind,      MavStatusText::kind};
}

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
// tested-in: summary
#include "flyball/flight/mission_end.h"

namespace flyball {

const char* to_string(MissionStatus status) {
  switch (status) {
    case MissionStatus::succeeded:
      return "succeeded";
    case MissionStatus::failed:
      return "failed";
    case MissionStatus::interrupted:
      return "interrupted";
  }
  return "unknown";
}

const char* to_string(MissionFailure failure) {
  switch (failure) {
    case MissionFailure::none:
      return "none";
    case MissionFailure::collision:
      return "collision";
    case MissionFailure::battery_empty:
      return "battery_empty";
    case MissionFailure::no_plan:
      return "no_plan";
    case MissionFailure::time_limit:
      return "time_limit";
    case MissionFailure::target_lost:
      return "target_lost";
    case MissionFailure::localization_lost:
      return "localization_lost";
    case MissionFailure::not_found:
      return "not_found";
    case MissionFailure::incomplete:
      return "incomplete";
    case MissionFailure::false_alarm:
      return "false_alarm";
    case MissionFailure::misdelivered:
      return "misdelivered";
    case MissionFailure::autopilot:
      return "autopilot";
  }
  return "unknown";
}

}  // namespace flyball

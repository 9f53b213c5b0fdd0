// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/autopilot_kind.h"

#include <algorithm>
#include <array>
#include <utility>

namespace flyball {
namespace {

// PX4's px4_custom_mode.h: the main mode in bits 16 to 23, the sub-mode above it.
constexpr std::uint32_t px4_mode(std::uint32_t main_mode, std::uint32_t sub_mode = 0) {
  return (main_mode << 16U) | (sub_mode << 24U);
}
constexpr std::uint32_t px4_auto = 4;
constexpr std::uint32_t px4_offboard = 6;

using ModeNames = std::vector<std::pair<std::uint32_t, const char*>>;

const ModeNames& names_of_px4() {
  static const ModeNames names{{px4_mode(1), "manual"},
                               {px4_mode(2), "altitude"},
                               {px4_mode(3), "position"},
                               {px4_mode(px4_auto, 2), "take-off"},
                               {px4_mode(px4_auto, 3), "hold"},
                               {px4_mode(px4_auto, 4), "mission"},
                               {px4_mode(px4_auto, 5), "return"},
                               {px4_mode(px4_auto, 6), "land"},
                               {px4_mode(5), "acro"},
                               {px4_mode(px4_offboard), "offboard"},
                               {px4_mode(7), "stabilized"}};
  return names;
}

// ArduCopter's mode.h.
constexpr std::uint32_t copter_guided = 4;
constexpr std::uint32_t copter_land = 9;

const ModeNames& names_of_copter() {
  static const ModeNames names{
      {0, "STABILIZE"},          {1, "ACRO"},   {2, "ALT_HOLD"},  {3, "AUTO"},
      {copter_guided, "GUIDED"}, {5, "LOITER"}, {6, "RTL"},       {copter_land, "LAND"},
      {16, "POSHOLD"},           {17, "BRAKE"}, {21, "SMART_RTL"}};
  return names;
}

// MAV_TYPE of quadro-, coaxial, hexa-, octo-, tri-, dodeca- and decarotors.
constexpr std::array<std::uint8_t, 7> multirotors{2, 3, 13, 14, 15, 29, 35};

}  // namespace

Result<AutopilotKind> autopilot_kind(const MavHeartbeat& heartbeat) {
  const std::uint8_t maker = heartbeat.autopilot;
  if (maker != mav::autopilot_px4 && maker != mav::autopilot_ardupilot) {
    return Error{ErrorCode::invalid_input, "the autopilot is of another make (MAV_AUTOPILOT " +
                                               std::to_string(maker) +
                                               "); connect PX4 or ArduPilot"};
  }
  if (std::find(multirotors.begin(), multirotors.end(), heartbeat.type) == multirotors.end()) {
    return Error{ErrorCode::invalid_input, "the autopilot flies no multirotor (MAV_TYPE " +
                                               std::to_string(heartbeat.type) +
                                               "); connect one that does"};
  }
  return maker == mav::autopilot_px4 ? AutopilotKind::px4 : AutopilotKind::ardupilot;
}

const char* to_string(AutopilotKind kind) {
  return kind == AutopilotKind::px4 ? "PX4" : "ArduPilot";
}

std::uint32_t commanded_mode(AutopilotKind kind) {
  return kind == AutopilotKind::px4 ? px4_mode(px4_offboard) : copter_guided;
}

std::uint32_t landing_mode(AutopilotKind kind) {
  constexpr std::uint32_t px4_land = 6;
  return kind == AutopilotKind::px4 ? px4_mode(px4_auto, px4_land) : copter_land;
}

std::string mode_name(AutopilotKind kind, std::uint32_t custom_mode) {
  for (const auto& [mode, name] : kind == AutopilotKind::px4 ? names_of_px4() : names_of_copter()) {
    if (mode == custom_mode) {
      return name;
    }
  }
  return "mode " + std::to_string(custom_mode);
}

MavCommandLong command_to_be_commanded(AutopilotKind kind) {
  MavCommandLong command;
  command.command = mav::command_set_mode;
  command.parameters[0] = 1.0F;  // MAV_MODE_FLAG_CUSTOM_MODE_ENABLED: the next one counts.
  command.parameters[1] =
      static_cast<float>(kind == AutopilotKind::px4 ? px4_offboard : copter_guided);
  return command;
}

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
//
// What an autopilot may send, whole messages and rubbish: the vehicle's motion stays finite, and
// only whole frames with finite numbers are sent.

#include "input_folder.h"
#include "vehicles/offboard_control.h"
#include <algorithm>
#include <cmath>

namespace {

using namespace flyball;

/// The next `size` bytes of the input; zeros behind its end.
std::vector<std::uint8_t> taken(const std::uint8_t*& bytes, std::size_t& left, std::size_t size) {
  std::vector<std::uint8_t> piece(size);
  const std::size_t there = std::min(size, left);
  std::copy(bytes, bytes + there, piece.begin());
  bytes += there;
  left -= there;
  return piece;
}

void look_at(OffboardControl& control, Duration now) {
  const VehicleMotion motion = control.motion(now);
  require(motion.X_WB.matrix().allFinite() && motion.v_WB.allFinite() &&
              motion.w_WB_B.allFinite() && motion.a_WB.allFinite(),
          "the motion is finite");
  const std::vector<std::uint8_t> sent = control.take_output();
  MavlinkReader reader{{MavHeartbeat::kind, MavParamRequestRead::kind, MavCommandLong::kind,
                        MavPositionTarget::kind}};
  for (const MavlinkFrame& frame : reader.read(sent.data(), sent.size())) {
    if (frame.id == MavPositionTarget::kind.id) {
      const auto target = mavlink_message<MavPositionTarget>(frame);
      for (const auto& numbers : {target.p_m, target.v_m_s, target.a_m_s2}) {
        require(std::all_of(numbers.begin(), numbers.end(),
                            [](float number) { return std::isfinite(number); }),
                "a set-point is finite");
      }
    }
  }
  require(reader.counts().skipped_bytes == 0, "only whole frames are sent");
}

void command(OffboardControl& control, std::uint8_t which, Duration now) {
  if (which % 4 == 3) {
    Setpoint setpoint;
    setpoint.stamp = MissionTime{now};
    setpoint.p_WB = control.motion(now).X_WB.translation();
    setpoint.v_WB.x() = which;
    control.follow(setpoint);
  } else {
    control.obey({static_cast<FlightCommand::Kind>(which % 4), 2.0}, now);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::uint8_t of_commands = 14;
  constexpr std::size_t rubbish_bytes = 24;
  OffboardControl control{{}};
  const std::vector<MavlinkKind> kinds = kinds_from_autopilot();
  Duration now{};
  std::uint8_t sequence = 0;
  while (size > 0) {
    const std::vector<std::uint8_t> head = taken(bytes, size, 2);
    now += std::chrono::milliseconds{4 * head[1]};
    const std::uint8_t which = head[0] % 16;
    if (which < kinds.size()) {
      const MavlinkKind& kind = kinds[which];
      const auto frame = mavlink_bytes(kind, taken(bytes, size, kind.length), 1, 1, sequence++);
      control.hear(frame.data(), frame.size(), now);
    } else if (which < of_commands) {
      if (control.is_connected()) {
        command(control, head[0], now);
      }
    } else {
      const auto rubbish = taken(bytes, size, rubbish_bytes);
      control.hear(rubbish.data(), rubbish.size(), now);
    }
    control.advance(now);
    look_at(control, now);
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
//
// From silence to an autopilot that sends what is needed and stands at the start.

#include "vehicles/offboard_control.h"
#include <algorithm>
#include <cstdio>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto heard_within = 15s;  // Chosen: an autopilot boots in about 10 s.
constexpr auto located_within =
    30s;  // Chosen: a GPS receiver that was on lately has a fix by then.
constexpr auto limit_answer_within = 500ms;
constexpr int most_limit_tries = 5;
constexpr double longest_guided_timeout_s = 0.5;  // As long as a set-point counts here.
constexpr const char* guided_timeout = "GUID_TIMEOUT";

struct WantedMessage {
  std::uint32_t id;
  float interval_us;
  const char* what;
  const char* otherwise;  ///< What happens where it is denied; null: the vehicle cannot be flown.
};

// 50 Hz take 5 kB/s, which a serial line of 115200 baud carries twice.
constexpr std::array<WantedMessage, 4> wanted_messages{{
    {MavLocalPosition::kind.id, 20e3F, "to send LOCAL_POSITION_NED", nullptr},
    {MavAttitudeQuaternion::kind.id, 20e3F, "to send ATTITUDE_QUATERNION", nullptr},
    {MavExtendedState::kind.id, 200e3F, "to send EXTENDED_SYS_STATE", nullptr},
    {MavSystemStatus::kind.id, 200e3F, "to send SYS_STATUS", "power is estimated"},
}};

}  // namespace

void OffboardControl::step_connection(Duration now) {
  if (!commands_.failure().empty()) {
    const char* otherwise =
        leg_ == Leg::requesting ? wanted_messages.at(requested_ - 1).otherwise : nullptr;
    if (otherwise == nullptr) {
      fail(commands_.failure());
      return;
    }
    telemetry_.tell(commands_.failure() + "; " + otherwise);
    commands_.forget();
  }
  switch (leg_) {
    case Leg::listening:
      return listen(now);
    case Leg::requesting:
      return request(now);
    case Leg::limits:
      return ask_limits(now);
    case Leg::locating:
      return locate(now);
    default:
      return;
  }
}

void OffboardControl::listen(Duration now) {
  const auto& heard = telemetry_.kind();
  if (heard && !*heard) {
    fail(heard->error().message);
  } else if (heard) {
    enter(Leg::requesting, now);
  } else if (waited(heard_within, now)) {
    fail(std::string{"no autopilot was heard within 15 s: "} +
         (has_heard_bytes_ ? "what came holds no HEARTBEAT of one; is it an autopilot's line, at "
                             "its speed?"
                           : "nothing came; does the autopilot send to this address?"));
  }
}

void OffboardControl::request(Duration now) {
  if (commands_.is_waiting()) {
    return;
  }
  if (requested_ == wanted_messages.size()) {
    commands_.forget();
    enter(kind() == AutopilotKind::ardupilot ? Leg::limits : Leg::locating, now);
    return;
  }
  const WantedMessage& wanted = wanted_messages[requested_++];
  MavCommandLong interval;
  interval.command = mav::command_message_interval;
  interval.parameters[0] = static_cast<float>(wanted.id);
  interval.parameters[1] = wanted.interval_us;
  ask(interval, wanted.what, now);
}

/// Parameters have a protocol of their own, without refusals.
void OffboardControl::ask_limits(Duration now) {
  if (now < next_limit_try_) {
    return;
  }
  if (limit_tries_ == most_limit_tries) {
    telemetry_.tell(std::string{"the autopilot does not say its "} + guided_timeout +
                    ": how long it goes on flying when Flyball falls silent");
    enter(Leg::locating, now);
    return;
  }
  ++limit_tries_;
  next_limit_try_ = now + limit_answer_within;
  MavParamRequestRead request;
  request.target_system = telemetry_.system();
  request.target_component = mav::component_autopilot;
  const std::string name = guided_timeout;
  std::copy(name.begin(), name.end(), request.name.begin());
  send(request);
}

void OffboardControl::hear_limits(const MavParamValue& value, Duration now) {
  if (leg_ != Leg::limits || mavlink_text(value.name) != guided_timeout) {
    return;
  }
  if (value.value > longest_guided_timeout_s) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "%s is %.1f s: so long the vehicle flies on when Flyball falls silent; set it to "
                  "%.1f s",
                  guided_timeout, static_cast<double>(value.value), longest_guided_timeout_s);
    telemetry_.tell(text.data());
  }
  enter(Leg::locating, now);
}

void OffboardControl::locate(Duration now) {
  const auto& on_ground = telemetry_.is_on_ground();
  if (telemetry_.is_fresh(now) && on_ground) {
    if (telemetry_.is_armed() || !*on_ground) {
      fail("the vehicle is armed or in the air; land and disarm it, and connect again");
      return;
    }
    telemetry_.place({telemetry_.position_N(), start_.p_WB});
    is_connected_ = true;
    enter(Leg::standing, now);
    return;
  }
  if (waited(located_within, now)) {
    std::string missing;
    missing += telemetry_.has_position() ? "" : ", where it is";
    missing += telemetry_.has_attitude() ? "" : ", how it is turned";
    missing += on_ground ? "" : ", whether it is on the ground";
    fail("the autopilot does not say" +
         (missing.empty() ? ", often enough, where it is" : missing) +
         "; wait until it is ready to arm");
  }
}

}  // namespace flyball

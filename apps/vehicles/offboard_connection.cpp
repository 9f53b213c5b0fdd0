// SPDX-License-Identifier: BSD-3-Clause
//
// From silence to an autopilot that sends what is needed and stands at the start.

#include "flyball/runtime/text/listed.h"

#include "vehicles/offboard_control.h"
#include <algorithm>
#include <cstdio>
#include <limits>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto heard_within = 15s;  // Chosen: an autopilot boots in about 10 s.
// An ArduCopter in simulation took 31 s from its start until its estimate used GPS.
constexpr auto located_within = 90s;
constexpr auto told_to_wait_after = 5s;
constexpr auto limit_answer_within = 500ms;
constexpr int most_limit_tries = 5;

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

/// What some versions of ArduPilot call a parameter.
struct LimitName {
  const char* name;
  const char* unit;
  double per_si{1.0};  ///< How many of these units are one of SI.
};

/// A parameter of ArduPilot that decides whether it flies what it is told, in units of SI.
struct WantedLimit {
  std::vector<LimitName> names;
  double least;
  double most;
  const char* otherwise;  ///< What happens beyond it.
  bool is_needed{};       ///< Nobody should fly beyond it, nor without knowing it.
};

/// Copter 4.7.0 renamed two (ardupilot 31513, 32147), and 4.7.1 one of them again (33843).
std::vector<WantedLimit> wanted_limits(const FlightStart& start) {
  constexpr double any = std::numeric_limits<double>::infinity();
  constexpr double longest_s = 0.5;  // As long as a set-point counts here.
  constexpr double least_m_s3 = 20.0;
  return {{{{"GUID_TIMEOUT", "s"}},
           0.0,
           longest_s,
           "so long the vehicle flies on when Flyball falls silent"},
          {{{"WPNAV_ACCEL", "cm/s^2", 100.0}, {"WP_ACC", "m/s^2"}},
           start.max_acceleration_m_s2,
           any,
           "it brakes by no more, and the flight by up to mission.max_acceleration_m_s2",
           true},
          {{{"PSC_JERK_XY", "m/s^3"}, {"PSC_JERK_NE", "m/s^3"}, {"PSC_NE_JERK", "m/s^3"}},
           least_m_s3,
           any,
           "it begins to brake so slowly that it flies past where it is to stop"}};
}

std::string unsaid(const WantedLimit& limit) {
  return "the autopilot says none of " +
         listed(limit.names, [](const LimitName& one) { return std::string{one.name}; });
}

/// What is wrong with this value, as one sentence; empty where nothing is.
std::string beyond(const WantedLimit& limit, const LimitName& called, double value) {
  // A parameter is a `float`, and a person sets it to the six digits that he read here.
  constexpr double rounding = 1e-5;
  const double least = called.per_si * limit.least;
  const double most = called.per_si * limit.most;
  if (value >= least * (1.0 - rounding) && value <= most * (1.0 + rounding)) {
    return "";
  }
  std::array<char, 240> text{};
  std::snprintf(text.data(), text.size(), "%s is %g %s: %s; set it to %g", called.name, value,
                called.unit, limit.otherwise, value > most ? most : least);
  return text.data();
}

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
      return ask_limit(now);
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

/// Parameters have a protocol of their own, without refusals: a name that the autopilot does not
/// know is not answered, so that all are asked for at once.
void OffboardControl::ask_limit(Duration now) {
  if (now < next_limit_try_) {
    return;
  }
  const WantedLimit wanted = wanted_limits(start_).at(limit_);
  if (limit_tries_ == most_limit_tries && wanted.is_needed) {
    fail(unsaid(wanted) + ", and is not flown: " + wanted.otherwise +
         "; fly Copter 4.1 to 4.7, over a line that carries parameters");
    return;
  }
  if (limit_tries_ == most_limit_tries) {
    telemetry_.tell(unsaid(wanted) + "; set beyond its limit, " + wanted.otherwise);
    next_limit(now);
    return;
  }
  ++limit_tries_;
  next_limit_try_ = now + limit_answer_within;
  for (const LimitName& one : wanted.names) {
    MavParamRequestRead request;
    request.target_system = telemetry_.system();
    request.target_component = mav::component_autopilot;
    const std::string name = one.name;
    std::copy(name.begin(), name.end(), request.name.begin());
    send(request);
  }
}

void OffboardControl::hear_limit(const MavParamValue& value, Duration now) {
  if (leg_ != Leg::limits) {
    return;
  }
  const WantedLimit wanted = wanted_limits(start_).at(limit_);
  const auto called =
      std::find_if(wanted.names.begin(), wanted.names.end(),
                   [&value](const LimitName& one) { return mavlink_text(value.name) == one.name; });
  if (called == wanted.names.end()) {
    return;
  }
  const std::string wrong = beyond(wanted, *called, static_cast<double>(value.value));
  if (!wrong.empty() && wanted.is_needed) {
    fail(wrong);
    return;
  }
  if (!wrong.empty()) {
    telemetry_.tell(wrong);
  }
  next_limit(now);
}

void OffboardControl::next_limit(Duration now) {
  limit_tries_ = 0;
  next_limit_try_ = now;
  if (++limit_ == wanted_limits(start_).size()) {
    enter(Leg::locating, now);
  }
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
  std::string missing;
  const auto lack = [&missing](bool is_said, const char* what) {
    missing += is_said ? "" : (missing.empty() ? " " : ", ") + std::string{what};
  };
  lack(telemetry_.has_position(), "where it is");
  lack(telemetry_.has_attitude(), "how it is turned");
  lack(on_ground.has_value(), "whether it is on the ground");
  const std::string sentence =
      "the autopilot does not yet say" + (missing.empty() ? " often enough where it is" : missing);
  if (waited(located_within, now)) {
    fail(sentence + "; wait until it is ready to arm");
  } else if (waited(told_to_wait_after, now) && !has_told_to_wait_) {
    has_told_to_wait_ = true;
    telemetry_.tell(sentence + "; it is waited for, 90 s at most");
  }
}

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How a companion computer talks to an autopilot from the first heartbeat to the landing: bytes
/// and commands in, bytes and sentences out. No sockets, no clock.

#include "flyball/flight/vehicle_port.h"
#include "flyball/vehicles/flight_start.h"

#include "vehicles/autopilot_telemetry.h"
#include "vehicles/command_sender.h"
#include "vehicles/setpoint_stream.h"
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// Times are those of the link, and never fall. Every call but the questions may add output and
/// news.
class OffboardControl {
 public:
  explicit OffboardControl(const FlightStart& start) : start_{start} {}

  /// Bytes that arrived.
  void hear(const std::uint8_t* bytes, std::size_t count, Duration now);
  /// Does what time demands: often, at least each 20 ms.
  void advance(Duration now);
  /// A take-off while it lands is not obeyed.
  void obey(const FlightCommand& command, Duration now);
  /// A set-point whose stamp is a time of the link. One that is not finite, also as `float`, is
  /// refused. Nothing while the autopilot does not fly by our set-points.
  void follow(const Setpoint& setpoint);
  /// The flight cannot go on, as this sentence says: a vehicle that is up and ours is landed.
  void give_up(std::string sentence, Duration now);

  /// Bytes to send since the last call.
  [[nodiscard]] std::vector<std::uint8_t> take_output() { return std::exchange(output_, {}); }
  /// Sentences for people since the last call.
  [[nodiscard]] std::vector<std::string> take_news() { return telemetry_.take_news(); }

  /// The autopilot is known, sends what is needed, and stands disarmed at the start.
  [[nodiscard]] bool is_connected() const { return is_connected_; }
  /// One sentence once something was refused, not answered, or taken out of our hands; else empty.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// Whether the vehicle is up, and ours to land.
  [[nodiscard]] bool is_in_charge() const;
  [[nodiscard]] bool is_landing() const { return leg_ == Leg::landing; }
  [[nodiscard]] FlightStatus status(Duration now) const;
  /// Standing, taking off, landing, or no longer ours.
  [[nodiscard]] bool may_touch_ground() const;
  [[nodiscard]] bool is_fresh(Duration now) const { return telemetry_.is_fresh(now); }
  [[nodiscard]] VehicleMotion motion(Duration now) const { return telemetry_.motion(now); }
  [[nodiscard]] std::optional<ReportedBattery> battery(Duration now) const {
    return telemetry_.battery(now);
  }
  [[nodiscard]] bool is_armed() const { return telemetry_.is_armed(); }
  /// "PX4", "ArduPilot". @pre `is_connected()`.
  [[nodiscard]] const char* autopilot_name() const { return to_string(kind()); }

 private:
  enum class Leg : std::uint8_t {
    listening,   ///< For the first heartbeat.
    requesting,  ///< The messages that are needed.
    limits,      ///< Asks ArduPilot for parameters that a flight depends on.
    locating,    ///< Until position, attitude and landed state are there.
    standing,    ///< On the ground, disarmed.
    streaming,   ///< Before PX4 takes the mode.
    switching,   ///< The mode.
    arming,
    climbing,
    flying,
    landing,
    out_of_hand,  ///< Somebody else flies.
  };
  /// PX4 that hovers by GPS in its own simulation is up to .45 m/s fast.
  static constexpr double hovering_m_s = 0.6;

  [[nodiscard]] AutopilotKind kind() const { return **telemetry_.kind(); }
  void enter(Leg leg, Duration now);
  void fail(std::string sentence);
  /// Flyball is another component of the vehicle, as companion computers are.
  template <class Message>
  void send(const Message& message) {
    const std::vector<std::uint8_t> bytes =
        mavlink_bytes(Message::kind, mavlink_payload(message), telemetry_.system(),
                      mav::component_onboard_computer, sequence_++);
    output_.insert(output_.end(), bytes.begin(), bytes.end());
  }
  void send_setpoint(const Setpoint& setpoint, Duration now);
  void ask(MavCommandLong command, std::string what, Duration now);
  void beat(Duration now);

  /// The vehicle's motion; while nobody says where it is, that of the set-points that it flies.
  [[nodiscard]] VehicleMotion present(Duration now) const;
  void step_connection(Duration now);
  void listen(Duration now);
  void request(Duration now);
  void ask_limit(Duration now);
  void hear_limit(const MavParamValue& value, Duration now);
  void next_limit(Duration now);
  void locate(Duration now);
  void step_flight(Duration now);
  void prepare(Duration now);
  void await_mode(Duration now);
  void await_arming(Duration now);
  void climb(Duration now);
  void await_landing(Duration now);
  void take_off(double height_m, Duration now);
  void come_down(Duration now);
  void land(Duration now);
  void watch_hands();
  [[nodiscard]] bool waited(Duration limit, Duration now) const { return now - since_ > limit; }

  FlightStart start_;
  MavlinkReader reader_{kinds_from_autopilot()};
  AutopilotTelemetry telemetry_{};
  CommandSender commands_{};
  SetpointStream stream_{};
  std::vector<std::uint8_t> output_{};
  std::string failure_{};
  Leg leg_{Leg::listening};
  Duration since_{};  ///< When the leg began.
  bool is_connected_{};
  bool has_heard_bytes_{};
  bool has_refused_setpoint_{};
  bool is_landing_granted_{};
  std::size_t requested_{};  ///< How many of the messages.
  std::size_t limit_{};      ///< The parameter that is asked for.
  int limit_tries_{};
  bool has_told_to_wait_{};
  Duration next_limit_try_{};
  std::optional<Duration> next_beat_{};
  double goal_height_m_{};  ///< Of the take-off, in W.
  std::uint8_t sequence_{};
};

}  // namespace flyball

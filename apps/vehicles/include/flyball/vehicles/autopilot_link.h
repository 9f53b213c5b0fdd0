// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A real autopilot, or one in the loop, that flies the vehicle: PX4 or ArduPilot by MAVLink 2.

#include "flyball/flight/vehicle_port.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"
#include "flyball/vehicles/byte_stream.h"
#include "flyball/vehicles/flight_start.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace flyball {

class OffboardControl;  // see apps/vehicles/offboard_control.h

/// What the autopilot reports of its vehicle.
struct ReportedMotion {
  Pose X_WB{Pose::Identity()};
  Vec3 v_WB{Vec3::Zero()};
  Vec3 w_WB_B{Vec3::Zero()};  ///< Angular velocity in B [rad/s].
  Vec3 a_WB{Vec3::Zero()};    ///< From the reported velocities [m/s^2].
  bool rotors_turn{};         ///< It is armed.
  /// No older than .25 s. It goes on at its rates for so long, and stands still afterwards.
  bool is_fresh{};
};

/// Owned and called by one thread. After `connect` mission time begins at 0.
class AutopilotLink {
 public:
  /// @param tell  Called with one sentence for each thing that a person should know: warnings of
  ///              the autopilot, silence, limits that are set unsafely, why a flight cannot go on.
  AutopilotLink(std::unique_ptr<ByteStream> stream, std::function<void(const std::string&)> tell);
  ~AutopilotLink();
  AutopilotLink(const AutopilotLink&) = delete;
  AutopilotLink& operator=(const AutopilotLink&) = delete;

  /// Waits for the autopilot and for what it has to send, up to a minute.
  /// @param stop  Asked often; true ends the wait. May be empty.
  /// @error `unavailable`: what was not heard, not answered or denied; or stopped.
  [[nodiscard]] Status connect(const FlightStart& start, const std::function<bool()>& stop);

  /// Receives, and sends what is due. At least each 20 ms. @pre `connect` succeeded, for this and
  /// all below.
  void step(MissionTime now);
  /// Ready to arm is the autopilot's affair: a refusal is a `failure`. A payload it cannot release.
  void obey(const FlightCommand& command);
  /// Flown while the vehicle is up, from the end of its take-off on. Not finite: refused.
  void follow(const Setpoint& setpoint);

  /// As of the last step.
  [[nodiscard]] ReportedMotion motion() const;
  [[nodiscard]] FlightStatus status() const;
  [[nodiscard]] bool may_touch_ground() const;
  /// One sentence when the flight cannot go on: a command was refused or not answered, or somebody
  /// took over. Empty otherwise.
  [[nodiscard]] std::string failure() const;

  /// Ends a flight early: asks to land, if the vehicle is up and nobody else flies it, without
  /// waiting.
  void begin_landing();
  /// Waits until it stands disarmed, or somebody took over, or it took two minutes. Then Flyball
  /// falls silent.
  /// @param turned  Called often, for whoever has to know that the program lives. May be empty.
  void await_landing(const std::function<bool()>& turned);

 private:
  void exchange(Duration now);

  std::unique_ptr<ByteStream> stream_;
  std::function<void(const std::string&)> tell_;
  std::unique_ptr<OffboardControl> control_;
  Duration now_{};         ///< Since the link was made.
  Duration at_mission_{};  ///< When the mission's time began.
  bool is_broken_{};       ///< The stream said so, and people were told.
  bool has_failed_{};      ///< The flight, and people were told.
  std::vector<std::uint8_t> received_{};
};

}  // namespace flyball

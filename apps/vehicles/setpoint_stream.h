// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The set-points that an autopilot is streamed: those of the flight, moved on between two of them,
/// and the motions that stand in for them.

#include "flyball/runtime/motion/setpoint_motion.h"
#include "flyball/runtime/time.h"

#include "vehicles/autopilot_telemetry.h"
#include <cstdint>
#include <optional>

namespace flyball {

/// In W. Times are those of the link; a set-point's stamp is one of them.
class SetpointStream {
 public:
  enum class Motion : std::uint8_t { none, stop, climb, follow };

  void end();
  /// Brakes from the vehicle's present motion, then stays.
  void stop(const VehicleMotion& vehicle, Duration now);
  /// Straight up from where the vehicle is, to `height_m` in W.
  void climb(const VehicleMotion& vehicle, double height_m, Duration now);
  void follow(const Setpoint& setpoint);

  /// The set-point for now, each 20 ms; empty between, and while nothing is streamed. When the
  /// flight's last one is older than .5 s, the stream stops at the vehicle's place.
  [[nodiscard]] std::optional<Setpoint> due(Duration now, const VehicleMotion& vehicle);
  [[nodiscard]] Motion motion() const { return motion_; }
  /// The last one; empty before the first, and after `end`.
  [[nodiscard]] const std::optional<Setpoint>& sent() const { return sent_; }

 private:
  void start(const VehicleMotion& vehicle, Duration now);
  void move(double dt_s);

  Motion motion_{Motion::none};
  Setpoint reference_{};  ///< Of the stream's own motions.
  Setpoint newest_{};     ///< Of the flight.
  double height_m_{};
  std::optional<Setpoint> sent_{};
  Duration last_{};  ///< When the reference was moved.
  std::optional<Duration> next_{};
};

}  // namespace flyball

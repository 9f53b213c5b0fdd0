// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Who moves the vehicle: the simulator's own flight controller and physics, or an autopilot.

#include "flyball/flight/vehicle_port.h"
#include "flyball/runtime/event_queue.h"
#include "flyball/runtime/result.h"
#include "flyball/sim/airframe.h"
#include "flyball/sim/vehicle.h"
#include "flyball/vehicles/autopilot_link.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace flyball {

/// An interface, because the closed loop around the vehicle does not depend on who flies it.
class Pilot {
 public:
  Pilot() = default;
  virtual ~Pilot() = default;
  Pilot(const Pilot&) = delete;
  Pilot& operator=(const Pilot&) = delete;

  /// Before the flight.
  /// @param stop  Ends a wait early when it answers true; may be empty.
  /// @error `unavailable`: nobody can fly the vehicle.
  virtual Status prepare(const std::function<bool()>& stop) = 0;
  /// Moves the vehicle on by `dt_s` to the present time.
  virtual void step(double dt_s, const Vec3& wind_W) = 0;
  /// Everything but the payload, which hangs on the vehicle.
  virtual void obey(const FlightCommand& command) = 0;
  virtual void follow(const Setpoint& setpoint) = 0;
  [[nodiscard]] virtual FlightStatus status() const = 0;
  /// While it takes off, lands or stands.
  [[nodiscard]] virtual bool may_touch_ground() const = 0;
  /// Whether it is known where the vehicle is.
  [[nodiscard]] virtual bool knows_pose() const = 0;
  /// The battery of the vehicle, computer included, where somebody measures it.
  [[nodiscard]] virtual std::optional<ReportedBattery> battery() const = 0;
  /// One sentence when the flight cannot go on; empty otherwise.
  [[nodiscard]] virtual std::string failure() const = 0;
  /// The flight is over: what is still up comes down. First without waiting, then with; `turned`
  /// is called often then.
  virtual void begin_landing() = 0;
  virtual void await_landing(const std::function<bool()>& turned) = 0;
};

/// All arguments of both outlive the pilot.
[[nodiscard]] std::unique_ptr<Pilot> make_simulated_pilot(Vehicle& vehicle,
                                                          const Airframe& airframe,
                                                          double ground_z_m,
                                                          const EventQueue& queue);
/// @param start  But for where the vehicle stands.
[[nodiscard]] std::unique_ptr<Pilot> make_offboard_pilot(Vehicle& vehicle,
                                                         const Airframe& airframe,
                                                         const FlightStart& start,
                                                         const EventQueue& queue,
                                                         AutopilotLink& autopilot);

}  // namespace flyball

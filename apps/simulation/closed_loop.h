// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Vehicle, sensors, power and battery around the modeled computer, all on one event queue.

#include "flyball/flight/odometry_frame.h"
#include "flyball/flight/perception/localization_nodes.h"
#include "flyball/flight/vehicle_port.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/event_queue.h"
#include "flyball/runtime/executor.h"
#include "flyball/scenario/scenario.h"
#include "flyball/sim/barometer.h"
#include "flyball/sim/battery.h"
#include "flyball/sim/gps.h"
#include "flyball/sim/imu.h"
#include "flyball/sim/rotor_power.h"
#include "flyball/sim/vehicle.h"
#include "flyball/sim/wind.h"

#include "simulation/camera_drivers.h"
#include "simulation/mission_link.h"
#include "simulation/pilot.h"
#include "simulation/simulated_things.h"
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace flyball {

/// What the flight came to so far.
struct FlightLog {
  double energy_rotor_j{};
  double energy_computer_j{};
  double distance_m{};
  double max_speed_m_s{};
  double hover_time_s{};
  double airborne_s{};
  double rotor_w{};     ///< Now.
  double computer_w{};  ///< Now.
  double measured_s{};  ///< In the air, with a rotor power that was measured.
  std::optional<ReportedBattery> reported_battery{};  ///< The last one.
};

class ClosedLoop {
 public:
  /// All arguments outlive the loop.
  /// @param autopilot  That flies the vehicle; null: the simulator does.
  ClosedLoop(MissionLink& link,
             const Scenario& scenario,
             const SimulatedThings& things,
             Executor& executor,
             EventQueue& queue,
             const VehicleTopics& topics,
             std::shared_ptr<Localizer> localizer,
             AutopilotLink* autopilot = nullptr);

  /// Calls `listener` with the truth at each navigation sample, before it is published.
  void on_navigation(std::function<void(const TruePose&)> listener) {
    on_navigation_ = std::move(listener);
  }
  /// Calls `listener` with the seconds since the last call when power and charge have moved on.
  void on_energy(std::function<void(double)> listener) { on_energy_ = std::move(listener); }

  /// Asks `meter` for the computer's power, where it is not modeled; 0 W: it has no meter, and the
  /// platform's model is asked as ever.
  void measure_computer(std::function<Watts()> meter) { computer_meter_ = std::move(meter); }

  [[nodiscard]] CameraDrivers& cameras() { return cameras_; }

  /// Before `start`: whoever flies the vehicle is there, and the vehicle is where he says.
  /// @error As `Pilot::prepare`.
  [[nodiscard]] Status prepare(const std::function<bool()>& stop) { return pilot_->prepare(stop); }
  /// Before `start`: set-points are carried over from the localizer's world into the frame in which
  /// the vehicle is flown. While the localizer is lost, nothing is learned from its guesses.
  void hear_localizer(Topic<PoseEstimate> pose, std::optional<Topic<LocalizationStatus>> status);
  /// Puts physics and sensors on the queue and listens to the commands.
  void start();
  [[nodiscard]] const FlightLog& log() const { return log_; }
  [[nodiscard]] const Battery& battery() const { return battery_; }
  [[nodiscard]] const Vehicle& vehicle() const { return vehicle_; }
  [[nodiscard]] bool is_airborne() const { return pilot_->status().airborne; }
  /// While it takes off, lands or stands.
  [[nodiscard]] bool may_touch_ground() const { return pilot_->may_touch_ground(); }
  /// Brakes to a hover without the companion computer; its next set-point takes over again.
  void emergency_hold() { pilot_->obey({FlightCommand::Kind::hold, 0.0}); }
  /// The mission is over, and a real vehicle may not be left in the air: first without waiting, so
  /// that the nodes can be stopped meanwhile, then until it stands.
  void begin_landing() { pilot_->begin_landing(); }
  void await_landing(const std::function<bool()>& turned) { pilot_->await_landing(turned); }

 private:
  [[nodiscard]] Watts computer_power(double busy_cores) const;
  /// Of the GPU and of the link to an edge computer, on average since the last call `dt_s` ago.
  [[nodiscard]] Watts device_power(double dt_s);
  /// Of the rotors now, and on from `dt_s` ago.
  [[nodiscard]] double rotor_power_w(const std::optional<ReportedBattery>& battery, double dt_s);
  void physics_step();
  void watch_pilot();
  void energy_step();
  void publish_navigation();
  void publish_pose();
  void start_localizer();
  void obey(const FlightCommand& command);

  MissionLink& link_;
  const Scenario& scenario_;
  const Airframe& airframe_;
  Executor& executor_;
  EventQueue& queue_;
  VehicleTopics topics_;
  std::shared_ptr<Localizer> localizer_;  ///< Told where it starts. Owners: see MissionKernels.
  Vehicle vehicle_;
  std::unique_ptr<Pilot> pilot_;
  RegressionPower regression_;
  Battery battery_;
  CameraDrivers cameras_;
  Gps gps_;
  Barometer barometer_;
  Imu imu_;
  Wind wind_;
  std::function<void(const TruePose&)> on_navigation_{};
  std::function<void(double)> on_energy_{};
  std::function<Watts()> computer_meter_{};
  FlightLog log_{};
  double last_busy_core_s_{};
  DeviceUse last_use_{};
  std::uint64_t navigation_count_{};
  bool pilot_has_failed_{};
  std::optional<OdometryFrame> frame_{};  ///< Empty: that is the localizer's world.
  bool is_lost_{};                        ///< The localizer.
};

}  // namespace flyball

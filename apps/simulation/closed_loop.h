// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Vehicle, sensors, power and battery around the modeled computer, all on one event queue.

#include "flyball/runtime/virtual_executor.h"
#include "flyball/scenario/scenario.h"
#include "flyball/sim/barometer.h"
#include "flyball/sim/battery.h"
#include "flyball/sim/depth_camera.h"
#include "flyball/sim/flight_controller.h"
#include "flyball/sim/gps.h"
#include "flyball/sim/imu.h"
#include "flyball/sim/rotor_power.h"
#include "flyball/sim/vehicle.h"
#include "flyball/sim/wind.h"

#include "flight/mission_context.h"
#include "simulation/simulated_things.h"
#include <memory>

namespace flyball {

/// What the flight came to so far.
struct FlightLog {
  double energy_rotor_j{};
  double energy_computer_j{};
  double distance_m{};
  double max_speed_m_s{};
  double hover_time_s{};
  double airborne_s{};
  double min_clearance_m{};
  double rotor_w{};     ///< Now.
  double computer_w{};  ///< Now.
};

class ClosedLoop {
 public:
  /// All arguments outlive the loop.
  ClosedLoop(MissionContext& context,
             const Scenario& scenario,
             const SimulatedThings& things,
             VirtualExecutor& executor,
             EventQueue& queue,
             const VehicleTopics& topics);

  /// Puts physics, sensors and checks on the queue and listens to the commands.
  void start();
  [[nodiscard]] const FlightLog& log() const { return log_; }
  [[nodiscard]] const Battery& battery() const { return battery_; }
  [[nodiscard]] const Vehicle& vehicle() const { return vehicle_; }
  /// Brakes to a hover without the companion computer; its next set-point takes over again.
  void emergency_hold() { controller_.hold(vehicle_.state()); }

 private:
  void physics_step();
  void energy_step();
  void check_step();
  void publish_navigation();
  void publish_depth();
  void start_localizer();
  void publish_colour();
  void obey(const FlightCommand& command);
  [[nodiscard]] bool is_airborne() const;

  MissionContext& context_;
  const Scenario& scenario_;
  const Airframe& airframe_;
  const ColourCameras& cameras_;
  VirtualExecutor& executor_;
  EventQueue& queue_;
  VehicleTopics topics_;
  Vehicle vehicle_;
  FlightController controller_;
  RegressionPower regression_;
  Battery battery_;
  DepthCamera camera_;
  Gps gps_;
  Barometer barometer_;
  Imu imu_;
  Clearance clearance_;
  std::vector<Mover> movers_;
  std::vector<Person> people_;
  Wind wind_;
  FlightLog log_{};
  double last_busy_core_s_{};
  std::uint64_t navigation_count_{};
  std::uint64_t frame_count_{};
  std::uint64_t colour_count_{};
};

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What every mission begins and ends with: take-off, the wait until it is done, landing.

#include "flyball/flight/mission_topics.h"
#include "flyball/flight/vehicle_port.h"

namespace flyball {

/// Take-off and landing are manoeuvres of the flight controller, upright, inside cylinders that the
/// site declares clear. The mission's node owns one of these; it publishes the mission's phase.
class Legs {
 public:
  Legs(const VehicleTopics& vehicle, const MissionTopics& mission)
      : vehicle_{vehicle}, mission_{mission} {}

  /// What the node that calls the members below has to declare.
  void declare(NodeSpec& spec) const;
  void take_off(JobContext& job, double height_m);
  void land(JobContext& job);
  void release_payload(JobContext& job) const;
  /// A phase that is no manoeuvre.
  void enter(JobContext& job, MissionPhase phase) const { job.publish(mission_.state, {phase}); }
  /// Whether the last take-off or landing has ended. A status that was sent before the flight
  /// controller heard of it does not count.
  [[nodiscard]] bool are_done(JobContext& job) const;

 private:
  void command(JobContext& job, MissionPhase phase, const FlightCommand& command);

  VehicleTopics vehicle_;
  MissionTopics mission_;
  MissionTime settled_{};
};

}  // namespace flyball

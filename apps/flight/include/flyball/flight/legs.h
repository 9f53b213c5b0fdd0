// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What every mission begins and ends with: take-off, the wait until it is done, landing.

#include "flyball/flight/mission_context.h"

namespace flyball {

/// Take-off and landing are manoeuvres of the flight controller, upright, inside cylinders that the
/// brief declares clear. They hold the mission's phase, too.
class Legs {
 public:
  /// `context` outlives the legs.
  Legs(MissionContext& context, const VehicleTopics& vehicle)
      : context_{&context}, vehicle_{vehicle} {}

  /// What the node that calls the members below has to declare.
  void declare(NodeSpec& spec) const;
  void take_off(JobContext& job, double height_m);
  void land(JobContext& job);
  void release_payload(JobContext& job);
  /// Whether the last take-off or landing has ended. A status that was sent before the flight
  /// controller heard of it does not count.
  [[nodiscard]] bool are_done(JobContext& job) const;

 private:
  void command(JobContext& job, MissionPhase phase, const FlightCommand& command);

  MissionContext* context_;
  VehicleTopics vehicle_;
  MissionTime settled_{};
};

/// Tells the mapper of the cylinder over a place on the ground where a vehicle may take off and
/// land: 1 m in radius, 2.5 m high.
void declare_clear_over(Mapper& mapper, const Vec3& ground_W);

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The topics between the companion computer and the vehicle: all that what flies knows of it.

#include "flyball/flight/perception/view.h"
#include "flyball/runtime/colour_frame.h"
#include "flyball/runtime/gimbal.h"
#include "flyball/runtime/graph.h"
#include "flyball/runtime/imu.h"
#include "flyball/runtime/messages.h"

#include <optional>

namespace flyball {

struct FlightCommand {
  enum class Kind : std::uint8_t { take_off, land, hold, release_payload };
  Kind kind{Kind::hold};
  double height_m{};
};

/// What the flight controller reports.
struct FlightStatus {
  bool airborne{};
  bool manoeuvre_done{};  ///< Take-off or landing.
};

struct VehicleTopics {
  Topic<DepthFrame> depth;
  Topic<NavigationSample> navigation;
  Topic<FlightStatus> status;
  Topic<Setpoint> setpoint;
  Topic<FlightCommand> command;
  Topic<ColourFrame> colour{};         ///< These four only where the workload looks for people.
  Topic<ColourFrame> colour_buffer{};  ///< The same frames, kept until they are taken.
  /// Published before each picture: the depth image that was captured last when the picture was.
  Topic<DepthFrame> colour_depth{};
  Topic<GimbalAngles> gimbal{};  ///< Commanded angles.
  /// Of the RGB-D camera, for a localizer that takes images.
  std::optional<Topic<View>> view{};
  /// A queue of inertial samples, for a localizer that takes them.
  std::optional<Topic<ImuSample>> imu{};
  /// Of a simulator, before each navigation sample, where the localizer asks for it.
  std::optional<Topic<TruePose>> true_pose{};
};

/// What a vehicle serves beside depth camera, navigation and flight controller.
struct VehicleExtras {
  bool colour_camera{};
  bool rgbd_camera{};
  bool imu{};
  bool true_pose{};
};

/// Adds the topics that the vehicle serves.
[[nodiscard]] VehicleTopics add_vehicle_topics(Graph& graph, const VehicleExtras& extras = {});

}  // namespace flyball

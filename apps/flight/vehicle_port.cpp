// SPDX-License-Identifier: BSD-3-Clause
// tested-in: brief
#include "flyball/flight/vehicle_port.h"

namespace flyball {

VehicleTopics add_vehicle_topics(Graph& graph, const VehicleExtras& extras) {
  VehicleTopics topics;
  topics.depth = graph.topic<DepthFrame>("depth");
  topics.navigation = graph.topic<NavigationSample>("navigation");
  topics.status = graph.topic<FlightStatus>("flight_status");
  topics.setpoint = graph.topic<Setpoint>("setpoint");
  topics.command = graph.topic<FlightCommand>("flight_command", 8);
  if (extras.true_pose) {
    topics.true_pose = graph.topic<TruePose>("true_pose");
  }
  if (extras.rgbd_camera) {
    topics.view = graph.topic<View>("view");
  }
  if (extras.imu) {
    constexpr std::size_t longest_frame = 4096;  // Samples: 20 s at 200 Hz.
    topics.imu = graph.topic<ImuSample>("imu", longest_frame);
  }
  if (extras.colour_camera) {
    constexpr std::size_t longest_detection = 128;  // Frames: 6 s of a 20 Hz camera.
    topics.colour = graph.topic<ColourFrame>("colour");
    topics.colour_buffer = graph.topic<ColourFrame>("colour_buffer", longest_detection);
    topics.colour_depth = graph.topic<DepthFrame>("colour_depth");
    topics.gimbal = graph.topic<GimbalAngles>("gimbal_command");
  }
  return topics;
}

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/mission_context.h"

#include <algorithm>
#include <utility>

namespace flyball {

MissionContext::MissionContext(FlightSettings settings_in,
                               const Platform& platform_in,
                               Recorder& recorder_in,
                               MissionBrief brief_in,
                               MissionEquipment equipment)
    : settings{std::move(settings_in)},
      platform{platform_in},
      brief{std::move(brief_in)},
      body{equipment.body},
      knobs{std::move(equipment.knobs)},
      computer{static_cast<int>(knobs.value("cpu.cores")), Hertz{knobs.value("cpu.frequency_hz")}},
      kernels{std::move(equipment.kernels)},
      recorder{recorder_in},
      has_rgb_camera{equipment.has_rgb_camera} {}

double MissionContext::speed_limit_m_s(const Vec3& p_W) const {
  double limit = knobs.value("mission.max_speed_m_s");
  for (const auto& zone : brief.zones) {
    if (zone.box_W.contains(p_W)) {
      limit = std::min(limit, zone.max_speed_m_s);
    }
  }
  return limit;
}

Cylinder MissionContext::body_at(double speed_m_s) const {
  const double tube_m = tube.radius_m(speed_m_s);
  return {body.radius_m + tube_m, body.half_height_m + tube_m + tube.extra_height_m};
}

void MissionContext::event(MissionTime at, const std::string& what) {
  recorder.record(at, "event", {{"what", what}});
}

void MissionContext::finish(MissionTime at, MissionStatus status, MissionFailure failure) {
  if (is_over()) {
    return;
  }
  status_ = status;
  failure_ = failure;
  event(at, std::string{"end: "} + to_string(status) +
                (failure == MissionFailure::none ? "" : std::string{" by "} + to_string(failure)));
}

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
  if (extras.colour_camera) {
    constexpr std::size_t longest_detection = 128;  // Frames: 6 s of a 20 Hz camera.
    topics.colour = graph.topic<ColourFrame>("colour");
    topics.colour_buffer = graph.topic<ColourFrame>("colour_buffer", longest_detection);
    topics.gimbal = graph.topic<GimbalAngles>("gimbal_command");
  }
  return topics;
}

}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/camera_rate.h"

#include "flyball/flight/perception/rate_limit.h"

#include <memory>
#include <string>
#include <utility>

namespace flyball {
namespace {

constexpr int camera_priority = 95;  // It takes no time, and nothing happens without its frames.

MissionTime captured(const DepthFrame& frame) {
  return frame.captured;
}
MissionTime captured(const View& view) {
  return view.depth.captured;
}

template <class Frame>
Topic<Frame> limited(Graph& graph,
                     const std::string& name,
                     Topic<Frame> frames,
                     Topic<KnobsInForce> knobs_topic) {
  const auto passed = graph.topic<Frame>(name + "_frames");
  NodeSpec spec;
  spec.name = name;
  spec.trigger = OnMessage{frames.index};
  spec.priority = camera_priority;
  spec.reads = {knobs_topic.index};
  spec.writes = {passed.index};
  auto limit = std::make_shared<RateLimit>();  // Owner: this node alone.
  graph.node(std::move(spec), [=](JobContext& job) {
    const auto frame = job.latest(frames);
    const auto knobs = job.latest(knobs_topic);
    // Before the governor has spoken every frame is used.
    if (frame && (!knobs || limit->passes(captured(*frame), knobs->value("camera.rate_hz")))) {
      job.publish(passed, *frame);
    }
    return Work{};
  });
  return passed;
}

}  // namespace

FlightParts with_camera_rate(Graph& graph, const FlightParts& parts) {
  FlightParts slower = parts;
  if (!parts.brief->settings.knobs.camera_rate) {
    return slower;
  }
  slower.vehicle.depth = limited(graph, "camera", parts.vehicle.depth, parts.mission.knobs);
  if (parts.vehicle.view) {
    slower.vehicle.view = limited(graph, "camera_view", *parts.vehicle.view, parts.mission.knobs);
  }
  return slower;
}

}  // namespace flyball

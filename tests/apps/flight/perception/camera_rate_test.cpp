// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/camera_rate.h"

#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/runtime/modeled/virtual_executor.h"

#include "mission_rig.h"
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A 20 Hz camera for two seconds; after the first one the knobs `later` are in force.
class CameraRate : public testing::Test {
 protected:
  static Scenario with_rates() {
    Scenario scenario = kit::MissionRig::one_core();
    scenario.knobs.camera_rate = scenario.knobs.localizer_rate = true;
    return scenario;
  }

  /// @return  When frames came out of a topic.
  std::vector<MissionTime> passed(Graph& graph, const FlightParts& parts, Topic<DepthFrame> topic) {
    std::vector<MissionTime> times;
    EventQueue queue;
    VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
    executor.subscribe<DepthFrame>(
        topic, [&times](const DepthFrame& frame) { times.push_back(frame.captured); });
    executor.on_job([&](const JobRecord& job) {
      const std::string& node = graph.nodes()[static_cast<std::size_t>(job.node)].spec.name;
      slam_frames += node == "slam_load" && job.work.count("pixels") > 0.0 ? 1 : 0;
    });
    queue.every(MissionTime{50ms}, 50ms, EventOrder::sensor, [&] {
      if (queue.now() == MissionTime{1s}) {
        executor.publish(parts.mission.knobs, *rig.knobs);
      }
      executor.publish(parts.vehicle.depth, DepthFrame{queue.now(), 0, 1, {}, {}});
    });
    queue.run([&] { return queue.now() >= MissionTime{2s}; });
    return times;
  }

  static long until(const std::vector<MissionTime>& times, Duration end) {
    return std::count_if(times.begin(), times.end(),
                         [end](MissionTime t) { return t < MissionTime{end}; });
  }

  kit::GridMap map{kit::corridor(10.0)};
  kit::MissionRig rig{map, with_rates()};
  int slam_frames{};
};

TEST_F(CameraRate, leaves_out_frames_from_the_moment_on_at_which_the_knob_is_turned) {
  Graph graph{"camera"};
  const FlightParts parts = rig.parts(graph);
  const FlightParts slower = with_camera_rate(graph, parts);
  EXPECT_NE(slower.vehicle.depth.index, parts.vehicle.depth.index);
  ASSERT_TRUE(rig.set("camera.rate_hz", 5.0));
  const auto times = passed(graph, parts, slower.vehicle.depth);
  EXPECT_EQ(until(times, 1s), 19) << "every frame";
  const auto count = static_cast<long>(times.size()) - until(times, 1s);
  EXPECT_GE(count, 4);
  EXPECT_LE(count, 6);
  for (std::size_t i = 20; i < times.size(); ++i) {
    EXPECT_EQ(times[i] - times[i - 1], 200ms) << i;
  }
}

TEST_F(CameraRate, adds_nothing_to_a_mission_without_that_knob) {
  rig.brief->settings.knobs.camera_rate = false;
  Graph graph{"camera"};
  const FlightParts parts = rig.parts(graph);
  const std::size_t nodes = graph.nodes().size();
  EXPECT_EQ(with_camera_rate(graph, parts).vehicle.depth.index, parts.vehicle.depth.index);
  EXPECT_EQ(graph.nodes().size(), nodes);
}

TEST_F(CameraRate, the_localizers_rate_counts_among_the_frames_that_are_used) {
  Graph graph{"camera"};
  rig.kernels.point_cloud = Plugins{}.make<PointCloudBuilder>("depth_to_points");
  const FlightParts parts = rig.parts(graph);
  (void)add_perception(graph, parts);
  ASSERT_TRUE(rig.set("localizer.rate_hz", 5.0));
  (void)passed(graph, parts, parts.vehicle.depth);
  EXPECT_GE(slam_frames, 19 + 4);
  EXPECT_LE(slam_frames, 20 + 6);
}

}  // namespace
}  // namespace flyball

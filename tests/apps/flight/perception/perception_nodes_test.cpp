// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/perception_nodes.h"

#include "flyball/flight/perception/pose_history.h"
#include "flyball/runtime/modeled/virtual_executor.h"

#include "grid_map.h"
#include "mission_rig.h"
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

PoseEstimate pose_at(Duration t, double x_m) {
  PoseEstimate pose;
  pose.stamp = MissionTime{t};
  pose.X_WB.translation() = Vec3{x_m, 0.0, 1.0};
  return pose;
}

TEST(PoseHistory, interpolates_between_two_poses) {
  PoseHistory history;
  history.add(pose_at(100ms, 1.0));
  history.add(pose_at(200ms, 3.0));
  EXPECT_NEAR(history.at(MissionTime{150ms})->X_WB.translation().x(), 2.0, 1e-12);
  EXPECT_NEAR(history.at(MissionTime{100ms})->X_WB.translation().x(), 1.0, 1e-12);
}

TEST(PoseHistory, answers_nothing_for_a_time_without_poses) {
  PoseHistory history;
  EXPECT_FALSE(history.at(MissionTime{1s}).has_value());
  history.add(pose_at(1s, 1.0));
  history.add(pose_at(2s, 2.0));
  history.add(pose_at(2100ms, 3.0));
  EXPECT_NEAR(history.at(MissionTime{800ms})->X_WB.translation().x(), 1.0, 1e-12);
  EXPECT_FALSE(history.at(MissionTime{700ms}).has_value());
  EXPECT_FALSE(history.at(MissionTime{1500ms}).has_value()) << "between two that are far apart";
  EXPECT_NEAR(history.at(MissionTime{2200ms})->X_WB.translation().x(), 3.0, 1e-12);
  EXPECT_FALSE(history.at(MissionTime{2400ms}).has_value()) << "nothing came for too long";
}

TEST(PoseHistory, keeps_three_seconds) {
  PoseHistory history;
  history.add(pose_at(1s, 1.0));
  history.add(pose_at(10s, 2.0));
  EXPECT_FALSE(history.at(MissionTime{1s}).has_value());
}

TEST(PoseHistory, begins_anew_when_stamps_go_back) {
  PoseHistory history;
  history.add(pose_at(10s, 1.0));
  history.add(pose_at(2s, 2.0));
  EXPECT_FALSE(history.at(MissionTime{10s}).has_value());
  EXPECT_NEAR(history.at(MissionTime{2s})->X_WB.translation().x(), 2.0, 1e-12);
}

TEST(CameraPose, looks_along_the_heading_and_stays_level) {
  Pose X_WB = Pose::Identity();
  X_WB.translation() = Vec3{1.0, 2.0, 3.0};
  X_WB.linear() = (Eigen::AngleAxisd{1.0, Vec3::UnitZ()} * Eigen::AngleAxisd{0.4, Vec3::UnitY()} *
                   Eigen::AngleAxisd{-0.3, Vec3::UnitX()})
                      .toRotationMatrix();
  const Pose X_WC = camera_pose(X_WB, {});
  const Vec3 ahead = X_WC.linear() * Vec3::UnitZ();
  EXPECT_NEAR(ahead.z(), 0.0, 1e-12);
  EXPECT_NEAR(yaw_of(ahead), yaw_of(X_WB.linear().col(0)), 1e-12);
  EXPECT_NEAR((X_WC.linear() * Vec3::UnitY()).z(), -1.0, 1e-12);  // y of the image points down.
  EXPECT_EQ(X_WC.translation(), X_WB.translation());
}

TEST(CameraPose, is_mounted_where_the_scenario_says) {
  Pose X_WB = Pose::Identity();
  X_WB.linear() = Eigen::AngleAxisd{1.5707963267948966, Vec3::UnitZ()}.toRotationMatrix();
  DepthCameraSpec mount;
  mount.forward_m = 0.2;
  mount.up_m = -0.1;
  mount.pitch_down_rad = 0.5;
  const Pose X_WC = camera_pose(X_WB, mount);
  EXPECT_TRUE(X_WC.translation().isApprox(Vec3{0.0, 0.2, -0.1}));
  const Vec3 ahead = X_WC.linear() * Vec3::UnitZ();
  EXPECT_NEAR(ahead.z(), -std::sin(0.5), 1e-12);
  EXPECT_NEAR(ahead.y(), std::cos(0.5), 1e-12);
}

/// Remembers what it is told.
class ToldMapper final : public kit::GridMapper {
 public:
  using GridMapper::GridMapper;
  void declare_clear(const Vec3& centre_W, const Cylinder&) override {
    clear_W.push_back(centre_W);
  }
  void doubt_obstacles(const Vec3& p_W, double radius_m) override {
    doubted_W.push_back(p_W);
    doubted_m.push_back(radius_m);
  }

  std::vector<Vec3> clear_W{};
  std::vector<Vec3> doubted_W{};
  std::vector<double> doubted_m{};
};

TEST(Map, tells_its_mapper_what_is_clear_and_what_is_in_doubt) {
  const kit::GridMap map = kit::corridor(10.0);
  const auto mapper = std::make_shared<ToldMapper>(map);
  kit::MissionRig rig{map};
  rig.kernels.mapper = mapper;
  Graph graph{"perception"};
  const PerceptionTopics topics = add_perception(graph, rig.parts(graph));
  EventQueue queue;
  VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
  const Vec3 here_W{1.0, 2.0, 3.0};
  const Vec3 there_W{4.0, 5.0, 6.0};
  executor.publish(topics.map_hints, MapHint{ClearSpace{here_W, {0.3, 0.1}}});
  executor.publish(topics.map_hints, MapHint{DoubtedPlace{there_W, 12.0}});
  executor.publish(topics.cloud, PointCloudFrame{});
  queue.run([&] { return queue.now() >= MissionTime{1s}; });
  EXPECT_EQ(mapper->clear_W, std::vector<Vec3>{here_W});
  EXPECT_EQ(mapper->doubted_W, std::vector<Vec3>{there_W});
  EXPECT_EQ(mapper->doubted_m, std::vector<double>{12.0});
}

TEST(Map, cuts_the_range_to_what_its_mapper_takes_in_small_cells_and_says_so) {
  const kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  rig.kernels.mapper = rig.scenario.plugins.make<Mapper>("octomap");
  ASSERT_TRUE(rig.set("map.resolution_m", 0.06) && rig.set("map.range_m", 20.0));
  Graph graph{"perception"};
  const FlightParts parts = rig.parts(graph);
  const PerceptionTopics topics = add_perception(graph, parts);
  EventQueue queue;
  VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
  std::vector<MapRevision> revisions;
  executor.subscribe<MapRevision>(
      topics.map, [&](const MapRevision& revision) { revisions.push_back(revision); });
  executor.publish(parts.mission.knobs, *rig.knobs);
  executor.publish(topics.localization.poses, pose_at(0ms, 0.0));
  executor.publish(topics.cloud, PointCloudFrame{});
  queue.run([&] { return queue.now() >= MissionTime{1s}; });
  ASSERT_EQ(revisions.size(), 1U);
  EXPECT_NEAR(revisions[0].range_m, 15.0, 1e-9);
  EXPECT_NEAR(revisions[0].longest_range_m, 15.0, 1e-9);
}

TEST(Localize, publishes_no_pose_before_anything_tells_where_the_vehicle_is) {
  const kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  rig.kernels.localizer = rig.scenario.plugins.make<Localizer>("truth");
  Graph graph{"localization"};
  VehicleExtras extras;
  extras.true_pose = true;
  const FlightParts parts = rig.parts(graph, extras);
  const LocalizationTopics topics = add_localization(graph, parts);
  MemoryRecorder trace;
  add_record(graph, parts.mission, trace);
  EventQueue queue;
  VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
  std::vector<PoseEstimate> poses;
  executor.subscribe<PoseEstimate>(topics.pose,
                                   [&](const PoseEstimate& pose) { poses.push_back(pose); });
  const auto sample_at = [&](Duration t) {
    NavigationSample sample;
    sample.stamp = MissionTime{t};
    executor.publish(parts.vehicle.navigation, sample);
    queue.run([&] { return queue.now() >= MissionTime{t}; });
  };
  sample_at(1s);
  sample_at(2s);
  EXPECT_TRUE(poses.empty());
  TruePose truth;
  truth.X_WB.translation() = Vec3{1, 2, 3};
  executor.publish(*parts.vehicle.true_pose, truth);
  sample_at(3s);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses.front().X_WB.translation(), (Vec3{1, 2, 3}));
  std::vector<std::string> events;
  for (const MemoryRecorder::Row& row : trace.rows()) {
    events.push_back(std::get<std::string>(row.fields.front().value));
  }
  EXPECT_EQ(events, (std::vector<std::string>{"waiting for a first position", "position known"}));
}

}  // namespace
}  // namespace flyball

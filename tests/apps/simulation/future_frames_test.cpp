// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "simulation/future_frames.h"

#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/simulation/mission.h"

#include "scenario/kernel_choice.h"
#include "short_delivery.h"
#include "simulation/closed_loop.h"
#include "simulation/mission_setup.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double top_hz = 2035.2e6;
const std::vector<MapSetting> asked{
    {0.15, 7.0, top_hz}, {0.15, 7.0, 0.5 * top_hz}, {0.15, 3.5, top_hz}, {0.60, 7.0, top_hz}};

/// Blocks between start and goal; nobody flies.
struct Ground {
  Ground() : setup{made()}, flown{scenario()}, bench{workbench_of(flown, setup)} {
    navigator.position_W = start_W();
    navigator.goal_W = setup.things.world.goal_W + Vec3{0.0, 0.0, 1.5};
  }
  /// What policies would be told here.
  FutureFrames frames() const {
    return {std::make_shared<const Brief>(bench.brief), flown.plugins, setup.things.world,
            *setup.platform, asked};
  }
  static MissionSetup made() {
    auto setup = set_up(scenario());
    FLYBALL_ASSERT(setup.ok(), "%s", setup.error().message.c_str());
    return std::move(*setup);
  }
  static Scenario scenario() {
    Scenario scenario = kit::short_delivery();
    scenario.world.generator = "congestion";
    scenario.world.parameters.clear();
    scenario.kernels.mapper = "flyball";
    scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
    return scenario;
  }
  [[nodiscard]] Vec3 start_W() const { return setup.things.world.start_W + Vec3{0.0, 0.0, 1.5}; }

  MissionSetup setup;
  Scenario flown;
  Workbench bench;
  NavigatorState navigator{};
};

TEST(FutureFrames, tells_what_the_frame_takes_that_is_taken_there) {
  Ground ground;
  FutureFrames frames = ground.frames();
  const Foresight& truth = frames.look(ground.navigator, ground.bench.situation());
  ASSERT_TRUE(truth.is_whole(asked.size()));
  EXPECT_EQ(truth.places.front().ahead_m, 0.0);
  EXPECT_EQ(truth.places.back().ahead_m, 60.0);
  // The same by hand: a frame from the start towards the goal.
  const Scenario& scenario = ground.flown;
  const Vec3 ahead_W = ground.navigator.goal_W - ground.start_W();
  Pose X_WB = Pose::Identity();
  X_WB.translation() = ground.start_W();
  X_WB.linear() =
      Eigen::AngleAxisd{std::atan2(ahead_W.y(), ahead_W.x()), Vec3::UnitZ()}.toRotationMatrix();
  const Pose X_WC = camera_pose(X_WB, scenario.camera);
  const DepthCamera camera{ground.setup.things.world, scenario.camera, scenario.seed};
  const DepthFrame frame = camera.frame(X_WC, MissionTime{}, 0);
  Work points;
  const auto cloud = ground.bench.kernels.point_cloud->build(frame, 7.0, points);
  const auto mapper = make_kernel<Mapper>(scenario.plugins, scenario.kernels);
  const auto work = (*mapper)->prepare(cloud.cloud_C.value(), X_WC, {0.15, 7.0});
  ASSERT_TRUE(work.ok());
  const Platform& computer = *ground.setup.platform;
  const double map_s = to_seconds(computer.job_time("octomap", *work, Hertz{top_hz}));
  const double points_s =
      to_seconds(computer.job_time(scenario.kernels.point_cloud, points, Hertz{top_hz}));
  ASSERT_GT(map_s, 0.05);  // So a cloud waits for a frame's time at most.
  EXPECT_NEAR(truth.frame_s[0], points_s + map_s + 1.0 / scenario.camera.rate_hz, 1e-9);
}

TEST(FutureFrames, take_longer_at_lower_clocks_and_less_long_with_less_range_and_larger_cells) {
  Ground ground;
  FutureFrames frames = ground.frames();
  const Foresight& truth = frames.look(ground.navigator, ground.bench.situation());
  for (std::size_t i = 0; i < truth.places.size(); ++i) {
    const double* row = &truth.frame_s[i * asked.size()];
    EXPECT_GT(row[1], 1.5 * row[0]) << i;
    EXPECT_LE(row[2], row[0]) << i;
    EXPECT_LE(row[3], row[0]) << i;
  }
  EXPECT_LT(truth.frame_s[2], truth.frame_s[0]);
  EXPECT_LT(truth.frame_s[3], truth.frame_s[0]);
}

TEST(FutureFrames, are_taken_once_for_each_place_and_leave_no_trace_in_the_map) {
  Ground ground;
  FutureFrames frames = ground.frames();
  const std::vector<double> first_s =
      frames.look(ground.navigator, ground.bench.situation()).frame_s;
  const std::size_t taken = frames.frames_taken();
  EXPECT_LE(taken, 16U);
  EXPECT_EQ(frames.look(ground.navigator, ground.bench.situation()).frame_s, first_s);
  EXPECT_EQ(frames.frames_taken(), taken);
  for (const MapLevel& level : ground.bench.kernels.mapper->contents().levels) {
    EXPECT_EQ(level.known_cells, 0U);
  }
}

// Who asks is told in flight, and flies the same again.
TEST(FutureFrames, reach_a_policy_that_asks_for_them) {
  Scenario scenario = kit::short_delivery(40.0);
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  scenario.mission.max_speed_m_s = 6.0;
  scenario.governor.policy = "reference";
  const MissionRecord told = kit::flown(scenario);
  EXPECT_EQ(told.summary.status, MissionStatus::succeeded);
  EXPECT_EQ(told.summary.policy_faults, 0U);
  EXPECT_EQ(kit::flown(scenario).summary.trace_hash, told.summary.trace_hash);
  scenario.governor.policy = "mission_energy";
  EXPECT_NE(kit::flown(scenario).summary.trace_hash, told.summary.trace_hash);
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
//
// An autopilot and a depth camera that are not the simulator's: its own world is empty ground.
#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/runtime/modeled/virtual_executor.h"
#include "flyball/sim/depth_camera.h"

#include "autopilot/offboard_rig.h"
#include "made_world.h"
#include "short_delivery.h"
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr Duration physics = 2ms;

/// Sees a world that the simulator does not know, from where the stand-in truly is.
class OtherCamera final : public DepthSource {
 public:
  OtherCamera(const World& world,
              const DepthCameraSpec& spec,
              const kit::StandInAutopilot& autopilot)
      : spec_{spec}, camera_{world, spec, 1}, start_W_{world.start_W}, autopilot_{autopilot} {}

  void turn_clock(Duration by) { now_ += by; }
  [[nodiscard]] Pose place_W() const {
    Pose X_WB = autopilot_.truth().X_WB;
    X_WB.translation() += start_W_;
    return X_WB;
  }

  Status await(const std::function<bool()>& /*stop*/) override {
    return is_there ? Status{Done{}} : Status{Error{ErrorCode::unavailable, "no image came"}};
  }
  std::optional<DepthReading> take() override {
    const Duration frame = from_seconds(1.0 / spec_.rate_hz);
    if (now_ - last_ < frame || now_ > silent_from) {
      return std::nullopt;
    }
    last_ = now_;
    const Pose X_WC = camera_pose(place_W(), spec_);
    DepthReading reading{now_, camera_.capture(X_WC, MissionTime{now_}, count_++).depth_m};
    for (float& depth_m : reading.depth_m) {  // As 16 bits carry it.
      depth_m = std::min(65.535F, 1e-3F * std::round(1e3F * depth_m));
    }
    return reading;
  }
  [[nodiscard]] Duration now() const override { return now_; }

  bool is_there{true};
  Duration silent_from{Duration::max()};

 private:
  DepthCameraSpec spec_;
  DepthCamera camera_;
  Vec3 start_W_;
  const kit::StandInAutopilot& autopilot_;
  Duration now_{};
  Duration last_{};
  std::uint64_t count_{};
};

struct RealThings {
  explicit RealThings(const Scenario& scenario)
      : scenario{scenario},
        forest{made_world("forest", 5, {{"goal_distance_m", 30.0}, {"density_1_m2", 0.05}})},
        autopilot{kit::safe_rules(AutopilotKind::px4), kit::shipped_airframe()},
        link{std::make_unique<kit::MemoryStream>(autopilot), [](const std::string&) {}},
        camera{*forest, scenario.camera, autopilot} {
    hooks.autopilot = &link;
    hooks.depth_camera = &camera;
    hooks.executor = [this](const Graph& graph, const Platform& platform, EventQueue& queue,
                            const OperatingPoint& start) {
      queue.every(MissionTime{physics}, physics, EventOrder::physics, [this] {
        autopilot.step(physics);
        camera.turn_clock(physics);
        nearest_m = std::min(
            nearest_m, clearance.distance_m(camera.place_W().translation(), body, 10.0, true));
      });
      return std::make_unique<VirtualExecutor>(graph, platform, queue, start);
    };
  }

  Scenario scenario;
  Result<World> forest;
  Clearance clearance{*forest};
  Cylinder body{kit::shipped_airframe().body()};
  kit::StandInAutopilot autopilot;
  AutopilotLink link;
  OtherCamera camera;
  MissionHooks hooks{};
  double nearest_m{std::numeric_limits<double>::max()};
};

TEST(LiveDepth, obstacles_that_only_the_camera_knows_are_flown_around) {
  Scenario scenario = kit::short_delivery(30.0);
  scenario.governor.policy = "fixed_fine";
  RealThings real{scenario};
  const auto record = fly(real.scenario, real.hooks);
  ASSERT_TRUE(record) << record.error().message;
  EXPECT_EQ(record->summary.status, MissionStatus::succeeded) << to_string(record->summary.failure);
  EXPECT_GT(real.nearest_m, 0.0);
  EXPECT_LT(real.nearest_m, 3.0);  // It did pass between trunks.
  EXPECT_GT(record->summary.maps, 50U);
}

TEST(LiveDepth, a_vehicle_whose_camera_falls_silent_stops_before_what_it_has_not_seen) {
  Scenario scenario = kit::short_delivery(30.0);
  scenario.governor.policy = "fixed_fine";
  scenario.mission.time_limit_s = 60.0;
  RealThings real{scenario};
  real.camera.silent_from = 10s;  // On its way.
  const auto record = fly(real.scenario, real.hooks);
  ASSERT_TRUE(record) << record.error().message;
  EXPECT_EQ(record->summary.status, MissionStatus::failed);
  EXPECT_GT(record->summary.distance_m, 3.0);
  EXPECT_GT(real.nearest_m, 0.0);
  EXPECT_FALSE(real.autopilot.is_armed());  // It was landed.
}

TEST(LiveDepth, a_camera_that_never_sends_is_an_error_before_take_off) {
  RealThings real{kit::short_delivery()};
  real.camera.is_there = false;
  const auto record = fly(real.scenario, real.hooks);
  ASSERT_FALSE(record);
  EXPECT_EQ(record.error().message, "no image came");
  EXPECT_TRUE(real.autopilot.commands().empty());
}

TEST(LiveDepth, refuses_what_one_real_camera_cannot_show) {
  const auto refusal = [](const std::function<void(RealThings&)>& change) {
    RealThings real{kit::short_delivery()};
    change(real);
    const auto record = fly(real.scenario, real.hooks);
    return record ? std::string{"flew"} : record.error().message;
  };
  EXPECT_NE(
      refusal([](RealThings& real) { real.hooks.autopilot = nullptr; }).find("add --autopilot"),
      std::string::npos);
  EXPECT_NE(
      refusal([](RealThings& real) { real.scenario.camera.count = 4; }).find("camera.count = 4"),
      std::string::npos);
  EXPECT_NE(refusal([](RealThings& real) {
              real.scenario.kernels.localizer = "visual_slam";
            }).find("\"visual_slam\" takes images in colour"),
            std::string::npos);
  EXPECT_NE(refusal([](RealThings& real) {
              real.scenario.world.generator = "park";
              real.scenario.world.parameters.clear();
              real.scenario.mission.workload = "aerial_photography";
            }).find("looks for people in colour"),
            std::string::npos);
}

}  // namespace
}  // namespace flyball

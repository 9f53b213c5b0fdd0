// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/legs.h"

#include "flyball/flight/perception/map_hints.h"
#include "flyball/runtime/modeled/virtual_executor.h"

#include "grid_map.h"
#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A node that takes off at once and notes from when on the legs are done.
class Legged : public testing::Test {
 protected:
  Legged() {
    vehicle = add_vehicle_topics(graph);
    mission = add_mission_topics(graph);
    legs.emplace(vehicle, mission);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 100ms};
    legs->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      if (!has_taken_off) {
        has_taken_off = true;
        legs->take_off(job, 1.5);
      } else if (!done_at && legs->are_done(job)) {
        done_at = job.now();
      }
      return Work{};
    });
  }
  void run(bool says_done) {
    VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
    executor.subscribe<FlightCommand>(vehicle.command,
                                      [this](const FlightCommand& what) { command = what; });
    executor.subscribe<MissionState>(mission.state,
                                     [this](const MissionState& state) { phase = state.phase; });
    executor.publish(vehicle.status, FlightStatus{true, says_done});
    queue.run([&] { return queue.now() >= MissionTime{2s}; });
  }
  kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  EventQueue queue;
  Graph graph{"legs"};
  VehicleTopics vehicle;
  MissionTopics mission;
  bool has_taken_off{};
  MissionPhase phase{MissionPhase::wait};
  std::optional<Legs> legs;
  std::optional<FlightCommand> command;
  std::optional<MissionTime> done_at;
};

TEST_F(Legged, tell_the_flight_controller_and_hold_the_phase) {
  run(false);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->kind, FlightCommand::Kind::take_off);
  EXPECT_EQ(command->height_m, 1.5);
  EXPECT_EQ(phase, MissionPhase::take_off);
  EXPECT_FALSE(done_at) << "the flight controller has not said so";
}

TEST_F(Legged, do_not_believe_a_status_from_before_the_command) {
  run(true);
  ASSERT_TRUE(done_at);
  EXPECT_GE(*done_at, MissionTime{600ms});
}

TEST(ClearOver, is_the_cylinder_over_the_place) {
  const ClearSpace clear = clear_over({1.0, 2.0, 0.0}, 0.8, 2.5);
  EXPECT_EQ(clear.centre_W, (Vec3{1.0, 2.0, 1.25}));
  EXPECT_EQ(clear.space.radius_m, 0.8);
  EXPECT_EQ(clear.space.half_height_m, 1.25);
}

}  // namespace
}  // namespace flyball

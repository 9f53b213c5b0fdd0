// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/legs.h"

#include "flyball/runtime/virtual_executor.h"

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
    legs.emplace(*rig.context, vehicle);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 100ms};
    legs->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      if (rig.context->phase == MissionPhase::wait) {
        legs->take_off(job, 1.5);
      } else if (!done_at && legs->are_done(job)) {
        done_at = job.now();
      }
      return Work{};
    });
  }
  void run(bool says_done) {
    VirtualExecutor executor{graph, rig.platform, queue, {1, Hertz{1e9}}};
    executor.subscribe<FlightCommand>(vehicle.command,
                                      [this](const FlightCommand& what) { command = what; });
    executor.publish(vehicle.status, FlightStatus{true, says_done});
    queue.run([&] { return queue.now() >= MissionTime{2s}; });
  }
  kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  EventQueue queue;
  Graph graph{"legs"};
  VehicleTopics vehicle;
  std::optional<Legs> legs;
  std::optional<FlightCommand> command;
  std::optional<MissionTime> done_at;
};

TEST_F(Legged, tell_the_flight_controller_and_hold_the_phase) {
  run(false);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->kind, FlightCommand::Kind::take_off);
  EXPECT_EQ(command->height_m, 1.5);
  EXPECT_EQ(rig.context->phase, MissionPhase::take_off);
  EXPECT_FALSE(done_at) << "the flight controller has not said so";
}

TEST_F(Legged, do_not_believe_a_status_from_before_the_command) {
  run(true);
  ASSERT_TRUE(done_at);
  EXPECT_GE(*done_at, MissionTime{600ms});
}

TEST(DeclareClearOver, tells_the_mapper_of_the_cylinder_over_the_place) {
  const kit::GridMap map = kit::corridor(10.0);
  const kit::MissionRig rig{map};
  declare_clear_over(*rig.mapper, {1.0, 2.0, 0.0});
  ASSERT_EQ(rig.mapper->declared_W.size(), 1U);
  EXPECT_EQ(rig.mapper->declared_W.front(), (Vec3{1.0, 2.0, 1.25}));
}

}  // namespace
}  // namespace flyball

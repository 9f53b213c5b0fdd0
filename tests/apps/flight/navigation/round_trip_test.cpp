// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/round_trip.h"

#include "flyball/runtime/modeled/virtual_executor.h"

#include "grid_map.h"
#include "mission_rig.h"
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A trip whose flight controller is done with every manoeuvre at once and whose navigator has
/// arrived as soon as it hears of a goal.
class ThereAndBack : public testing::Test {
 protected:
  ThereAndBack() {
    const FlightParts parts = rig.parts(graph);
    vehicle = parts.vehicle;
    PerceptionTopics perception;
    perception.map_hints = graph.topic<MapHint>("map_hints", 8);
    const GuidanceTopics guidance{graph.topic<GuidanceCommand>("guidance", 8),
                                  graph.topic<NavigatorState>("navigator")};
    trip.emplace(parts, perception, Guidance{guidance});
    add_navigator(guidance);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 100ms};
    trip->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      const RoundTrip::Landed landed = trip->step(job, {});
      if (landed != RoundTrip::Landed::no) {
        landings.push_back(landed);
      }
      if (landed == RoundTrip::Landed::at_goal && goes_home) {
        trip->go_home();
      }
      return Work{};
    });
  }

  void add_navigator(const GuidanceTopics& guidance) {
    NodeSpec spec;
    spec.name = "follow";
    spec.trigger = OnPeriod{50ms, 50ms};
    spec.reads = {guidance.command.index};
    spec.writes = {guidance.state.index};
    graph.node(std::move(spec), [this, guidance](JobContext& job) {
      while (const auto command = job.take(guidance.command)) {
        state.obeyed = command->number;
        if (const auto* go = std::get_if<GoTo>(&command->what)) {
          goals_W.push_back(go->p_W);
          state.has_arrived = true;
        } else if (std::holds_alternative<HoverAt>(command->what)) {
          state.has_arrived = false;
        }
      }
      job.publish(guidance.state, state);
      return Work{};
    });
  }

  void run() {
    VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
    executor.publish(vehicle.status, FlightStatus{true, true});
    queue.run([&] { return queue.now() >= MissionTime{10s}; });
  }

  static Site site() {
    Site site;
    site.start_W = {1.0, 0.0, 0.0};
    site.goal_W = {9.0, 0.0, 0.0};
    site.cruise_height_m = 1.5;
    return site;
  }

  kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map, kit::MissionRig::one_core(), site()};
  EventQueue queue;
  Graph graph{"trip"};
  VehicleTopics vehicle;
  NavigatorState state;
  std::optional<RoundTrip> trip;
  bool goes_home{true};
  std::vector<RoundTrip::Landed> landings;
  std::vector<Vec3> goals_W;
};

TEST_F(ThereAndBack, lands_at_the_goal_and_then_at_home) {
  run();
  EXPECT_EQ(landings, (std::vector{RoundTrip::Landed::at_goal, RoundTrip::Landed::at_home}));
  ASSERT_EQ(goals_W.size(), 2U);
  EXPECT_EQ(goals_W[0], (Vec3{9.0, 0.0, 1.5}));
  EXPECT_EQ(goals_W[1], (Vec3{1.0, 0.0, 1.5}));
}

TEST_F(ThereAndBack, stands_at_the_goal_until_it_is_told_to_go_home) {
  goes_home = false;
  run();
  EXPECT_EQ(landings, std::vector{RoundTrip::Landed::at_goal});
  EXPECT_EQ(goals_W.size(), 1U);
}

TEST_F(ThereAndBack, counts_no_metre_back_from_a_goal) {
  EXPECT_DOUBLE_EQ(trip->nearer_m({6.0, 0.0, 1.5}), 5.0);
  EXPECT_DOUBLE_EQ(trip->nearer_m({4.0, 0.0, 1.5}), 5.0);
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
//
// Whole missions, held against bands and against each other.

#include "flyball/sim/world.h"

#include "short_delivery.h"
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using kit::says;

TEST(Delivery, flies_there_and_back_and_leaves_the_payload) {
  const MissionRecord record = kit::flown(kit::short_delivery(30.0));
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded);
  EXPECT_GT(record.summary.distance_m, 60.0);
  EXPECT_LT(record.summary.distance_m, 75.0);
  EXPECT_GT(record.summary.battery_start_percent, record.summary.battery_end_percent);
  EXPECT_TRUE(says(record, "delivered"));
}

TEST(Delivery, counts_no_climb_as_its_highest_speed) {
  Scenario scenario = kit::short_delivery(5.0);
  scenario.mission.max_speed_m_s = 0.5;
  const Summary summary = kit::flown(scenario).summary;
  EXPECT_GT(summary.max_speed_m_s, 0.4);
  EXPECT_LT(summary.max_speed_m_s, 0.8) << "it climbs at 1.5 m/s";
}

/// The empty world, with the goal where the vehicle starts.
class OnePlace final : public WorldGenerator {
 public:
  [[nodiscard]] std::vector<ParameterSpec> parameters() const override {
    return empty_->parameters();
  }
  [[nodiscard]] Result<World> make(const Parameters& given, std::uint64_t seed) const override {
    auto world = empty_->make(given, seed);
    world->goal_W = world->start_W;
    return world;
  }

 private:
  std::unique_ptr<WorldGenerator> empty_{Plugins{}.make<WorldGenerator>("empty")};
};

TEST(Delivery, to_where_it_starts_arrives_at_once) {
  Scenario scenario = kit::short_delivery();
  scenario.plugins = Plugins{}.with([](Registry& registry) {
    registry.add<WorldGenerator>("one_place", [] { return std::make_unique<OnePlace>(); });
  });
  scenario.world.generator = "one_place";
  const MissionRecord record = kit::flown(scenario);
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded);
  EXPECT_TRUE(says(record, "delivered"));
  EXPECT_LT(record.summary.mission_time_s, 30.0) << "two take-offs and two landings";
  EXPECT_EQ(record.summary.replans, 0);
}

TEST(Delivery, the_same_scenario_gives_the_same_trace_twice) {
  const Scenario scenario = kit::short_delivery();
  const Summary first = kit::flown(scenario).summary;
  EXPECT_EQ(first.trace_hash, kit::flown(scenario).summary.trace_hash);
  Scenario other = scenario;
  other.seed = 2;
  EXPECT_NE(first.trace_hash, kit::flown(other).summary.trace_hash);
}

TEST(Delivery, a_slower_clock_makes_a_longer_mission) {
  Scenario scenario = kit::short_delivery(40.0);
  scenario.governor.policy = "fixed_fine";
  const Summary fast = kit::flown(scenario).summary;
  scenario.platform.frequency_hz = 806.4e6;
  const Summary slow = kit::flown(scenario).summary;
  ASSERT_EQ(slow.status, MissionStatus::succeeded);
  EXPECT_GT(slow.latency_p50_s, 1.8 * fast.latency_p50_s);
  EXPECT_GT(slow.mission_time_s, 1.1 * fast.mission_time_s);
  EXPECT_GT(slow.energy_rotor_j, fast.energy_rotor_j);
}

TEST(Delivery, a_fine_map_costs_latency_and_speed_in_the_open) {
  Scenario scenario = kit::short_delivery(40.0);
  const Summary coarse = kit::flown(scenario).summary;
  scenario.governor.policy = "fixed_fine";
  const Summary fine = kit::flown(scenario).summary;
  EXPECT_GT(fine.latency_p50_s, 3.0 * coarse.latency_p50_s);
  EXPECT_LT(fine.max_speed_m_s, coarse.max_speed_m_s);
}

TEST(Delivery, no_collision_among_trees_at_either_resolution) {
  for (const char* policy : {"fixed_fine", "two_level"}) {
    Scenario scenario = kit::short_delivery();
    scenario.world.generator = "forest";
    scenario.world.parameters = {{"goal_distance_m", 30.0}};
    scenario.governor.policy = policy;
    scenario.mission.time_limit_s = 300.0;
    const Summary summary = kit::flown(scenario).summary;
    EXPECT_NE(summary.failure, MissionFailure::collision) << policy;
    EXPECT_GT(summary.min_clearance_m, 0.0) << policy;
  }
}

}  // namespace
}  // namespace flyball

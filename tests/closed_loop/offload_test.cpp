// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
// compiled-alone
//
// MAVBench's study: an edge computer plans three times faster while an office is mapped.

#include "flyball/simulation/mission.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Two rooms on a corridor of 5 m.
Scenario small_office() {
  Scenario scenario;
  scenario.name = "small_office";
  scenario.mission.workload = "mapping";
  scenario.world.generator = "office";
  scenario.world.parameters["rooms_per_side"] = 1.0;
  scenario.vehicle.payload_kg = 0.0;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["cost_of"] = std::string{"octomap"};
  scenario.mission.time_limit_s = 600.0;
  scenario.explore.coverage_percent = 70.0;
  return scenario;
}

/// With all planning on the edge computer.
Scenario planned_afar(double bandwidth_mbit_s) {
  Scenario scenario = small_office();
  scenario.edge.platform = "jetson_tx2";
  scenario.edge.speed_factor = 3.0;
  scenario.edge.bandwidth_mbit_s = bandwidth_mbit_s;
  scenario.offload.plan = 1;
  scenario.offload.explore = 1;
  return scenario;
}

Summary flown(const Scenario& scenario) {
  const auto record = fly(scenario, {});
  EXPECT_TRUE(record.ok()) << record.error().message;
  EXPECT_EQ(record->summary.status, MissionStatus::succeeded) << to_string(record->summary.failure);
  return record->summary;
}

TEST(Offload, of_planning_through_a_fast_link_makes_a_mapping_shorter_and_through_a_slow_one_not) {
  const Summary onboard = flown(small_office());
  const Summary fast = flown(planned_afar(1000.0));
  // A map of these rooms takes some .1 Mb, and 1 Mb/s is still fast enough.
  const Summary slow = flown(planned_afar(0.02));
  EXPECT_LT(fast.mission_time_s, 0.95 * onboard.mission_time_s);
  EXPECT_LT(fast.kernels.at("nbvp").mission_ms_mean,
            0.4 * onboard.kernels.at("nbvp").mission_ms_mean);
  EXPECT_GT(slow.mission_time_s, 0.95 * onboard.mission_time_s);
}

TEST(Offload, an_edge_computer_without_work_changes_nothing_but_the_radios_energy) {
  Scenario idle = planned_afar(1000.0);
  idle.offload = {};
  const Summary with = flown(idle);
  const Summary without = flown(small_office());
  EXPECT_EQ(with.mission_time_s, without.mission_time_s);
  EXPECT_NEAR(with.energy_computer_j - without.energy_computer_j,
              idle.edge.radio_idle_w * without.mission_time_s, 1.0);
}

TEST(Offload, is_a_function_of_the_scenario_with_loss_and_jitter_too) {
  Scenario scenario = planned_afar(100.0);
  scenario.offload.map = 1;
  scenario.edge.loss = 0.05;
  scenario.edge.jitter_s = 0.005;
  const auto first = fly(scenario, {});
  const auto again = fly(scenario, {});
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->summary.trace_hash, again->summary.trace_hash);
  EXPECT_NE(first->summary.failure, MissionFailure::collision);
}

TEST(Offload, is_refused_where_the_computer_is_not_modeled) {
  MissionHooks hooks;
  hooks.executor = [](const Graph&, const Platform&, EventQueue&, const OperatingPoint&) {
    return std::unique_ptr<Executor>{};
  };
  const auto record = fly(planned_afar(1000.0), hooks);
  ASSERT_FALSE(record);
  EXPECT_NE(record.error().message.find("edge.platform"), std::string::npos);
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/flight/governing/governor_loop.h"

#include "scratch_folder.h"
#include "short_delivery.h"
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(GovernorLoop, decides_at_its_period_and_applies_the_wish_once) {
  Scenario scenario = kit::short_delivery();
  scenario.governor.period_s = 0.5;
  const MissionRecord record = kit::flown(scenario);
  const auto decisions = static_cast<double>(record.summary.decisions);
  EXPECT_NEAR(decisions, record.summary.mission_time_s / 0.5, 1.5);
  // fixed_coarse turns one knob, at the first decision, away from the scenario's .15 m.
  EXPECT_EQ(record.summary.knob_changes, 1U);
  EXPECT_EQ(record.summary.policy_faults, 0U);
}

TEST(GovernorLoop, counts_a_fault_where_it_counts_the_decision) {
  const ScratchFolder scripts;
  Scenario scenario = kit::short_delivery(50.0);
  scenario.governor.policy =
      scripts.file("failing.lua", "function decide(seen)\n  error('enough')\nend\n");
  // The flight ends with a decision, whose job is killed and is in no record.
  scenario.mission.time_limit_s =
      20.0 * scenario.governor.period_s - 0.5 * scenario.vehicle.physics_step_s;
  const MissionRecord record = kit::flown(scenario);
  EXPECT_GT(record.summary.decisions, 0U);
  EXPECT_EQ(record.summary.policy_faults, record.summary.decisions);
}

TEST(GovernorLoop, a_wish_that_this_mission_does_not_have_is_moved_and_recorded_once) {
  Scenario scenario = kit::short_delivery();  // fixed_coarse asks for .80 m
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  const MissionRecord record = kit::flown(scenario);
  int notes = 0;
  double resolution_m = 0.0;
  for (const auto& row : record.trace->rows()) {
    for (const auto& [name, value] : row.fields) {
      const auto* text = std::get_if<std::string>(&value);
      notes += text != nullptr && *text == "map.resolution_m 0.8 is not legal here, 0.6 instead";
      if (row.channel == "decision" && name == std::string{"value"}) {
        resolution_m = std::get<double>(value);
      }
    }
  }
  EXPECT_EQ(notes, 1);
  EXPECT_EQ(resolution_m, 0.6);
}

TEST(GovernorLoop, records_what_each_decision_knew) {
  const MissionRecord record = kit::flown(kit::short_delivery());
  std::uint64_t observations = 0;
  for (const auto& row : record.trace->rows()) {
    observations += row.channel == "observation" ? 1 : 0;
  }
  EXPECT_EQ(observations, record.summary.decisions);
}

TEST(GovernorLoop, sees_the_missions_progress_and_what_its_stages_take) {
  const Scenario scenario = kit::short_delivery();
  const MissionRecord record = kit::flown(scenario);
  std::map<std::string, double> last;
  double progress_m = 0.0;
  for (const auto& row : record.trace->rows()) {
    for (const auto& [name, value] : row.fields) {
      if (const auto* number = std::get_if<double>(&value);
          number && row.channel == "observation") {
        last[std::string{name}] = *number;
      }
    }
    EXPECT_GE(last["progress"], progress_m);
    progress_m = last["progress"];
  }
  EXPECT_EQ(last["progress_unit"], static_cast<double>(ProgressUnit::metre));
  // The way flown holds take-offs, landings and detours besides.
  EXPECT_LT(progress_m, record.summary.distance_m);
  EXPECT_GT(progress_m, 0.6 * record.summary.distance_m);
  EXPECT_GT(last["map_job_s"], 0.0);
  EXPECT_GT(last["map_gigacycles"], 0.0);
  EXPECT_GT(last["plan_job_s"], 0.0);
  EXPECT_EQ(last["detect_job_s"], 0.0);
  EXPECT_GT(last["headroom_m"], 0.0);
  EXPECT_EQ(last["map_range_m"], scenario.map.range_m) << "nobody turns it";
}

TEST(GovernorLoop, sees_meters_instead_of_the_truth) {
  Scenario scenario = kit::short_delivery();
  scenario.vehicle.battery_charge = 0.7;
  const MissionRecord record = kit::flown(scenario);
  for (const double percent : kit::observed(record, "battery_percent")) {
    EXPECT_EQ(percent, std::round(percent));
    EXPECT_NEAR(percent, 70.0, 5.0);
  }
  const std::vector<double> shown_w = kit::observed(record, "rotor_power_w");
  const std::set<double> rotors_w{shown_w.begin(), shown_w.end()};
  // One message a second, and zero before the first; no two of them are equal for their noise.
  EXPECT_NEAR(static_cast<double>(rotors_w.size()), 1.0 + record.summary.mission_time_s, 1.5);
  EXPECT_LT(static_cast<double>(rotors_w.size()),
            0.5 * static_cast<double>(record.summary.decisions));
}

TEST(GovernorLoop, knows_at_its_first_look_how_hot_the_computer_is) {
  Scenario scenario = kit::short_delivery();
  scenario.platform.name = "jetson_tx2_passive";
  scenario.mission.time_limit_s = 0.5 * scenario.governor.period_s;
  const std::vector<double> temperature_c = kit::observed(kit::flown(scenario), "temperature_c");
  ASSERT_EQ(temperature_c.size(), 1U);
  EXPECT_GT(temperature_c.front(), 20.0);
  EXPECT_EQ(2.0 * temperature_c.front(), std::round(2.0 * temperature_c.front()));
}

TEST(GovernorLoop, asks_a_policy_as_often_as_it_wants_and_looks_around_at_its_own_pace) {
  Scenario scenario = kit::short_delivery();
  scenario.governor.policy = "ondemand_10ms";
  const MissionRecord record = kit::flown(scenario);
  const double time_s = record.summary.mission_time_s;
  EXPECT_NEAR(static_cast<double>(record.summary.decisions), time_s / 0.010, 2.5);
  std::uint64_t observations = 0;
  for (const auto& row : record.trace->rows()) {
    observations += row.channel == "observation" ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(observations), time_s / scenario.governor.period_s, 1.5);
  EXPECT_GE(record.summary.knob_changes, 2U);
}

TEST(GovernorLoop, what_it_asks_the_map_takes_time_and_the_decision_none) {
  Scenario scenario = kit::short_delivery();
  scenario.governor.policy = "ondemand_10ms";  // Decides a hundred times between two looks.
  const MissionRecord record = kit::flown(scenario);
  const KernelStatistics& asked = record.summary.kernels.at("map_queries");
  const double looks = record.summary.mission_time_s / scenario.governor.period_s;
  EXPECT_LE(static_cast<double>(asked.calls), looks + 1.0);
  EXPECT_GT(static_cast<double>(asked.calls), 0.5 * looks);  // No map before take-off.
  EXPECT_GT(asked.mission_ms_mean, 0.5);
  EXPECT_LT(asked.mission_ms_mean, 50.0);
}

TEST(GovernorLoop, the_computer_runs_at_the_clock_that_was_wished) {
  Scenario scenario = kit::short_delivery();
  scenario.governor.policy = "performance";
  const MissionRecord fast = kit::flown(scenario);
  scenario.governor.policy = "powersave";
  const MissionRecord slow = kit::flown(scenario);
  // The platform file: a command takes 1 ms at 2.0352 GHz, in proportion to 1 / f.
  EXPECT_NEAR(fast.summary.kernels.at("track").mission_ms_mean, 1.0, 0.01);
  EXPECT_NEAR(slow.summary.kernels.at("track").mission_ms_mean, 2.0352 / 0.3456, 0.05);
  const double fast_w = fast.summary.energy_computer_j / fast.summary.mission_time_s;
  const double slow_w = slow.summary.energy_computer_j / slow.summary.mission_time_s;
  EXPECT_LT(slow_w, fast_w);
}

}  // namespace
}  // namespace flyball

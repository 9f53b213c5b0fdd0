// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/studies/replay.h"

#include "flyball/records/report.h"
#include "flyball/runtime/observation_fields.h"

#include "scratch_folder.h"
#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Flies, leaves the record in the folder, reads it back.
RecordedFlight flown_with(const std::string& policy, const ScratchFolder& folder) {
  Scenario scenario = kit::short_delivery(8.0);
  scenario.governor.policy = policy;
  const MissionRecord record = kit::flown(scenario);
  EXPECT_TRUE(write_run(folder.path(), scenario, record).ok());
  auto flight = read_flight(folder.path());
  EXPECT_TRUE(flight.ok()) << flight.error().message;
  EXPECT_EQ(record.summary.decisions, flight->decisions);
  return *flight;
}

TEST(Replay, repeats_every_decision_bit_for_bit) {
  for (const char* policy : {"two_level", "mission_energy", "schedutil_10ms"}) {
    const ScratchFolder folder;
    const RecordedFlight flight = flown_with(policy, folder);
    const auto result = replay(flight);
    ASSERT_TRUE(result.ok()) << result.error().message;
    EXPECT_EQ(flight.decisions, result->decisions);
    EXPECT_GT(result->decisions, 50U);
    EXPECT_EQ(0U, result->different)
        << policy << " at " << to_seconds(result->differences.front().at) << "\n"
        << result->differences.front().recorded << "\n"
        << result->differences.front().now;
  }
}

TEST(Replay, finds_what_was_changed_in_a_record) {
  const ScratchFolder folder;
  RecordedFlight flight = flown_with("two_level", folder);
  flight.choices.begin()->second += "!";
  const auto wrong = replay(flight);
  ASSERT_TRUE(wrong.ok());
  EXPECT_GT(wrong->different, 0U);
  EXPECT_EQ(MissionTime{}, wrong->differences.front().at);
}

TEST(Replay, another_input_makes_other_decisions) {
  const ScratchFolder folder;
  RecordedFlight flight = flown_with("two_level", folder);
  const auto& fields = observation_fields();
  for (auto& [at, changes] : flight.changes) {
    for (auto& [field, value] : changes) {
      if (std::string{fields[field].name} == "obstacle_density" && to_seconds(at) > 5.0) {
        value = 0.5;
      }
    }
  }
  const auto result = replay(flight);
  ASSERT_TRUE(result.ok());
  EXPECT_GT(result->different, 0U);
  EXPECT_NEAR(5.25, to_seconds(result->differences.front().at), 0.01);
}

TEST(Replay, asks_another_policy_what_it_would_have_done) {
  const ScratchFolder folder;
  const RecordedFlight flight = flown_with("fixed_coarse", folder);
  const auto same = shadow(flight, "fixed_coarse");
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(0U, same->different);
  const auto other = shadow(flight, "fixed_fine");
  ASSERT_TRUE(other.ok());
  EXPECT_EQ(other->decisions, other->different);
  ASSERT_EQ(1U, other->differences.size());
  EXPECT_EQ("map.resolution_m 0.8", other->differences[0].recorded);
  EXPECT_EQ("map.resolution_m 0.15", other->differences[0].now);
  EXPECT_FALSE(shadow(flight, "just_in_tme").ok());
}

/// The first look in cruise above 1 m/s, where latency counts.
MissionTime first_cruise(const RecordedFlight& flight) {
  const auto& fields = observation_fields();
  for (const auto& [at, changes] : flight.changes) {
    bool cruises = false;
    bool moves = false;
    for (const auto& [field, value] : changes) {
      const std::string name = fields[field].name;
      cruises = cruises || (name == "phase" && value == 1.0);
      moves = moves || (name == "speed_m_s" && value > 1.0);
    }
    if (cruises && moves) {
      return at;
    }
  }
  ADD_FAILURE() << "it never cruises";
  return {};
}

TEST(Replay, explains_one_decision) {
  const ScratchFolder folder;
  const RecordedFlight flight = flown_with("mission_energy", folder);
  const MissionTime at = first_cruise(flight);
  const auto told = explain(flight, at + std::chrono::milliseconds{100});
  ASSERT_TRUE(told.ok()) << told.error().message;
  EXPECT_EQ(at, told->at) << "the last one before";
  EXPECT_EQ(at, told->seen.now);
  EXPECT_NE(std::string::npos, told->choice.find("map.resolution_m="));
  ASSERT_FALSE(told->options.empty());
  for (std::size_t i = 1; i < told->options.size(); ++i) {
    EXPECT_LE(told->options[i - 1].joules_per_m, told->options[i].joules_per_m);
  }
  const double power_w = told->seen.rotor_power.value() + told->seen.computer_power.value();
  const double slowest_s = told->response_s + told->seen.speed_m_s / 6.0;  // a = 6 m/s^2
  EXPECT_NEAR(power_w / slowest_s, told->watts_per_second, 1e-9);
  EXPECT_FALSE(explain(flight, MissionTime{from_seconds(1e5)}).ok());
}

TEST(Replay, does_not_repeat_what_only_the_simulator_knew) {
  const ScratchFolder folder;
  RecordedFlight flight = flown_with("fixed_coarse", folder);
  const auto other = shadow(flight, "reference");
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().message,
            "policy \"reference\" is told what no record holds; fly it instead");
  flight.scenario.governor.policy = "reference";
  EXPECT_FALSE(replay(flight).ok());
}

TEST(Replay, says_what_a_folder_lacks) {
  const ScratchFolder folder;
  EXPECT_EQ(ErrorCode::not_found, read_flight(folder.path()).error().code);
  static_cast<void>(folder.file("trace.jsonl", "{\"t_s\":0,\"channel\":\"state\"}\nnonsense\n"));
  const auto broken = read_flight(folder.path());
  ASSERT_FALSE(broken.ok());
  EXPECT_NE(std::string::npos, broken.error().message.find("trace.jsonl:2:"));
  static_cast<void>(folder.file("trace.jsonl", "{\"t_s\":0,\"channel\":\"state\"}\n"));
  EXPECT_NE(std::string::npos, read_flight(folder.path()).error().message.find("no decisions"));
}

}  // namespace
}  // namespace flyball

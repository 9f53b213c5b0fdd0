// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop

#include "flyball/studies/drift.h"

#include "scratch_folder.h"
#include "short_delivery.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double event_s = 30.0;

MissionTime after(double s) {
  return MissionTime{from_seconds(s)};
}

TEST(Drift, bounds_are_counted_from_the_event_on) {
  DriftRecord record;
  for (std::uint64_t i = 1; i <= 100; ++i) {  // Every fourth one is late.
    record.push_back({after(static_cast<double>(i)), i, i / 4});
  }
  const DriftCount count = count_bounds(record, after(20.5), 11, 30);
  EXPECT_EQ(count.decisions, 20U);  // 31 to 50.
  EXPECT_EQ(count.late, 50U / 4U - 30U / 4U);
  EXPECT_EQ(count_bounds(record, after(20.5), 71, 500).decisions, 10U) << "the mission ended";
  EXPECT_EQ(count_bounds(record, after(500.0), 1, 9).decisions, 0U);
}

TEST(Drift, a_damaged_record_is_refused) {
  const ScratchFolder folder;
  const auto read = [&folder](const std::string& counts) {
    static_cast<void>(
        folder.file("trace.jsonl", "{\"channel\":\"latency_bound\"," + counts + "}\n"));
    return read_drift_record(folder.path());
  };
  const auto sound = read("\"t_s\":1.5,\"issued\":7,\"late\":1");
  ASSERT_TRUE(sound.ok());
  ASSERT_EQ(sound->size(), 1U);
  EXPECT_EQ(sound->front().issued, 7U);
  for (const char* counts :
       {"\"t_s\":1e300,\"issued\":7,\"late\":1", "\"t_s\":-1,\"issued\":7,\"late\":1",
        "\"t_s\":1.5,\"issued\":-7,\"late\":1", "\"t_s\":1.5,\"issued\":7,\"late\":1e30"}) {
    const auto damaged = read(counts);
    ASSERT_FALSE(damaged.ok()) << counts;
    EXPECT_NE(damaged.error().message.find("trace.jsonl\": "), std::string::npos)
        << damaged.error().message;
  }
}

Scenario loaded_with(const std::vector<std::string>& settings) {
  auto loaded = load_scenario("delivery_congestion", settings);
  return std::get<LoadedScenario>(loaded).scenario;
}

/// The scenarios of all cases on top of these settings.
std::vector<Scenario> cases_on(const std::vector<std::string>& settings) {
  std::vector<Scenario> all;
  for (const DriftCase& one : drift_cases(event_s, loaded_with(settings))) {
    std::vector<std::string> both = settings;
    both.insert(both.end(), one.settings.begin(), one.settings.end());
    all.push_back(loaded_with(both));
  }
  return all;
}

TEST(Drift, events_come_after_those_of_the_scenario) {
  const auto all = cases_on({"events.1.kind=slowdown", "events.1.at_s=5", "events.1.factor=2"});
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].events.size(), 1U);
  for (std::size_t i = 1; i < all.size(); ++i) {
    ASSERT_EQ(all[i].events.size(), 2U);
    EXPECT_EQ(all[i].events[0].at_s, 5.0);
    EXPECT_EQ(all[i].events[1].at_s, event_s);
  }
}

TEST(Drift, heat_comes_to_the_computer_that_was_chosen_if_its_heat_is_known) {
  const ScratchFolder folder;
  const std::string mine = folder.file("mine.toml", R"(
    like = "jetson_tx2"
    name = "mine"
    [thermal]
    ambient_c = 40.0
    resistance_k_w = 8.0
    time_constant_s = 540.0
    [[thermal.trips]]
    at_c = 90.0
    hysteresis_k = 2.0
    cap_hz = 345.6e6
  )");
  EXPECT_EQ(cases_on({"platform.name=" + mine}).back().platform.name, mine);
  EXPECT_EQ(drift_cases(event_s, loaded_with({"platform.name=" + mine})).back().caveat, "");
  const auto warm = cases_on({"platform.name=" + mine, "platform.start_temperature_c=50"});
  EXPECT_EQ(warm.back().platform.start_temperature_c, 50.0);
  const auto unknown = drift_cases(event_s, loaded_with({"platform.name=jetson_tx2"})).back();
  EXPECT_NE(unknown.caveat.find("on jetson_tx2_passive, because"), std::string::npos);
  EXPECT_EQ(cases_on({"platform.name=jetson_tx2"}).back().platform.name, "jetson_tx2_passive");
}

/// Over open ground, long enough for 300 decisions; small pictures, which are what costs host time.
MissionRecord flown_with(const std::string& policy, const DriftCase& drift) {
  std::vector<std::string> settings{
      "world.generator=empty",    "world.goal_distance_m=900",
      "mission.max_speed_m_s=6",  "mission.time_limit_s=150",
      "kernels.mapper=flyball",   "kernels.mapper_parameters.cost_of=octomap",
      "planner.horizon_m=50",     "map.range_m=10",
      "camera.max_range_m=10",    "camera.rgbd_noise=false",
      "camera.width_px=64",       "camera.height_px=36",
      "governor.policy=" + policy};
  settings.insert(settings.end(), drift.settings.begin(), drift.settings.end());
  auto loaded = load_scenario("delivery_congestion", settings);
  return kit::flown(std::get<LoadedScenario>(loaded).scenario);
}

DriftCount late_after(const MissionRecord& record) {
  return count_bounds(drift_record(*record.trace), after(event_s), 51, 300);
}

// The share that is asked for is 5 %.
TEST(Drift, a_calibrated_bound_holds_when_costs_triple_and_one_calibrated_once_does_not) {
  const DriftCase slowdown = drift_cases(event_s, loaded_with({}))[1];
  ASSERT_EQ(slowdown.name, "slowdown");
  const MissionRecord calibrated = flown_with("mission_energy", slowdown);
  EXPECT_NE(calibrated.summary.failure, MissionFailure::collision);
  EXPECT_EQ(late_after(calibrated).decisions, 250U);
  EXPECT_LE(late_after(calibrated).late_share(), 2.0 * 0.05);
  const MissionRecord once = flown_with("mission_energy_once", slowdown);
  EXPECT_NE(once.summary.failure, MissionFailure::collision);
  EXPECT_GT(late_after(once).late_share(), 2.0 * 0.05);
}

}  // namespace
}  // namespace flyball

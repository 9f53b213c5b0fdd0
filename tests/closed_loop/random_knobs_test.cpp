// SPDX-License-Identifier: BSD-3-Clause
//
// Missions whose policy turns every knob at random at each decision: nothing is touched, each ends
// in a state that has a name, and the latency bound stays one.
//
// A sample of 20 runs with the other tests. All 500, on one core in some minutes:
//   ninja -C build/ci test_closed_loop && build/ci/bin/test_closed_loop
//     --gtest_also_run_disabled_tests --gtest_filter='RandomKnobs.*500*'
#ifdef FLYBALL_HAS_LUA

#include "flyball/scenario/files.h"
#include "flyball/sim/platform_file.h"

#include "short_delivery.h"
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

struct Place {
  std::string world;
  std::map<std::string, ParameterValue> parameters;
};

/// Nothing moves in any of them.
std::vector<Place> places() {
  return {{"forest", {{"goal_distance_m", 40.0}, {"width_m", 20.0}}},
          {"office", {{"goal_room", 6.0}}},
          {"congestion", {{"goal_m", 60.0}}},
          {"mixed", {{"length_m", 450.0}}},
          {"outdoor_to_indoor", {{"outdoors_m", 30.0}}}};
}

Scenario mission(const Place& place, std::uint64_t seed) {
  Scenario scenario;
  scenario.name = "random_knobs_" + place.world;
  scenario.seed = seed;
  scenario.world.generator = place.world;
  scenario.world.parameters = place.parameters;
  scenario.governor.policy = FLYBALL_CLOSED_LOOP_TESTS "/random_knobs.lua";
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  scenario.mission.time_limit_s = 60.0;
  scenario.vehicle.physics_step_s = 0.004;
  // The thinnest trunk, of .3 m, must be as wide as a pixel at 20 m, where the camera's range ends:
  // maps of a camera that looks past it declare its place free, and two later hits do not undo
  // that.
  scenario.camera.width_px = 144;
  scenario.camera.height_px = 81;
  return scenario;
}

/// Of a frame that sees nothing, at the highest clock: no map is made in less.
double least_bound_s(const Scenario& scenario) {
  const auto file = find_shipped("platforms", scenario.platform.name);
  FLYBALL_ASSERT(file.ok(), "%s", file.error().message.c_str());
  const ModeledPlatform platform{*load_platform(*file)};
  Work work;
  work.add("frame", 1.0);
  work.add("rays", static_cast<double>(scenario.camera.width_px) * scenario.camera.height_px);
  return to_seconds(platform.job_time("octomap", work, platform.frequencies().back()));
}

/// The bounds that the governor was told.
struct Bounds {
  int told{};
  int zero_again{};  ///< After the first map there is one.
  double least_s{1e300};
  double most_s{};
};

Bounds bounds_of(const MissionRecord& record) {
  Bounds bounds;
  for (const auto& row : record.trace->rows()) {
    const bool tells = row.channel == "observation" || row.channel == "state";
    for (const Field& field : row.fields) {
      if (!tells || field.name != "latency_bound_s") {
        continue;
      }
      const double bound_s = std::get<double>(field.value);
      if (bound_s == 0.0) {
        bounds.zero_again += bounds.told > 0 ? 1 : 0;
        continue;
      }
      ++bounds.told;
      bounds.least_s = std::min(bounds.least_s, bound_s);
      bounds.most_s = std::max(bounds.most_s, bound_s);
    }
  }
  return bounds;
}

void check(const MissionRecord& record, double least_s) {
  const Summary& summary = record.summary;
  EXPECT_NE(summary.failure, MissionFailure::collision);
  EXPECT_GT(summary.min_clearance_m, 0.0);
  EXPECT_NE(summary.status, MissionStatus::interrupted);
  EXPECT_EQ(summary.status == MissionStatus::failed, summary.failure != MissionFailure::none);
  EXPECT_EQ(summary.policy_faults, 0U) << summary.policy_trouble;
  EXPECT_GT(summary.knob_changes, 100U) << "not random enough";
  const Bounds bounds = bounds_of(record);
  EXPECT_GT(bounds.told, 100) << "too few to show anything";
  EXPECT_EQ(bounds.zero_again, 0);
  EXPECT_GE(bounds.least_s, least_s);
  EXPECT_LE(bounds.most_s, to_seconds(std::chrono::seconds{60}));
}

/// @param choices  Knobs beside those that each mission has.
/// @return         How often missions ended in each way.
std::map<std::string, int> fly_all(int n,
                                   std::uint64_t first_seed,
                                   const KnobChoices& choices = {}) {
  const std::vector<Place> all = places();
  std::map<std::string, int> ends;
  for (int i = 0; i < n; ++i) {
    const Place& place = all[static_cast<std::size_t>(i) % all.size()];
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i) / all.size();
    SCOPED_TRACE(place.world + " seed " + std::to_string(seed));
    Scenario scenario = mission(place, seed);
    scenario.knobs = choices;
    const MissionRecord record = kit::flown(scenario);
    check(record, least_bound_s(scenario));
    const Summary& summary = record.summary;
    ++ends[place.world + ": " +
           (summary.status == MissionStatus::failed ? to_string(summary.failure)
                                                    : to_string(summary.status))];
  }
  return ends;
}

TEST(RandomKnobs, cost_time_but_no_collision_and_no_bound_that_is_none_in_20_missions) {
  fly_all(20, 1);
}

TEST(RandomKnobs, cost_no_collision_where_planners_and_rates_change_too_in_10_missions) {
  fly_all(10, 501, {"rrt,rrt_star,prm,bit_star", "haar", true, true});
}

TEST(RandomKnobs, DISABLED_cost_time_but_no_collision_and_no_bound_that_is_none_in_500_missions) {
  for (const auto& [end, times] : fly_all(500, 1001)) {
    std::printf("%4d %s\n", times, end.c_str());
  }
}

}  // namespace
}  // namespace flyball

#endif

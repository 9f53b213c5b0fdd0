// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
//
// Whole missions whose nodes run on threads in arbitrary order, fed by the simulator through the
// same topics as ever. Under the thread sanitizer they prove that nodes share nothing but messages.

#include "flyball/mcap/mcap_recovery.h"
#include "flyball/simulation/mission.h"

#include "pool_executor.h"
#include "scratch_folder.h"
#include <algorithm>
#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Overlaps = std::set<std::pair<std::string, std::string>>;

/// Mission time to be flown by each test: 10 s, or what FLYBALL_POOL_FLIGHT_S says.
double flight_time_s() {
  const char* chosen = std::getenv("FLYBALL_POOL_FLIGHT_S");
  return chosen != nullptr ? std::max(1.0, std::atof(chosen)) : 10.0;
}

struct Flown {
  double mission_s{};
  double distance_m{};
  double host_s{};
  Overlaps overlaps{};
};

Scenario loaded(const std::string& name, const std::vector<std::string>& settings) {
  auto found = load_scenario(name, settings);
  const auto* errors = std::get_if<std::vector<Error>>(&found);
  FLYBALL_ASSERT(errors == nullptr, "%s", errors->front().message.c_str());
  return std::get<LoadedScenario>(found).scenario;
}

Result<MissionRecord> fly_on_threads(const Scenario& scenario,
                                     Overlaps& overlaps,
                                     OnboardRecord* record = nullptr) {
  MissionHooks hooks;
  hooks.onboard_record = record;
  hooks.executor = [&](const Graph& graph, const Platform& platform, EventQueue& queue,
                       const OperatingPoint& start) {
    kit::PoolSettings settings;
    settings.seed = scenario.seed;
    settings.overlaps = &overlaps;
    return std::make_unique<kit::PoolExecutor>(graph, platform, queue, start, settings);
  };
  return fly(scenario, hooks);
}

/// Flies one seed after the other until there is enough of it.
Flown fly_long_enough(Scenario scenario) {
  Flown flown;
  while (flown.mission_s < flight_time_s() && !testing::Test::HasFailure()) {
    scenario.mission.time_limit_s = std::max(5.0, flight_time_s() - flown.mission_s);
    const auto record = fly_on_threads(scenario, flown.overlaps);
    if (!record) {
      ADD_FAILURE() << record.error().message;
      break;
    }
    const Summary& summary = record->summary;
    EXPECT_NE(summary.failure, MissionFailure::collision) << "seed " << scenario.seed;
    EXPECT_GT(summary.min_clearance_m, 0.0) << "seed " << scenario.seed;
    EXPECT_EQ(summary.policy_faults, 0U) << summary.policy_trouble;
    flown.mission_s += summary.mission_time_s;
    flown.distance_m += summary.distance_m;
    flown.host_s += summary.host_s;
    ++scenario.seed;
  }
  std::printf("flown %.1f s and %.1f m in %.1f s of host time; %zu pairs of nodes overlapped\n",
              flown.mission_s, flown.distance_m, flown.host_s, flown.overlaps.size());
  EXPECT_GT(flown.distance_m, 1.0);
  return flown;
}

void expect_overlaps(const Flown& flown, const std::vector<std::string>& nodes) {
  for (const std::string& one : nodes) {
    EXPECT_TRUE(
        std::any_of(flown.overlaps.begin(), flown.overlaps.end(),
                    [&](const auto& pair) { return pair.first == one || pair.second == one; }))
        << one << " ran alone";
  }
}

/// Two rooms on a corridor of 5 m, seen ten times a second: a picture is what takes most of the
/// time.
Scenario small_office() {
  return loaded("mapping_office",
                {"world.rooms_per_side=1", "world.furniture_per_room=1", "camera.rate_hz=10"});
}

TEST(PoolFlight, delivers_among_trees) {
  const Flown flown = fly_long_enough(loaded(
      "delivery_forest", {"kernels.mapper=flyball", "kernels.mapper_parameters.cost_of=octomap",
                          "governor.policy=mission_energy"}));
  expect_overlaps(flown, {"localize", "points", "map", "check", "follow", "govern", "record"});
  EXPECT_EQ(flown.overlaps.count({"follow", "map"}), 1U);
}

TEST(PoolFlight, delivers_with_stock_octomap) {
  const Flown flown = fly_long_enough(
      loaded("delivery_forest", {"kernels.mapper=octomap", "governor.policy=two_level"}));
  EXPECT_EQ(flown.overlaps.count({"follow", "map"}), 1U);
}

/// The thread that writes asks maps for their cells while mappers make the next ones.
TEST(PoolFlight, is_recorded_by_one_more_thread) {
  for (const std::string mapper : {"flyball", "octomap"}) {
    const ScratchFolder folder;
    const std::string path = folder.path("a.mcap");
    auto record = OnboardRecord::open(path, WhenFull::drop, {});
    ASSERT_TRUE(record) << record.error().message;
    Scenario scenario = loaded("delivery_forest", {"kernels.mapper=" + mapper});
    scenario.mission.time_limit_s = flight_time_s();
    Overlaps overlaps;
    const auto flown = fly_on_threads(scenario, overlaps, record->get());
    ASSERT_TRUE(flown) << flown.error().message;
    ASSERT_TRUE((*record)->close());
    const auto read = recover_mcap(path, folder.path("b.mcap"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->messages, (*record)->counts().written);
    EXPECT_GT(read->messages, 100U) << mapper;
  }
}

TEST(PoolFlight, maps_rooms) {
  const Flown flown = fly_long_enough(small_office());
  expect_overlaps(flown, {"localize", "map", "follow", "explore"});
}

TEST(PoolFlight, maps_rooms_by_an_inertial_camera) {
  Scenario scenario = small_office();
  scenario.kernels.localizer = "visual_inertial";
  const Flown flown = fly_long_enough(std::move(scenario));
  EXPECT_EQ(flown.overlaps.count({"localize", "see"}), 1U);
}

TEST(PoolFlight, maps_rooms_by_visual_slam) {
  Scenario scenario = small_office();
  scenario.kernels.localizer = "visual_slam";
  const Flown flown = fly_long_enough(std::move(scenario));
  EXPECT_EQ(flown.overlaps.count({"localize", "see"}), 1U);
}

TEST(PoolFlight, searches_a_collapsed_building) {
  const Flown flown = fly_long_enough(
      loaded("search_collapsed_building",
             {"world.length_m=9", "world.width_m=6", "world.walls=1", "world.slabs=0",
              "world.rubble=0", "world.hole_m=2", "camera.rate_hz=10"}));
  expect_overlaps(flown, {"localize", "map", "follow", "detect"});
}

TEST(PoolFlight, photographs_a_walking_person) {
  const Flown flown = fly_long_enough(loaded("photography_park", {"colour_camera.rate_hz=10"}));
  expect_overlaps(flown, {"localize", "detect", "track_real_time", "control"});
}

TEST(PoolFlight, scans_a_farm) {
  const Flown flown = fly_long_enough(loaded("scanning_farm", {}));
  expect_overlaps(flown, {"localize", "follow", "govern"});
}

}  // namespace
}  // namespace flyball

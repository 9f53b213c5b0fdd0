// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/flight_store.h"

#include "made_flights.h"
#include "scratch_folder.h"
#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sqlite3.h>

namespace flyball {
namespace {

Scenario scenario_of(const std::string& policy, std::uint64_t seed) {
  Scenario scenario;
  scenario.name = "made";
  scenario.governor.policy = policy;
  scenario.seed = seed;
  return scenario;
}

FlightStore opened(const std::string& path) {
  auto store = FlightStore::open(path);
  EXPECT_TRUE(store.ok()) << store.error().message;
  return std::move(*store);
}

TEST(FlightStore, has_what_was_put_in_also_when_it_is_opened_again) {
  const ScratchFolder folder;
  const Scenario scenario = scenario_of("fixed_fine", 3);
  {
    FlightStore store = opened(folder.path("t.db"));
    EXPECT_FALSE(store.find(scenario));
    ASSERT_TRUE(store.add(scenario, made_summary("fixed_fine", 3)));
  }
  const auto found = opened(folder.path("t.db")).find(scenario);
  ASSERT_TRUE(found);
  EXPECT_EQ(to_json(*found), to_json(made_summary("fixed_fine", 3)));
}

TEST(FlightStore, knows_a_flight_by_its_whole_scenario) {
  const ScratchFolder folder;
  FlightStore store = opened(folder.path("t.db"));
  ASSERT_TRUE(store.add(scenario_of("fixed_fine", 3), made_summary("fixed_fine", 3)));
  EXPECT_FALSE(store.find(scenario_of("fixed_fine", 4)));
  EXPECT_FALSE(store.find(scenario_of("fixed_coarse", 3)));
  Scenario heavier = scenario_of("fixed_fine", 3);
  heavier.vehicle.payload_kg += 0.1;
  EXPECT_FALSE(store.find(heavier)) << "same world, policy and seed, but another mission";
}

TEST(FlightStore, puts_a_newer_flight_in_an_older_ones_place) {
  const ScratchFolder folder;
  FlightStore store = opened(folder.path("t.db"));
  const Scenario scenario = scenario_of("fixed_fine", 3);
  Summary newer = made_summary("fixed_fine", 3);
  newer.mission_time_s = 7.0;
  ASSERT_TRUE(store.add(scenario, made_summary("fixed_fine", 3)));
  ASSERT_TRUE(store.add(scenario, newer));
  EXPECT_EQ(store.find(scenario)->mission_time_s, 7.0);
}

TEST(FlightStore, keeps_flights_apart_that_differ_in_what_a_sweep_set) {
  const ScratchFolder folder;
  FlightStore store = opened(folder.path("t.db"));
  Scenario light = scenario_of("fixed_fine", 3);
  Scenario heavy = light;
  heavy.vehicle.payload_kg += 1.0;
  Summary other = made_summary("fixed_fine", 3);
  other.mission_time_s = 7.0;
  ASSERT_TRUE(store.add(light, made_summary("fixed_fine", 3), "vehicle.payload_kg=0.5"));
  ASSERT_TRUE(store.add(heavy, other, "vehicle.payload_kg=1.5"));
  EXPECT_EQ(store.find(light, "vehicle.payload_kg=0.5")->mission_time_s, 100.0);
  EXPECT_EQ(store.find(heavy, "vehicle.payload_kg=1.5")->mission_time_s, 7.0);
  EXPECT_FALSE(store.find(light)) << "that is no flight of a sweep";
}

/// What another program that reads the file sees.
std::string asked(const std::string& path, const std::string& query) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  std::string answer;
  const auto take = [](void* all, int columns, char** values, char** /*names*/) {
    for (int i = 0; i < columns; ++i) {
      *static_cast<std::string*>(all) += std::string{values[i] == nullptr ? "" : values[i]} + "|";
    }
    return 0;
  };
  char* error = nullptr;
  EXPECT_EQ(sqlite3_exec(database, query.c_str(), take, &answer, &error), SQLITE_OK) << error;
  sqlite3_free(error);
  sqlite3_close(database);
  return answer;
}

TEST(FlightStore, can_be_queried_for_kernels_and_quality) {
  const ScratchFolder folder;
  ASSERT_TRUE(opened(folder.path("t.db"))
                  .add(scenario_of("fixed_fine", 3), made_summary("fixed_fine", 3), "a=1"));
  EXPECT_EQ(asked(folder.path("t.db"), "SELECT settings, replans, hover_time_s FROM flights"),
            "a=1|7|12.5|");
  EXPECT_EQ(asked(folder.path("t.db"),
                  "SELECT settings, kernel, calls, mission_ms_mean "
                  "FROM kernels"),
            "a=1|octomap|123|45.6|");
  EXPECT_EQ(asked(folder.path("t.db"), "SELECT name, value FROM quality"),
            "area_covered_percent|97.25|");
}

TEST(FlightStore, keeps_no_kernel_and_no_figure_of_a_flight_that_was_replaced) {
  const ScratchFolder folder;
  const std::string path = folder.path("t.db");
  const Scenario scenario = scenario_of("fixed_fine", 3);
  Summary older = made_summary("fixed_fine", 3);
  older.kernels["rrt_star"] = {1, 2.0, 3.0, 4.0};
  older.quality["time_to_find_s"] = 5.0;
  const auto parts = [&path] {
    return asked(path, "SELECT kernel FROM kernels ORDER BY 1") +
           asked(path, "SELECT name FROM quality ORDER BY 1");
  };
  ASSERT_TRUE(opened(path).add(scenario, older, "a"));
  ASSERT_TRUE(opened(path).add(scenario_of("fixed_fine", 4), older, "a")) << "which stays";
  ASSERT_TRUE(opened(path).add(scenario, made_summary("fixed_fine", 3), "a"));
  EXPECT_EQ(parts(),
            "octomap|octomap|rrt_star|area_covered_percent|area_covered_percent|"
            "time_to_find_s|");
  ASSERT_TRUE(opened(folder.path("part.db"))
                  .add(scenario_of("fixed_fine", 4), made_summary("fixed_fine", 4), "a"));
  ASSERT_TRUE(opened(path).add_all_of(folder.path("part.db")));
  EXPECT_EQ(parts(), "octomap|octomap|area_covered_percent|area_covered_percent|");
}

TEST(FlightStore, takes_all_flights_of_another_one_once) {
  const ScratchFolder folder;
  {
    FlightStore part = opened(folder.path("part.db"));
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      ASSERT_TRUE(part.add(scenario_of("fixed_fine", seed), made_summary("fixed_fine", seed), "a"));
    }
  }
  FlightStore store = opened(folder.path("t.db"));
  Summary older = made_summary("fixed_fine", 5);
  older.mission_time_s = 7.0;
  ASSERT_TRUE(store.add(scenario_of("fixed_fine", 5), older, "a"));
  ASSERT_TRUE(store.add(scenario_of("fixed_fine", 9), older, "a"));
  for (int time = 0; time < 2; ++time) {
    const Status added = store.add_all_of(folder.path("part.db"));
    ASSERT_TRUE(added) << added.error().message;
    EXPECT_EQ(asked(folder.path("t.db"), "SELECT count(*) FROM flights"), "6|");
    EXPECT_EQ(asked(folder.path("t.db"), "SELECT count(*) FROM kernels"), "6|");
  }
  EXPECT_EQ(store.find(scenario_of("fixed_fine", 5), "a")->mission_time_s, 100.0);
  EXPECT_FALSE(store.add_all_of(folder.file("other.db", std::string(5000, 'x'))));
  EXPECT_TRUE(store.add_all_of(folder.path("part.db"))) << "a refusal leaves nothing behind";
}

TEST(FlightStore, keeps_what_an_older_version_wrote) {
  const ScratchFolder folder;
  const std::string summary = to_json(made_summary("fixed_fine", 3));
  const std::string key = mission_key(scenario_of("fixed_fine", 3));
  asked(folder.path("t.db"),
        "CREATE TABLE flights (world TEXT NOT NULL, policy TEXT NOT NULL, seed INTEGER NOT NULL, "
        "mission TEXT NOT NULL, status TEXT NOT NULL, failure TEXT NOT NULL, mission_time_s REAL, "
        "energy_total_j REAL, battery_used_percent REAL, collisions INTEGER, "
        "summary TEXT NOT NULL, PRIMARY KEY (world, policy, seed));"
        "INSERT INTO flights VALUES ('made', 'fixed_fine', 3, '" +
            key + "', 'succeeded', 'none', 100.0, 31000.75, 20.0, 0, '" + summary + "')");
  EXPECT_TRUE(opened(folder.path("t.db")).find(scenario_of("fixed_fine", 3)));
  EXPECT_TRUE(opened(folder.path("t.db")).find(scenario_of("fixed_fine", 3))) << "and once more";
}

TEST(FlightStore, leaves_the_file_of_a_newer_version_alone) {
  const ScratchFolder folder;
  asked(folder.path("t.db"), "CREATE TABLE flights (a INTEGER); PRAGMA user_version = 7");
  const auto newer = FlightStore::open(folder.path("t.db"));
  ASSERT_FALSE(newer);
  EXPECT_NE(newer.error().message.find("newer flyball"), std::string::npos);
  EXPECT_EQ(asked(folder.path("t.db"), "SELECT count(*) FROM sqlite_master"), "1|");
}

TEST(FlightStore, waits_for_others_that_write_at_the_same_time) {
  const ScratchFolder folder;
  constexpr std::uint64_t each = 40;
  std::vector<std::thread> writers;
  std::atomic<int> refused{0};
  for (std::uint64_t writer = 0; writer < 4; ++writer) {
    writers.emplace_back([&, writer] {
      for (std::uint64_t i = 0; i < each; ++i) {
        auto store = FlightStore::open(folder.path("t.db"));  // As a process of its own would.
        const std::uint64_t seed = 1 + writer * each + i;
        refused +=
            store && store->add(scenario_of("fixed_fine", seed), made_summary("fixed_fine", seed))
                ? 0
                : 1;
      }
    });
  }
  for (std::thread& writer : writers) {
    writer.join();
  }
  EXPECT_EQ(refused, 0);
  const FlightStore store = opened(folder.path("t.db"));
  for (std::uint64_t seed = 1; seed <= 4 * each; ++seed) {
    EXPECT_TRUE(store.find(scenario_of("fixed_fine", seed))) << seed;
  }
}

TEST(FlightStore, says_what_is_wrong_with_a_file) {
  const ScratchFolder folder;
  const auto other = FlightStore::open(folder.file("t.db", std::string(5000, 'x')));
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::invalid_input);
  EXPECT_NE(other.error().message.find("t.db"), std::string::npos);
  const auto nowhere = FlightStore::open(folder.path("no/such/t.db"));
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::unavailable);
}

}  // namespace
}  // namespace flyball

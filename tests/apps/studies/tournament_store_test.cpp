// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/tournament_store.h"

#include "made_flights.h"
#include "scratch_folder.h"
#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Scenario scenario_of(const std::string& policy, std::uint64_t seed) {
  Scenario scenario;
  scenario.name = "made";
  scenario.governor.policy = policy;
  scenario.seed = seed;
  return scenario;
}

TournamentStore opened(const std::string& path) {
  auto store = TournamentStore::open(path);
  EXPECT_TRUE(store.ok()) << store.error().message;
  return std::move(*store);
}

TEST(TournamentStore, has_what_was_put_in_also_when_it_is_opened_again) {
  const ScratchFolder folder;
  const Scenario scenario = scenario_of("fixed_fine", 3);
  {
    TournamentStore store = opened(folder.path("t.db"));
    EXPECT_FALSE(store.find(scenario));
    ASSERT_TRUE(store.add(scenario, made_summary("fixed_fine", 3)));
  }
  const auto found = opened(folder.path("t.db")).find(scenario);
  ASSERT_TRUE(found);
  EXPECT_EQ(to_json(*found), to_json(made_summary("fixed_fine", 3)));
}

TEST(TournamentStore, knows_a_flight_by_its_whole_scenario) {
  const ScratchFolder folder;
  TournamentStore store = opened(folder.path("t.db"));
  ASSERT_TRUE(store.add(scenario_of("fixed_fine", 3), made_summary("fixed_fine", 3)));
  EXPECT_FALSE(store.find(scenario_of("fixed_fine", 4)));
  EXPECT_FALSE(store.find(scenario_of("fixed_coarse", 3)));
  Scenario heavier = scenario_of("fixed_fine", 3);
  heavier.vehicle.payload_kg += 0.1;
  EXPECT_FALSE(store.find(heavier)) << "same world, policy and seed, but another mission";
}

TEST(TournamentStore, puts_a_newer_flight_in_an_older_ones_place) {
  const ScratchFolder folder;
  TournamentStore store = opened(folder.path("t.db"));
  const Scenario scenario = scenario_of("fixed_fine", 3);
  Summary newer = made_summary("fixed_fine", 3);
  newer.mission_time_s = 7.0;
  ASSERT_TRUE(store.add(scenario, made_summary("fixed_fine", 3)));
  ASSERT_TRUE(store.add(scenario, newer));
  EXPECT_EQ(store.find(scenario)->mission_time_s, 7.0);
}

TEST(TournamentStore, waits_for_others_that_write_at_the_same_time) {
  const ScratchFolder folder;
  constexpr std::uint64_t each = 40;
  std::vector<std::thread> writers;
  std::atomic<int> refused{0};
  for (std::uint64_t writer = 0; writer < 4; ++writer) {
    writers.emplace_back([&, writer] {
      for (std::uint64_t i = 0; i < each; ++i) {
        auto store = TournamentStore::open(folder.path("t.db"));  // As a process of its own would.
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
  const TournamentStore store = opened(folder.path("t.db"));
  for (std::uint64_t seed = 1; seed <= 4 * each; ++seed) {
    EXPECT_TRUE(store.find(scenario_of("fixed_fine", seed))) << seed;
  }
}

TEST(TournamentStore, says_what_is_wrong_with_a_file) {
  const ScratchFolder folder;
  const auto other = TournamentStore::open(folder.file("t.db", std::string(5000, 'x')));
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::invalid_input);
  EXPECT_NE(other.error().message.find("t.db"), std::string::npos);
  const auto nowhere = TournamentStore::open(folder.path("no/such/t.db"));
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::unavailable);
}

}  // namespace
}  // namespace flyball

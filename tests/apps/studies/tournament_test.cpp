// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/tournament.h"

#include "made_flights.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

Summary flight(const std::string& world, const std::string& policy, std::uint64_t seed, double kj) {
  Summary summary = made_summary(policy, seed);
  summary.scenario = world;
  summary.energy_rotor_j = 1e3 * kj;
  summary.energy_computer_j = 0.0;
  summary.mission_time_s = 2.0 * kj;
  return summary;
}

std::vector<Summary> two_worlds() {
  std::vector<Summary> flights{flight("hills", "first", 1, 100), flight("hills", "first", 2, 200),
                               flight("hills", "first", 3, 300), flight("hills", "other", 1, 80),
                               flight("hills", "other", 2, 150), flight("hills", "other", 3, 330)};
  flights[2].status = MissionStatus::failed;
  flights[2].failure = MissionFailure::collision;
  flights.push_back(flight("<plains>", "first", 1, 50));
  return flights;
}

TEST(Tournament, pairs_flights_seed_by_seed_where_both_succeed) {
  const std::vector<WorldResult> worlds = tournament_of(two_worlds());
  ASSERT_EQ(worlds.size(), 2U);
  ASSERT_EQ(worlds[0].differences.size(), 1U);
  const PairedDifference& other = worlds[0].differences[0];
  EXPECT_EQ(other.policy, "other");
  EXPECT_EQ(other.pairs, 2) << "the third seed has no flight to compare with";
  EXPECT_EQ(other.wins, 2);
  EXPECT_DOUBLE_EQ(other.energy_j->median, -35e3);
  EXPECT_DOUBLE_EQ(other.energy_percent->median, -22.5);
  EXPECT_DOUBLE_EQ(other.time_s->median, -70.0);
  EXPECT_TRUE(worlds[1].differences.empty());
}

TEST(Tournament, counts_what_came_later_than_bounded) {
  const std::vector<WorldResult> worlds = tournament_of(two_worlds());
  ASSERT_EQ(worlds[0].decisions.size(), 2U);
  EXPECT_DOUBLE_EQ(worlds[0].decisions[0].overrun_percent->median, 100.0 * 3.0 / 55.0);
  EXPECT_DOUBLE_EQ(worlds[0].decisions[0].budget_use->median, 0.66);
  EXPECT_DOUBLE_EQ(worlds[0].decisions[0].decision_us->median, 2.75);
}

TEST(Tournament, says_nothing_of_late_maps_where_there_are_none) {
  Summary mapless = flight("hills", "first", 1, 100);
  mapless.maps = mapless.bound_overruns = 0;
  const std::vector<WorldResult> worlds = tournament_of({mapless});
  EXPECT_FALSE(worlds[0].decisions[0].overrun_percent);
  EXPECT_FALSE(worlds[0].decisions[0].budget_use);
  EXPECT_TRUE(worlds[0].decisions[0].decision_us);
}

TEST(Tournament, sets_energy_against_a_bound_that_is_known) {
  const KnownBounds bounds{{{"hills", 1}, 40e3}, {{"hills", 2}, 50e3}};
  const std::vector<WorldResult> worlds = tournament_of(two_worlds(), bounds);
  EXPECT_DOUBLE_EQ(worlds[0].decisions[0].over_bound->median, 0.5 * (100.0 / 40.0 + 200.0 / 50.0));
  EXPECT_DOUBLE_EQ(worlds[0].decisions[1].over_bound->median, 0.5 * (80.0 / 40.0 + 150.0 / 50.0));
  EXPECT_FALSE(worlds[1].decisions[0].over_bound);
  EXPECT_NE(to_text(worlds).find("energy / bound"), std::string::npos);
  EXPECT_EQ(to_text(tournament_of(two_worlds())).find("energy / bound"), std::string::npos);
  const std::string page = tournament_page("Tournament", worlds);
  const auto column = page.find("energy over its bound");
  ASSERT_NE(column, std::string::npos);
  EXPECT_EQ(page.find("energy over its bound", column + 1), std::string::npos)
      << "the other world has no bound";
  EXPECT_NE(page.find("3.25", column), std::string::npos);
}

TEST(Tournament, tells_the_computers_energy_apart) {
  std::vector<Summary> flights{flight("hills", "first", 1, 100), flight("hills", "other", 1, 99)};
  flights[0].energy_computer_j = 2000.0;
  flights[1].energy_computer_j = 1500.0;
  EXPECT_DOUBLE_EQ(tournament_of(flights)[0].differences[0].computer_percent->median, -25.0);
  const std::string text = to_text(tournament_of(flights));
  EXPECT_LT(text.find("energy %"), text.find("computer %"));
  EXPECT_LT(text.find("computer %"), text.find("battery %", text.find("less first")));
}

TEST(Tournament, measures_pairs_that_were_asked_for_by_each_other) {
  std::vector<Summary> flights = two_worlds();
  flights.insert(flights.begin() + 6,
                 {flight("hills", "third", 1, 60), flight("hills", "third", 2, 120)});
  const std::vector<WorldResult> worlds = tournament_of(flights, {}, {{"third", "other"}});
  ASSERT_EQ(worlds[0].pairs.size(), 1U);
  EXPECT_EQ(worlds[0].pairs[0].name(), "third less other");
  EXPECT_DOUBLE_EQ(worlds[0].pairs[0].energy_j->median, -25e3);
  EXPECT_TRUE(worlds[1].pairs.empty()) << "neither flew there";
  EXPECT_NE(to_text(worlds).find("third less other"), std::string::npos);
  const auto json = nlohmann::json::parse(to_json(worlds));
  EXPECT_EQ(json[0]["differences"].back()["to"], "other");
  const std::string page = tournament_page("Tournament", worlds);
  const auto table = page.find("Pairs over all worlds");
  ASSERT_NE(table, std::string::npos);
  EXPECT_NE(page.find("<td>third less other</td><td>-22.5<small>-</small></td><td>-</td>", table),
            std::string::npos);
  EXPECT_EQ(tournament_page("Tournament", tournament_of(two_worlds())).find("Pairs"),
            std::string::npos);
}

TEST(Tournament, holds_bounds_against_what_was_stated_level_by_level) {
  std::vector<Summary> flights{flight("hills", "first", 1, 100), flight("hills", "first", 2, 100)};
  flights[1].status = MissionStatus::failed;
  const std::vector<WorldResult> worlds = tournament_of(flights);
  ASSERT_EQ(worlds[0].latency_bounds.size(), 2U);
  const BoundFigures& fine = worlds[0].latency_bounds[0];
  EXPECT_EQ(fine.resolution_m, 0.15);
  EXPECT_EQ(fine.issued, 80U) << "a flight that failed stated bounds, too";
  EXPECT_DOUBLE_EQ(fine.late_percent(), 5.0);
  EXPECT_DOUBLE_EQ(*fine.most_percent(), 100.0 * 7.0 / 80.0);
  EXPECT_FALSE(worlds[0].latency_bounds[1].most_percent()) << "nothing is stated there";
  BoundFigures few = fine;
  few.issued = 3;
  EXPECT_EQ(few.most_percent(), 100.0) << "more than all cannot be late";
  EXPECT_NE(to_text(worlds).find("latency bounds"), std::string::npos);
  EXPECT_NE(tournament_page("Tournament", worlds).find("Latency bounds"), std::string::npos);
}

TEST(Tournament, counts_how_often_heat_took_clocks_away_where_it_is_known) {
  std::vector<Summary> flights{flight("hills", "first", 1, 100), flight("hills", "other", 1, 99)};
  flights[1].hottest_c = std::nullopt;
  const std::vector<WorldResult> worlds = tournament_of(flights);
  EXPECT_EQ(worlds[0].decisions[0].throttle_events, 2U);
  EXPECT_FALSE(worlds[0].decisions[1].throttle_events);
  EXPECT_NE(to_text(worlds).find("throttled"), std::string::npos);
  flights[0].hottest_c = std::nullopt;
  EXPECT_EQ(to_text(tournament_of(flights)).find("throttled"), std::string::npos);
}

TEST(Tournament, prints_nothing_that_depends_on_the_hosts_speed) {
  std::vector<Summary> slow = two_worlds();
  for (Summary& flight : slow) {
    flight.host_s *= 10.0;
    flight.real_time_factor /= 10.0;
    flight.decision_host_us_p50 *= 10.0;
    flight.decision_host_us_p99 *= 10.0;
    for (auto& [name, kernel] : flight.kernels) {
      kernel.host_ms_mean *= 10.0;
    }
  }
  EXPECT_EQ(to_text(tournament_of(slow)), to_text(tournament_of(two_worlds())));
  EXPECT_EQ(to_json(tournament_of(slow)), to_json(tournament_of(two_worlds())));
  const auto tables = [](const std::string& page) { return page.substr(0, page.find("<svg")); };
  EXPECT_EQ(tables(tournament_page("T", tournament_of(slow))),
            tables(tournament_page("T", tournament_of(two_worlds()))));
}

TEST(Tournament, prints_an_object_for_each_world_in_the_shape_of_a_comparison) {
  const auto json = nlohmann::json::parse(to_json(tournament_of(two_worlds())));
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["scenario"], "hills");
  EXPECT_EQ(json[0]["rows"][0]["collisions"], 1);
  EXPECT_EQ(json[0]["rows"][1]["energy_total_j"]["median"], 150e3);
  EXPECT_EQ(json[0]["differences"][0]["to"], "first");
  EXPECT_EQ(json[0]["differences"][0]["energy_total_j"]["median"], -35e3);
  EXPECT_EQ(json[1]["scenario"], "<plains>");
}

TEST(Tournament, shows_each_world_in_its_page_without_a_network) {
  const std::string page = tournament_page("Tournament", tournament_of(two_worlds()));
  EXPECT_NE(page.find("&lt;plains&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<plains>"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
  for (const char* plot : {"mission time, s", "energy, kJ", "battery, %", "collisions",
                           "latency over its bound", "decision time"}) {
    EXPECT_NE(page.find(plot), std::string::npos) << plot;
  }
}

TEST(Tournament, says_in_words_who_took_how_much_less) {
  const std::string text = to_text(tournament_of(two_worlds()));
  EXPECT_NE(text.find("less first"), std::string::npos);
  EXPECT_NE(text.find("-35.0 [-50.0, -20.0]"), std::string::npos) << text;
}

}  // namespace
}  // namespace flyball

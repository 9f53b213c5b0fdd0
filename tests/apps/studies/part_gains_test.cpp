// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/part_gains.h"

#include "made_flights.h"
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

/// One flight for each energy, seeds from 1 on; 0: it failed.
void add(std::vector<Summary>& flights,
         const std::string& policy,
         std::initializer_list<double> energies_j) {
  std::uint64_t seed = 0;
  for (const double energy_j : energies_j) {
    flights.push_back(made_summary(policy, ++seed));
    flights.back().energy_rotor_j = energy_j;
    flights.back().energy_computer_j = 0.0;
    if (energy_j == 0.0) {
      flights.back().status = MissionStatus::failed;
    }
  }
}

std::vector<PartGain> made_gains() {
  std::vector<Summary> flights;
  add(flights, "all", {100.0, 200.0, 400.0, 0.0});
  add(flights, "no_a", {110.0, 210.0, 480.0, 0.0});
  add(flights, "no_b", {100.0, 200.0, 400.0, 0.0});
  add(flights, "no_c", {90.0, 0.0, 400.0, 0.0});
  add(flights, "no_d", {100.0, 190.0, 404.0, 90.0});
  return part_gains(flights, "all", {{"a", "no_a"}, {"b", "no_b"}, {"c", "no_c"}, {"d", "no_d"}});
}

TEST(PartGains, compares_seed_by_seed_where_both_succeed) {
  const PartGain a = made_gains()[0];
  EXPECT_EQ(a.pairs, 3);
  EXPECT_EQ(a.differ, 3);
  EXPECT_NEAR(a.energy_percent->median, 10.0, 1e-9);
  EXPECT_NEAR(a.energy_percent->lo, 5.0, 1e-9);
  EXPECT_NEAR(*a.mean_percent, 100.0 * (std::cbrt(1.1 * 1.05 * 1.2) - 1.0), 1e-9);
  EXPECT_EQ(a.verdict(), "too few flights");
  EXPECT_EQ(made_gains()[1].differ, 0);
}

TEST(PartGains, says_what_a_part_earns_when_its_interval_does) {
  PartGain gain;
  gain.pairs = 8;
  gain.energy_percent = MedianInterval{5.0, 1.0, 9.0};
  EXPECT_EQ(gain.verdict(), "earns its place");
  gain.energy_percent = MedianInterval{5.0, -1.0, 9.0};
  EXPECT_EQ(gain.verdict(), "nothing beyond its interval");
  gain.energy_percent = MedianInterval{0.02, 0.01, 0.03};
  EXPECT_EQ(gain.verdict(), "nothing beyond its interval") << "nobody would fly for that";
  gain.energy_percent = MedianInterval{-5.0, -9.0, -1.0};
  EXPECT_EQ(gain.verdict(), "costs energy");
}

TEST(PartGains, counts_success) {
  EXPECT_EQ(made_gains()[2].only_whole, 1);
  EXPECT_EQ(made_gains()[2].only_without, 0);
  EXPECT_EQ(made_gains()[3].only_without, 1);
  EXPECT_EQ(made_gains()[2].verdict(), "too few flights");
}

TEST(PartGains, says_that_success_differs_only_where_it_is_no_chance) {
  PartGain gain;
  gain.pairs = 20;
  gain.energy_percent = MedianInterval{5.0, 1.0, 9.0};
  gain.only_whole = 4;
  EXPECT_EQ(gain.verdict(), "earns its place") << "1 in 16";
  gain.only_whole = 5;
  EXPECT_EQ(gain.verdict(), "is needed to arrive") << "1 in 32";
  gain.only_without = 1;
  EXPECT_EQ(gain.verdict(), "earns its place") << "7 in 64";
  gain.only_without = 15;
  EXPECT_EQ(gain.verdict(), "keeps from arriving");
}

TEST(PartGains, has_no_figure_for_what_did_not_fly) {
  const PartGain none = part_gains({}, "all", {{"a", "no_a"}}).front();
  EXPECT_EQ(none.pairs, 0);
  EXPECT_FALSE(none.energy_percent);
  EXPECT_EQ(none.verdict(), "too few flights");
}

TEST(PartGains, is_a_table_a_page_and_json) {
  const auto gains = made_gains();
  EXPECT_NE(to_text("all", gains).find("10.0 [5.0, 20.0]"), std::string::npos)
      << to_text("all", gains);
  EXPECT_NE(to_html("a<b", gains).find("a&lt;b without"), std::string::npos);
  const auto json = nlohmann::json::parse(to_json(gains));
  EXPECT_EQ(json.size(), 4U);
  EXPECT_EQ(json[2]["only_whole_succeeds"], 1);
}

}  // namespace
}  // namespace flyball

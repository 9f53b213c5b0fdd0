// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/tuning.h"

#include "flyball/governors/preset.h"

#include "made_flights.h"
#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Candidate flown(std::initializer_list<double> energies_j, int failures = 0) {
  Candidate candidate;
  for (const double energy_j : energies_j) {
    candidate.flights.push_back(made_summary("a", candidate.flights.size()));
    candidate.flights.back().energy_rotor_j = energy_j;
    candidate.flights.back().energy_computer_j = 0.0;
    candidate.flights.back().policy_faults = 0;
  }
  for (int i = 0; i < failures; ++i) {
    candidate.flights.push_back(made_summary("a", candidate.flights.size()));
    candidate.flights.back().status = MissionStatus::failed;
    candidate.flights.back().policy_faults = 0;
  }
  return candidate;
}

TEST(Tuning, reads_what_to_try) {
  const auto tried = read_tried("range_m=7,15.5,25");
  ASSERT_TRUE(tried);
  EXPECT_EQ(tried->name, "range_m");
  EXPECT_EQ(tried->values, (std::vector<double>{7.0, 15.5, 25.0}));
  for (const char* text :
       {"range_m", "=7", "range_m=", "range_m=7,", "range_m=7,x", "a=1,2,1", "a=nan", "a=1,inf"}) {
    const auto refused = read_tried(text);
    ASSERT_FALSE(refused) << text;
    EXPECT_NE(refused.error().message.find(text), std::string::npos);
  }
}

TEST(Tuning, refuses_a_parameter_that_comes_twice) {
  const auto both = read_all_tried({"a=1,2", "b=3"});
  ASSERT_TRUE(both);
  EXPECT_EQ((*both)[1].name, "b");
  const auto twice = read_all_tried({"a=1,2", "b=3", "a=4"});
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().message.find("--try a=4 names a parameter that another --try has"),
            std::string::npos);
}

TEST(Tuning, tries_every_combination) {
  const auto all = combinations({{"a", {1.0, 2.0}}, {"b", {3.0, 4.0, 5.0}}});
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(all[1].parameters, (std::map<std::string, double>{{"a", 1.0}, {"b", 4.0}}));
  EXPECT_EQ(combinations({}).size(), 1U);
}

TEST(Tuning, success_comes_before_energy) {
  EXPECT_TRUE(is_better(flown({9e3, 9e3}), flown({1e3}, 1)));
  EXPECT_TRUE(is_better(flown({1e3, 3e3}), flown({2e3, 2.5e3})));
  EXPECT_FALSE(is_better(flown({2e3}), flown({2e3})));
}

TEST(Tuning, a_policy_that_was_replaced_has_failed) {
  Candidate replaced = flown({1e3, 1e3});
  replaced.flights[1].policy_faults = 400;
  EXPECT_EQ(replaced.failures(), 1);
  EXPECT_TRUE(is_better(flown({9e3, 9e3}), replaced));
  replaced.flights[1].energy_rotor_j = 5e3;
  EXPECT_EQ(replaced.mean_energy_j(), 1e3) << "what safe settings took says nothing";
  EXPECT_EQ(replaced.median_energy_j(), 1e3);
  const std::string text = to_text("bad", {flown({9e3, 9e3}), replaced});
  EXPECT_NE(text.find("1/2"), std::string::npos) << text;
  EXPECT_NE(text.find("policy bad was replaced by safe settings in 400 of 1600 decisions"),
            std::string::npos)
      << text;
  EXPECT_NE(to_json("s", "bad", {replaced}).find("\"policy_faults\": 400"), std::string::npos);
  EXPECT_EQ(to_text("good", {flown({9e3})}).find("policy"), std::string::npos);
}

TEST(Tuning, halves_the_candidates_while_the_seeds_double) {
  const auto rounds = tuning_rounds(12, 8);
  ASSERT_EQ(rounds.size(), 3U);
  EXPECT_EQ(rounds[0].candidates, 12U);
  EXPECT_EQ(rounds[0].seeds, 2U);
  EXPECT_EQ(rounds[1].candidates, 6U);
  EXPECT_EQ(rounds[1].seeds, 4U);
  EXPECT_EQ(rounds[2].candidates, 3U);
  EXPECT_EQ(rounds[2].seeds, 8U);
  const auto one = tuning_rounds(1, 5);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].seeds, 5U);
  EXPECT_EQ(tuning_rounds(100, 1).size(), 1U);
}

TEST(Tuning, writes_a_preset_that_reads_back) {
  const ScratchFolder folder;
  Candidate candidate;
  candidate.parameters = {{"range_m", 7.0}, {"resolution_m", 0.15}};
  const auto preset = load_preset(
      folder.file("tuned.toml", preset_text("fixed", "Tuned for \"x\" \\ y", candidate)));
  ASSERT_TRUE(preset) << preset.error().message;
  EXPECT_EQ(preset->policy, "fixed");
  EXPECT_EQ(preset->description, "Tuned for \"x\" \\ y");
  EXPECT_EQ(std::get<double>(preset->parameters.at("resolution_m")), 0.15);
}

TEST(Tuning, shows_what_never_succeeded_without_a_figure) {
  const std::string text = to_text("fixed", {flown({2e3, 4e3}), flown({}, 2)});
  EXPECT_NE(text.find("3.00"), std::string::npos) << text;
  EXPECT_NE(text.find("0/2"), std::string::npos) << text;
  EXPECT_NE(to_json("s", "fixed", {flown({}, 2)}).find("null"), std::string::npos);
}

}  // namespace
}  // namespace flyball

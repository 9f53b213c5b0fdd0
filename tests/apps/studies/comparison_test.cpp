// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/comparison.h"

#include "made_flights.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

Summary flight(const std::string& policy, std::uint64_t seed, double time_s, double used_percent) {
  Summary summary = made_summary(policy, seed);
  summary.mission_time_s = time_s;
  summary.battery_end_percent = 100.0 - used_percent;
  return summary;
}

Summary failed(const std::string& policy, std::uint64_t seed, MissionFailure failure) {
  Summary summary = flight(policy, seed, 1e6, 100.0);
  summary.status = MissionStatus::failed;
  summary.failure = failure;
  return summary;
}

Comparison made_comparison() {
  return compare_flights({flight("slow", 1, 100, 20), flight("slow", 2, 200, 40),
                          failed("slow", 3, MissionFailure::collision), flight("fast", 1, 50, 5),
                          failed("fast", 2, MissionFailure::no_plan), flight("fast", 3, 60, 6)});
}

TEST(Comparison, counts_flights_by_their_end) {
  const Comparison comparison = made_comparison();
  ASSERT_EQ(comparison.rows.size(), 2U);
  EXPECT_EQ(comparison.seeds, (std::vector<std::uint64_t>{1, 2, 3}));
  const ComparisonRow& slow = comparison.rows[0];
  EXPECT_EQ(slow.policy, "slow") << "the order of the flights";
  EXPECT_EQ(slow.n, 3);
  EXPECT_EQ(slow.succeeded, 2);
  EXPECT_EQ(slow.collisions, 1);
  EXPECT_EQ(comparison.rows[1].failures, (std::map<std::string, int>{{"no_plan", 1}}));
  EXPECT_EQ(comparison.rows[1].collisions, 0);
}

TEST(Comparison, medians_are_over_succeeded_flights_only) {
  const ComparisonRow slow = made_comparison().rows[0];
  EXPECT_EQ(slow.mission_time_s->median, 150.0);
  EXPECT_EQ(slow.mission_time_s->lo, 100.0);
  EXPECT_EQ(slow.mission_time_s->hi, 200.0);
  EXPECT_EQ(slow.battery_used_percent->median, 30.0);
}

TEST(Comparison, ratios_pair_the_seeds_where_both_succeed) {
  const Comparison comparison = made_comparison();
  EXPECT_EQ(comparison.rows[0].battery_ratio->median, 1.0);
  EXPECT_EQ(comparison.rows[1].pairs, 1);
  EXPECT_EQ(comparison.rows[1].battery_ratio->median, 0.25) << "seed 1 alone";
  EXPECT_EQ(comparison.rows[1].time_ratio->median, 0.5);
}

TEST(Comparison, a_policy_that_never_succeeds_has_no_medians) {
  const Comparison comparison =
      compare_flights({flight("a", 1, 100, 20), failed("b", 1, MissionFailure::time_limit)});
  EXPECT_FALSE(comparison.rows[1].mission_time_s.has_value());
  EXPECT_FALSE(comparison.rows[1].battery_ratio.has_value());
  const auto json = nlohmann::json::parse(to_json(comparison));
  EXPECT_TRUE(json["rows"][1]["mission_time_s"]["median"].is_null());
}

TEST(Comparison, json_has_exactly_the_documented_keys) {
  const auto json = nlohmann::ordered_json::parse(to_json(made_comparison()));
  const auto keys = [](const nlohmann::ordered_json& object) {
    std::string all;
    for (const auto& [key, value] : object.items()) {
      all += key + " ";
    }
    return all;
  };
  EXPECT_EQ(keys(json), "scenario seeds rows ");
  EXPECT_EQ(keys(json["rows"][0]),
            "policy n succeeded collisions failures policy_faults policy_trouble mission_time_s "
            "energy_total_j battery_used_percent mean_speed_m_s latency_p50_s pairs battery_ratio "
            "time_ratio ");
  EXPECT_EQ(json["rows"][1]["pairs"], made_comparison().rows[1].pairs);
  EXPECT_EQ(json["rows"][1]["time_ratio"]["median"], made_comparison().rows[1].time_ratio->median);
  EXPECT_EQ(keys(json["rows"][0]["latency_p50_s"]), "median lo hi ");
  EXPECT_EQ(json["rows"][1]["failures"]["no_plan"], 1);
}

TEST(Comparison, the_table_has_a_row_a_policy_and_says_what_it_shows) {
  const std::string text = to_text(made_comparison());
  EXPECT_NE(text.find("slow    2/3      1           150.0 [100.0, 200.0]"), std::string::npos)
      << text;
  EXPECT_NE(text.find("fast failed: no_plan 1"), std::string::npos) << text;
  EXPECT_NE(text.find("over succeeded flights only, seeds 1..3"), std::string::npos) << text;
  EXPECT_NE(text.find("Ratios are to slow"), std::string::npos) << text;
}

TEST(Comparison, says_in_one_sentence_that_a_policy_was_replaced) {
  std::vector<Summary> flights{flight("good", 1, 1, 1), flight("bad", 1, 1, 1),
                               flight("bad", 2, 1, 1)};
  flights[0].policy_faults = 0;
  flights[2].policy_trouble = "a later one";
  const std::string sentence =
      "policy bad was replaced by safe settings in 20 of 800 decisions (after some faults in a row "
      "it is not asked again): threw: ";
  const Comparison comparison = compare_flights(flights);
  EXPECT_NE(to_text(comparison).find(sentence + "<enough>\n"), std::string::npos)
      << to_text(comparison);
  EXPECT_NE(to_html(comparison).find(sentence + "&lt;enough&gt;"), std::string::npos);
  EXPECT_EQ(to_text(comparison).find("policy good"), std::string::npos);
}

TEST(Comparison, seeds_are_written_short) {
  EXPECT_EQ(seeds_text({1, 2, 3, 4}), "1..4");
  EXPECT_EQ(seeds_text({1, 2}), "1, 2");
  EXPECT_EQ(seeds_text({1, 5, 9}), "1, 5, 9");
}

TEST(Comparison, names_cannot_break_the_page) {
  const std::string page = to_html(compare_flights({flight("<b>", 1, 1, 1)}));
  EXPECT_EQ(page.find("<b>"), std::string::npos);
}

}  // namespace
}  // namespace flyball

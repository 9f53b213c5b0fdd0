// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/summary.h"

#include "made_flights.h"
#include "records/summary_reader.h"
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

TEST(Summary, reads_back_what_was_written) {
  const Summary written = made_summary("two_level", 18446744073709551615ULL);
  Summary read;
  ASSERT_TRUE(from_json(to_json(written), read));
  EXPECT_EQ(to_json(read), to_json(written));
  EXPECT_EQ(read.distance_m, written.distance_m) << "to the last bit";
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.kernels.at("octomap").calls, 123U);
  EXPECT_EQ(read.quality.at("area_covered_percent"), 97.25);
  EXPECT_EQ(read.policy_trouble, "threw: <enough>");
  ASSERT_EQ(read.latency_bounds.size(), 2U);
  EXPECT_EQ(read.latency_bounds[0].most_late, 3.5);
  EXPECT_FALSE(read.latency_bounds[1].most_late);
}

TEST(Summary, every_status_and_failure_reads_back) {
  Summary summary = made_summary("a", 1);
  for (const auto status :
       {MissionStatus::succeeded, MissionStatus::failed, MissionStatus::interrupted}) {
    for (const auto failure :
         {MissionFailure::none, MissionFailure::collision, MissionFailure::battery_empty,
          MissionFailure::no_plan, MissionFailure::time_limit, MissionFailure::target_lost,
          MissionFailure::localization_lost, MissionFailure::not_found,
          MissionFailure::incomplete}) {
      summary.status = status;
      summary.failure = failure;
      Summary read;
      ASSERT_TRUE(from_json(to_json(summary), read));
      EXPECT_EQ(read.status, status);
      EXPECT_EQ(read.failure, failure);
    }
  }
}

TEST(Summary, derived_figures_are_written_out) {
  const auto json = nlohmann::json::parse(to_json(made_summary("a", 1)));
  EXPECT_EQ(json["energy_j"]["total"], 31000.75);
  EXPECT_EQ(json["battery_used_percent"], 20.0);
  EXPECT_EQ(json["latency_s"]["p95"], 0.22);
}

TEST(Summary, has_exactly_the_documented_keys) {
  const auto json = nlohmann::json::parse(to_json(made_summary("a", 1)));
  const auto keys = [](const nlohmann::json& object) {
    std::set<std::string> all;
    for (const auto& [key, value] : object.items()) {
      all.insert(key);
    }
    return all;
  };
  using Keys = std::set<std::string>;
  EXPECT_EQ(keys(json), (Keys{"scenario",
                              "policy",
                              "seed",
                              "status",
                              "failure",
                              "mission_time_s",
                              "energy_j",
                              "battery_start_percent",
                              "battery_end_percent",
                              "battery_used_percent",
                              "distance_m",
                              "mean_speed_m_s",
                              "max_speed_m_s",
                              "hover_time_s",
                              "min_clearance_m",
                              "replans",
                              "deadline_misses",
                              "decisions",
                              "knob_changes",
                              "policy_faults",
                              "policy_trouble",
                              "latency_s",
                              "maps",
                              "bound_overruns",
                              "budget_use_p50",
                              "latency_bounds",
                              "decision_host_us",
                              "throttle_events",
                              "hottest_c",
                              "kernels",
                              "quality",
                              "host_s",
                              "real_time_factor",
                              "trace_hash",
                              "numeric_fingerprint",
                              "version"}));
  EXPECT_EQ(keys(json["energy_j"]), (Keys{"rotor", "computer", "total"}));
  EXPECT_EQ(keys(json["latency_s"]), (Keys{"p50", "p95", "max"}));
  EXPECT_EQ(keys(json["kernels"]["octomap"]),
            (Keys{"calls", "mission_ms_mean", "mission_ms_p95", "host_ms_mean"}));
  EXPECT_EQ(json["battery_start_percent"], 100.0);
  EXPECT_EQ(json["battery_end_percent"], 80.0);
}

TEST(Summary, a_clearance_without_obstacles_stays_infinite) {
  Summary summary = made_summary("a", 1);
  summary.min_clearance_m = std::numeric_limits<double>::infinity();
  Summary read;
  ASSERT_TRUE(from_json(to_json(summary), read));
  EXPECT_EQ(read.min_clearance_m, summary.min_clearance_m);
}

TEST(Summary, what_is_no_summary_is_refused_and_changes_nothing) {
  Summary kept = made_summary("kept", 1);
  auto json = nlohmann::json::parse(to_json(made_summary("other", 2)));
  json["status"] = "flown";
  for (const std::string& text :
       {std::string{}, std::string{"{}"}, std::string{"[1"}, json.dump()}) {
    EXPECT_FALSE(from_json(text, kept)) << text;
  }
  EXPECT_EQ(kept.policy, "kept");
}

TEST(Summary, a_count_that_is_none_is_named) {
  const auto good = nlohmann::json::parse(to_json(made_summary("a", 1)));
  Summary kept = made_summary("kept", 1);
  for (const char* key : {"seed", "replans", "deadline_misses", "decisions", "knob_changes",
                          "policy_faults", "maps", "bound_overruns", "throttle_events"}) {
    for (const char* value : {"-1", "1e300", "18446744073709551616", "2.5", "null", "\"7\""}) {
      auto json = good;
      json[key] = nlohmann::json::parse(value);
      const auto read = read_summary(json.dump());
      ASSERT_FALSE(read.ok()) << key << " " << value;
      EXPECT_NE(read.error().message.find(std::string{key} + " = "), std::string::npos)
          << read.error().message;
    }
  }
  auto json = good;
  json["replans"] = 3000000000U;
  EXPECT_FALSE(from_json(json.dump(), kept)) << "more than an int holds";
  json = good;
  json["kernels"]["octomap"]["calls"] = -1;
  EXPECT_FALSE(from_json(json.dump(), kept));
  EXPECT_EQ(kept.policy, "kept");
}

TEST(Summary, a_number_that_was_not_finite_is_named) {
  for (const char* member :
       {"/mission_time_s", "/energy_j/rotor", "/latency_s/p95", "/kernels/octomap/mission_ms_mean",
        "/quality/area_covered_percent", "/host_s"}) {
    auto json = nlohmann::json::parse(to_json(made_summary("a", 1)));
    const nlohmann::json::json_pointer place{member};
    json.at(place) = nullptr;
    const auto read = read_summary(json.dump());
    ASSERT_FALSE(read.ok()) << member;
    EXPECT_NE(read.error().message.find(place.back() + " = null is no number"), std::string::npos)
        << read.error().message;
  }
}

TEST(Summary, says_that_no_obstacle_was_near) {
  Summary summary = made_summary("a", 1);
  EXPECT_EQ(clearance_text(summary), "0.44");
  summary.min_clearance_m = farthest_clearance_m;
  EXPECT_EQ(clearance_text(summary), "5.00 or more");
}

}  // namespace
}  // namespace flyball

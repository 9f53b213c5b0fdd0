// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/apps/summary.h"

#include "made_flights.h"
#include <limits>

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
}

TEST(Summary, every_status_and_failure_reads_back) {
  Summary summary = made_summary("a", 1);
  for (const auto status :
       {MissionStatus::succeeded, MissionStatus::failed, MissionStatus::interrupted}) {
    for (const auto failure :
         {MissionFailure::none, MissionFailure::collision, MissionFailure::battery_empty,
          MissionFailure::no_plan, MissionFailure::time_limit}) {
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
  EXPECT_EQ(json["battery_percent"]["used"], 20.0);
  EXPECT_EQ(json["latency_s"]["p95"], 0.22);
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

}  // namespace
}  // namespace flyball

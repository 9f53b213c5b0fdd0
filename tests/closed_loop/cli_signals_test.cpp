// SPDX-License-Identifier: BSD-3-Clause
//
// What happens when somebody stops the command in the middle of its flights.

#include "flyball_process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr const char* run_of_seed_1 = "out/runs/fixed_fine/seed_1";

Words long_run() {
  return {"run", "delivery_outdoor_to_indoor", "--out", run_of_seed_1};
}

Words long_comparison() {
  return {"compare", "delivery_outdoor_to_indoor", "--policies", "fixed_fine", "--out", "out"};
}

Words long_tournament() {
  return {"tournament", "--worlds",   "delivery_outdoor_to_indoor",
          "--policies", "fixed_fine", "--seeds",
          "1..2",       "--jobs",     "2",
          "--out",      "out"};
}

TEST(CliSignals, a_run_ends_with_its_partial_record_and_says_so) {
  for (const auto& [signal, exit_code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
    const FlyballProgram flyball;
    FlyballProcess process{flyball, long_run()};
    process.wait_for_file(run_of_seed_1);
    process.send(signal);
    EXPECT_EQ(process.exit_code(), exit_code);
    EXPECT_NE(process.errors().find("interrupted; the record ends early: out/runs"),
              std::string::npos)
        << process.errors();
    const std::string folder = run_of_seed_1 + std::string{"/"};
    const auto summary = nlohmann::json::parse(flyball.place.content(folder + "summary.json"));
    EXPECT_EQ(summary["status"], "interrupted");
    EXPECT_EQ(flyball.place.content(folder + "mission.toml").rfind("# Interrupted", 0), 0U);
  }
}

TEST(CliSignals, a_comparison_ends_with_its_missions) {
  for (const auto& [signal, exit_code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
    const FlyballProgram flyball;
    FlyballProcess process{flyball, long_comparison()};
    process.wait_for_file(run_of_seed_1);
    process.send(signal);
    EXPECT_EQ(process.exit_code(), exit_code);
    EXPECT_NE(process.errors().find("the same command goes on from here"), std::string::npos)
        << process.errors();
    const auto summary =
        nlohmann::json::parse(flyball.place.content(run_of_seed_1 + std::string{"/summary.json"}));
    EXPECT_EQ(summary["status"], "interrupted");
    EXPECT_FALSE(fs::exists(flyball.place.path("out/report.html")));
  }
}

TEST(CliSignals, no_mission_outlives_a_tournament) {
  for (const int signal : {SIGTERM, SIGHUP, SIGKILL}) {
    const FlyballProgram flyball;
    FlyballProcess process{flyball, long_tournament()};
    process.wait_for_file("out/flights/delivery_outdoor_to_indoor/runs/fixed_fine/seed_2");
    const std::vector<pid_t> missions = process.children();
    EXPECT_EQ(missions.size(), 2U);
    process.send(signal);
    EXPECT_EQ(process.exit_code(), signal == SIGKILL ? -SIGKILL : 128 + signal);
    for (const pid_t mission : missions) {
      FlyballProcess::wait_for_end(mission);  // For ever, if it lived on.
    }
  }
}

TEST(CliSignals, that_are_ignored_as_under_nohup_stay_so) {
  const FlyballProgram flyball;
  FlyballProcess process{flyball, long_comparison(), {SIGHUP}};
  process.wait_for_file(run_of_seed_1);
  process.send(SIGHUP);
  process.send(SIGTERM);
  EXPECT_EQ(process.exit_code(), 143) << "not 129";
}

/// Two of one command at once in one folder, and what both printed.
void expect_both_finish(const FlyballProgram& flyball,
                        const Words& words,
                        const std::string& first_policies,
                        const std::string& second_policies) {
  const auto with = [&words](const std::string& policies) {
    Words all = words;
    all.insert(all.end(), {"--policies", policies});
    return all;
  };
  FlyballProcess first{flyball, with(first_policies)};
  FlyballProcess second{flyball, with(second_policies)};
  EXPECT_EQ(first.exit_code(), 0) << first.errors();
  EXPECT_EQ(second.exit_code(), 0) << second.errors();
  for (const auto& [process, policies] :
       {std::pair{&first, first_policies}, {&second, second_policies}}) {
    const auto printed = nlohmann::json::parse(process->output());
    const auto& rows = (printed.is_array() ? printed[0] : printed)["rows"];
    ASSERT_EQ(rows.size(), 2U);
    for (const auto& row : rows) {
      EXPECT_EQ(row["succeeded"], 2) << policies;
    }
  }
}

TEST(CliSignals, two_at_once_in_one_folder_both_finish_without_loss) {
  const FlyballProgram flyball;
  const std::string near =
      flyball.place.file("near.toml",
                         "name = \"near\"\n[world]\ngenerator = \"empty\"\ngoal_distance_m = 5.0\n"
                         "[camera]\nwidth_px = 32\nheight_px = 18\n");
  const Words tournament{"tournament", "--worlds", near, "--seeds", "1..2", "--out", "t", "--json"};
  expect_both_finish(flyball, tournament, "fixed_fine,fixed_coarse", "fixed_fine,fixed_coarse");
  expect_both_finish(flyball, tournament, "fixed_fine,two_level", "fixed_coarse,schedutil_10ms");
  EXPECT_FALSE(fs::exists(flyball.place.path("t/near"))) << "no flight is left uncounted";
  const Words comparison{"compare", near, "--seeds", "1..2", "--out", "c", "--json"};
  expect_both_finish(flyball, comparison, "fixed_fine,fixed_coarse", "fixed_fine,fixed_coarse");
}

TEST(CliSignals, a_run_waits_for_its_folder_and_can_be_ended_meanwhile) {
  const FlyballProgram flyball;
  const std::string near =
      flyball.place.file("near.toml",
                         "name = \"near\"\n[world]\ngenerator = \"empty\"\ngoal_distance_m = 5.0\n"
                         "[camera]\nwidth_px = 32\nheight_px = 18\n");
  const std::string place = flyball.place.path("r");
  fs::create_directory(place);
  const int folder = open(place.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(folder, LOCK_EX), 0);
  const Words run{"run", near, "--out", "r"};
  FlyballProcess ended{flyball, run};
  ended.wait_for_words("another flyball flies into \"r\"");
  ended.send(SIGINT);
  EXPECT_EQ(ended.exit_code(), -SIGINT);
  EXPECT_TRUE(fs::is_empty(place));
  FlyballProcess patient{flyball, run};
  patient.wait_for_words("another flyball flies into \"r\"");
  flock(folder, LOCK_UN);
  EXPECT_EQ(patient.exit_code(), 0) << patient.errors();
  EXPECT_TRUE(fs::exists(place + "/mission.toml"));
  close(folder);
}

}  // namespace

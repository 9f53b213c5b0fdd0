// SPDX-License-Identifier: BSD-3-Clause

#include "flyball_program.h"
#include "made_slurm.h"
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;

/// Flights of a few seconds that the host flies in less than one.
constexpr const char* short_sweep =
    "sweep delivery_forest --set world.generator=empty --set name=short --set camera.width_px=32 "
    "--set camera.height_px=18 --over world.goal_distance_m=5,7 --over vehicle.payload_kg=0.2,0.5 ";

TEST(CliSweep, flies_every_combination_and_goes_on_where_it_was_stopped) {
  const FlyballProgram flyball;
  const std::string line = std::string{short_sweep} + "--out s --json --jobs 2 ";
  const auto half = flyball.run(line + "--seeds 1");
  ASSERT_EQ(half.exit_code, 0) << half.errors;
  const auto whole = flyball.run(line + "--seeds 1..2");
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  EXPECT_NE(whole.errors.find("4 of 8 flights are known from before"), std::string::npos)
      << whole.errors;
  const auto sweep = nlohmann::json::parse(whole.output);
  ASSERT_EQ(sweep["cells"].size(), 4U);
  EXPECT_EQ(sweep["cells"][0]["policy"], "fixed_fine") << "the scenario's own";
  for (const auto& cell : sweep["cells"]) {
    EXPECT_EQ(cell["n"], 2);
    EXPECT_EQ(cell["succeeded"], 2);
  }
  const auto time = [&](int cell) { return sweep["cells"][cell]["figures"]["mission_time_s"]; };
  EXPECT_LT(time(0)["median"], time(2)["median"]) << "5 m and 7 m";
  for (const char* file : {"s/sweep.html", "s/cells.csv", "s/flights.csv", "s/sweep.db"}) {
    EXPECT_TRUE(fs::exists(flyball.place.path(file))) << file;
  }
  EXPECT_FALSE(fs::exists(flyball.place.path("s/flights"))) << "records go when they are counted";

  const auto kept = flyball.run(line + "--seeds 1 --keep-records");
  ASSERT_EQ(kept.exit_code, 0) << kept.errors;
  std::size_t records = 0;
  for (const auto& entry : fs::recursive_directory_iterator{flyball.place.path("s/flights")}) {
    records += entry.path().filename() == "trace.jsonl" ? 1 : 0;
  }
  EXPECT_EQ(records, 4U) << "known flights whose records are gone fly again";
}

/// What stands between `before` and `after`.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t from = text.find(before) + before.size();
  return text.substr(from, text.find(after, from) - from);
}

TEST(CliSweep, the_command_of_a_flight_flies_it_again) {
  const FlyballProgram flyball;
  const auto flown = flyball.run(std::string{short_sweep} + "--out s --seeds 2 --jobs 2");
  ASSERT_EQ(flown.exit_code, 0) << flown.errors;
  const std::string rows = flyball.place.content("s/flights.csv");
  const std::string first = rows.substr(rows.find("\nfixed_fine,") + 1);
  const std::string hash = between(first, "succeeded,none,", ",");
  const std::string command = between(first, hash + ",flyball ", ",");
  const auto again = flyball.run(command + " --json --out again");
  ASSERT_EQ(again.exit_code, 0) << command << "\n" << again.errors;
  EXPECT_EQ(nlohmann::json::parse(again.output)["trace_hash"], hash) << command;
}

TEST(CliSweep, refuses_what_cannot_be_swept_before_anything_flies) {
  const FlyballProgram flyball;
  const struct {
    const char* arguments;
    const char* sentence;
  } refused[] = {
      {"--over map.range_m=", "has an empty value"},
      {"--over map.range_cm=1,2", "no setting \"map.range_cm\" (--over); did you mean map.range_m"},
      {"--over map.range_m=5,far", "map.range_m"},
      {"--over map.range_m=5 --over map.range_m=6", "names map.range_m twice"},
      {"--over map.range_m=5 --set map.range_m=6", "is one of --over, too"},
      {"--over seed=1,2", "give --seeds"},
      {"--over governor.policy=fixed_fine,fixed_coarse", "give --policies"},
      {"--over map.range_m=5 --on moon", "--on"},
      {"--over map.range_m=5 --on slurm --jobs 2", "--on"},
      {"", "--over is required"},
  };
  for (const auto& [arguments, sentence] : refused) {
    const auto outcome = flyball.run(std::string{"sweep delivery_forest "} + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.errors.find(sentence), std::string::npos) << arguments << "\n"
                                                                << outcome.errors;
    EXPECT_TRUE(flyball.place.is_empty()) << arguments;
  }
}

TEST(CliSweep, flies_the_same_as_an_array_of_slurm_also_when_tasks_die_or_run_twice) {
  const FlyballProgram here;
  const auto expected = here.run(std::string{short_sweep} + "--out s --json --seeds 1..2 --jobs 2");
  ASSERT_EQ(expected.exit_code, 0) << expected.errors;

  const FlyballProgram flyball;
  // In the first array the second task never starts, the third is killed at once, the fourth runs
  // twice; then all is well.
  const MadeSlurm slurm{flyball, R"(
    arrays=$(wc -l < slurm_programs/arrays)
    case $arrays.$task in
      1.2) ;;
      1.3) timeout --signal=KILL 0.05 sh "$script" ;;
      1.4) sh "$script" & sh "$script"; wait ;;
      *) sh "$script" ;;
    esac)"};
  const auto flown =
      flyball.run(std::string{short_sweep} + "--out s --json --seeds 1..2 --on slurm");
  ASSERT_EQ(flown.exit_code, 0) << flown.errors;
  EXPECT_EQ(flown.output, expected.output);
  EXPECT_EQ(flyball.place.content("slurm_programs/arrays"), "array\narray\n") << flown.errors;
  EXPECT_EQ(flyball.place.content("s/flights.csv"), here.place.content("s/flights.csv"));
}

TEST(CliSweep, says_where_to_look_when_a_cluster_brings_nothing) {
  const FlyballProgram flyball;
  const MadeSlurm slurm{flyball, "false"};
  const auto flown = flyball.run(std::string{short_sweep} + "--out s --seeds 1 --on slurm");
  EXPECT_EQ(flown.exit_code, 1);
  EXPECT_NE(flown.errors.find("4 flights are missing, and the last array brought none"),
            std::string::npos)
      << flown.errors;
  EXPECT_EQ(flyball.place.content("slurm_programs/arrays"), "array\n") << "not for ever";
}

TEST(CliSweep, says_that_there_is_no_slurm) {
  const FlyballProgram flyball;
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const auto outcome = flyball.run(std::string{short_sweep} + "--out s --seeds 1 --on slurm");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("install slurm-client, or leave --on out"), std::string::npos)
      << outcome.errors;
}

}  // namespace

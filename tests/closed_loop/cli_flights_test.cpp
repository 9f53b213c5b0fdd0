// SPDX-License-Identifier: BSD-3-Clause

#include "flyball_program.h"
#include <csignal>
#include <filesystem>
#include <map>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

/// A flight of some 20 s that takes the host a second or two.
constexpr const char* short_flight =
    "delivery_forest --set world.generator=empty --set world.goal_distance_m=5 --set name=short "
    "--set camera.width_px=32 --set camera.height_px=18 ";

TEST(CliFlights, a_run_leaves_its_record_and_its_summary) {
  const FlyballProgram flyball;
  const auto outcome = flyball.run(std::string{"run "} + short_flight + "--seed 3 --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors << outcome.output;
  EXPECT_EQ(outcome.errors, "") << "nobody watches";
  const auto summary = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(summary["status"], "succeeded");
  EXPECT_EQ(summary["seed"], 3);
  const std::string folder = "flights/short/runs/fixed_fine/seed_3/";
  EXPECT_EQ(flyball.place.content(folder + "summary.json"), outcome.output);
  for (const char* file : {"mission.toml", "trace.jsonl", "report.html"}) {
    EXPECT_TRUE(fs::exists(flyball.place.path(folder + file))) << file;
  }
}

TEST(CliFlights, a_result_that_cannot_be_printed_is_told_and_leaves_its_record) {
  const FlyballProgram flyball;
  const std::string policies = "--policies fixed_fine,fixed_coarse --jobs 1 ";
  for (const std::string& command :
       {std::string{"run "} + short_flight + "--out r",
        std::string{"run "} + short_flight + "--json",
        std::string{"compare "} + short_flight + policies + "--out c",
        std::string{"compare "} + short_flight + policies + "--out c --json",
        std::string{"replay r"}, std::string{"replay r --policy fixed_coarse"},
        std::string{"explain r --at 3"}}) {
    const auto full = flyball.run_into("> /dev/full", command);
    EXPECT_EQ(full.exit_code, 2) << command;
    EXPECT_NE(full.errors.find("standard output: No space left on device"), std::string::npos)
        << command << "\n"
        << full.errors;
  }
  EXPECT_TRUE(fs::exists(flyball.place.path("r/mission.toml")));
  EXPECT_TRUE(fs::exists(flyball.place.path("c/report.html")));
}

TEST(CliFlights, explains_a_choice_with_no_more_digits_than_it_has) {
  const FlyballProgram flyball;
  ASSERT_EQ(flyball.run(std::string{"run "} + short_flight + "--out r").exit_code, 0);
  ASSERT_NE(flyball.place.content("r/trace.jsonl").find("=0.14999999999999999"), std::string::npos)
      << "the record itself is exact";
  const auto told = flyball.run("explain r --at 3");
  EXPECT_NE(told.output.find("It chose fixed: map.resolution_m=0.15\n"), std::string::npos)
      << told.output;
}

TEST(CliFlights, a_failed_mission_is_a_result) {
  const FlyballProgram flyball;
  const auto outcome =
      flyball.run(std::string{"run "} + short_flight + "--set mission.time_limit_s=2 --json");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
  EXPECT_EQ(nlohmann::json::parse(outcome.output)["failure"], "time_limit");
}

TEST(CliFlights, a_comparison_takes_the_scenarios_step_for_it_unless_one_is_given) {
  const FlyballProgram flyball;
  const std::string line = std::string{"compare "} + short_flight +
                           "--set vehicle.comparison_step_s=0.004 --policies fixed_fine --jobs 1 ";
  const auto step_of = [&](const char* folder) {
    const std::string mission =
        flyball.place.content(std::string{folder} + "/runs/fixed_fine/seed_1/mission.toml");
    const std::size_t at = mission.find("physics_step_s");
    return mission.substr(at, mission.find('\n', at) - at);
  };
  EXPECT_EQ(flyball.run(line + "--out its").exit_code, 0);
  EXPECT_EQ(step_of("its"), "physics_step_s = 0.004");
  EXPECT_EQ(flyball.run(line + "--out given --set vehicle.physics_step_s=0.002").exit_code, 0);
  EXPECT_EQ(step_of("given"), "physics_step_s = 0.002");
}

TEST(CliFlights, a_comparison_flies_each_mission_once) {
  const FlyballProgram flyball;
  const std::string line = std::string{"compare "} + short_flight +
                           "--policies fixed_fine,fixed_coarse --seeds 1..2 --json ";
  const auto first = flyball.run(line + "--jobs 2");
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  const auto table = nlohmann::json::parse(first.output);
  EXPECT_EQ(table["seeds"], nlohmann::json::parse("[1, 2]"));
  ASSERT_EQ(table["rows"].size(), 2U);
  EXPECT_EQ(table["rows"][0]["policy"], "fixed_fine");
  EXPECT_EQ(table["rows"][0]["n"], 2);
  EXPECT_TRUE(fs::exists(flyball.place.path("flights/short/report.html")));

  const std::string kept = "flights/short/runs/fixed_coarse/seed_2/summary.json";
  const auto written = fs::last_write_time(flyball.place.path(kept));
  fs::remove(flyball.place.path("flights/short/runs/fixed_fine/seed_1/summary.json"));
  const auto again = flyball.run(line + "--jobs 1");
  EXPECT_EQ(again.output, first.output) << "with other jobs, and from records";
  EXPECT_NE(again.errors.find("3 of 4 flights are taken from flights/short"), std::string::npos)
      << again.errors;
  EXPECT_EQ(fs::last_write_time(flyball.place.path(kept)), written);
}

TEST(CliFlights, a_record_of_somebody_else_is_refused_in_a_sentence_and_runs_no_code) {
  const FlyballProgram flyball;
  ASSERT_EQ(flyball.run(std::string{"run "} + short_flight + "--out r").exit_code, 0);
  const std::string summary = flyball.place.content("r/summary.json");
  std::string mission = flyball.place.content("r/mission.toml");
  static_cast<void>(flyball.place.file("r/summary.json", "{\"decisions\": -1}"));
  const auto expect_refused = [&flyball](const std::string& arguments, const std::string& why) {
    const auto outcome = flyball.run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.errors;
    EXPECT_NE(outcome.errors.find(why), std::string::npos) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
  };
  expect_refused("replay r", "r/summary.json: is no summary");
  expect_refused("explain r --at 3", "r/summary.json: is no summary");
  static_cast<void>(flyball.place.file("r/summary.json", summary));
  EXPECT_EQ(flyball.run("replay r").exit_code, 0);
  const std::string policy = "policy = \"fixed_fine\"";
  ASSERT_NE(mission.find(policy), std::string::npos);
  mission.replace(mission.find(policy), policy.size(), "policy = \"r/theirs.so\"");
  static_cast<void>(flyball.place.file("r/mission.toml", mission));
  static_cast<void>(flyball.place.file("r/theirs.so", "nothing that could be loaded"));
  expect_refused("replay r", "add --trust");
  expect_refused("explain r --at 3", "add --trust");
  expect_refused("replay r --trust", "r/theirs.so: cannot be loaded");
  expect_refused("explain r --at 3 --trust", "r/theirs.so: cannot be loaded");
  EXPECT_EQ(flyball.run("replay r --policy fixed_fine").exit_code, 0);
  EXPECT_EQ(flyball.run("bound r/mission.toml").exit_code, 0);
}

/// The scenario of `short_flight` as a file, with this name.
std::string short_world(const FlyballProgram& flyball, const std::string& name) {
  return flyball.place.file(name + ".toml",
                            "name = \"" + name +
                                "\"\n[world]\ngenerator = \"empty\"\ngoal_distance_m = 5.0\n"
                                "[camera]\nwidth_px = 32\nheight_px = 18\n");
}

#ifdef FLYBALL_EXAMPLE_KERNELS
const std::string own_kernels =
    std::string{"--kernels "} + FLYBALL_EXAMPLE_KERNELS + " --set kernels.detector=blue_trousers ";

TEST(CliFlights, kernels_of_ones_own_fly_from_a_library) {
  const FlyballProgram flyball;
  const std::string line =
      "run photography_park --set detector.cost_of=hog --set "
      "photography.limit_s=4 --set photography.success_s=3 --out r --json ";
  const auto without = flyball.run(line + "--set kernels.detector=blue_trousers");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.errors.find("no detector \"blue_trousers\""), std::string::npos)
      << without.errors;
  const auto flown = flyball.run(line + own_kernels);
  if (flown.errors.find("morse-simulator-data") != std::string::npos) {
    GTEST_SKIP() << flown.errors;
  }
  ASSERT_EQ(flown.exit_code, 0) << flown.errors;
  EXPECT_GT(nlohmann::json::parse(flown.output)["quality"]["detections"], 0);
  EXPECT_NE(flyball.place.content("r/mission.toml").find("# Flown with --kernels: lib"),
            std::string::npos);
  EXPECT_EQ(flyball.run("replay r").exit_code, 2) << "it names what is not loaded";
  EXPECT_EQ(flyball.run(std::string{"replay r --kernels "} + FLYBALL_EXAMPLE_KERNELS).exit_code, 0);
}

TEST(CliFlights, kernels_of_ones_own_are_compared) {
  const FlyballProgram flyball;
  const std::string line = own_kernels + "--policies fixed_fine,fixed_coarse --out ";
  const auto compared = flyball.run(std::string{"compare "} + short_flight + line + "c");
  EXPECT_EQ(compared.exit_code, 0) << compared.errors;
  const auto held = flyball.run("tournament --worlds " + short_world(flyball, "near") + " " + line +
                                "t --seeds 1");
  EXPECT_EQ(held.exit_code, 0) << held.errors;
  EXPECT_NE(flyball.run(std::string{"list kernels --kernels "} + FLYBALL_EXAMPLE_KERNELS)
                .output.find("blue_trousers"),
            std::string::npos);
}
#endif

TEST(CliFlights, a_tournament_goes_on_where_it_was_stopped) {
  const FlyballProgram flyball;
  const std::string worlds =
      "--worlds " + short_world(flyball, "near") + "," + short_world(flyball, "far");
  const std::string line =
      "tournament " + worlds + " --policies fixed_fine,fixed_coarse --out t --json ";
  const auto half = flyball.run(line + "--seeds 1 --jobs 2");
  ASSERT_EQ(half.exit_code, 0) << half.errors;
  const auto whole = flyball.run(line + "--seeds 1..2 --jobs 2");
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  EXPECT_NE(whole.errors.find("4 of 8 flights are known from before"), std::string::npos)
      << whole.errors;
  const auto table = nlohmann::json::parse(whole.output);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[1]["scenario"], "far");
  EXPECT_EQ(table[1]["rows"][1]["policy"], "fixed_coarse");
  EXPECT_EQ(table[1]["rows"][1]["n"], 2);
  EXPECT_EQ(table[1]["differences"][0]["pairs"], 2);
  EXPECT_TRUE(fs::exists(flyball.place.path("t/tournament.html")));
  EXPECT_TRUE(fs::exists(flyball.place.path("t/tournament.db")));
  EXPECT_FALSE(fs::exists(flyball.place.path("t/flights"))) << "records go when they are counted";
}

TEST(CliFlights, a_tournament_finds_the_best_single_setting_in_hindsight) {
  const FlyballProgram flyball;
  const std::string line = "tournament --worlds " + short_world(flyball, "near") +
                           " --policies fixed_fine,fixed_coarse --pairs fixed_fine:fixed_best "
                           "--hindsight --seeds 1 --jobs 2 --out t --json";
  const auto held = flyball.run(line);
  ASSERT_EQ(held.exit_code, 0) << held.errors;
  const auto world = nlohmann::json::parse(held.output)[0];
  EXPECT_GE(world["fixed_best"]["tried"], 24);
  const auto& rows = world["rows"];
  ASSERT_EQ(rows.size(), 3U);
  ASSERT_EQ(rows[2]["policy"], "fixed_best");
  EXPECT_LE(rows[2]["energy_total_j"]["median"], rows[0]["energy_total_j"]["median"])
      << "the first one is on the grid";
  const std::string preset = world["fixed_best"]["preset"];
  EXPECT_EQ(flyball.run("run " + flyball.place.path("near.toml") + " --out r --policy " + preset)
                .exit_code,
            0);
  const auto again = flyball.run(line);
  EXPECT_EQ(again.output, held.output);
  EXPECT_NE(again.errors.find("32 of 32 flights are known from before"), std::string::npos)
      << again.errors;
}

TEST(CliFlights, a_tournament_flies_a_policy_without_each_of_its_parts) {
  const FlyballProgram flyball;
  const auto held = flyball.run("tournament --worlds " + short_world(flyball, "near") +
                                " --ablate --seeds 1 --jobs 2 --out t --json");
  ASSERT_EQ(held.exit_code, 0) << held.errors;
  const auto told = nlohmann::json::parse(held.output);
  const auto& rows = told["worlds"][0]["rows"];
  EXPECT_EQ(rows[0]["policy"], "mission_energy");
  EXPECT_EQ(rows.size(), told["parts"].size() + 1);
  EXPECT_EQ(rows[1]["policy"],
            "mission_energy_without_" + told["parts"][0]["part"].get<std::string>());
  EXPECT_EQ(told["parts"][0]["pairs"], 1);
  EXPECT_NE(flyball.place.content("t/tournament.html").find("What each part earns"),
            std::string::npos);
}

TEST(CliFlights, tuning_leaves_nothing_where_it_refuses) {
  const FlyballProgram flyball;
  const std::string tune = "tune " + short_world(flyball, "near") + " --seeds 1001 --out t ";
  for (const auto& [given, said] : std::map<std::string, std::string>{
           {"--try range_m=7,1e9", "range_m"},
           {"--try nothing=7", "nothing"},
           {"--try range_m=7 --try range_m=15", "another --try has"},
           {"--policy fixed_fine_schedutil_10ms --try range_m=7", "is a combination of"},
           {"--try range_m=7 --preset missing/p.toml", "there is no folder \"missing\""}}) {
    const auto refused = flyball.run(tune + given);
    EXPECT_EQ(refused.exit_code, 2) << given;
    EXPECT_NE(refused.errors.find(said), std::string::npos) << refused.errors;
    EXPECT_FALSE(fs::exists(flyball.place.path("t"))) << given;
  }
}

TEST(CliFlights, tunes_a_script_and_a_preset_with_the_parameters_that_it_has) {
  const FlyballProgram flyball;
  (void)flyball.place.file("limit.lua",
                           "parameters = {{name = 'top', default = 2, min = 1, max = 9}}\n"
                           "function start(given) top = given.top end\n"
                           "function decide() return {['mission.max_speed_m_s'] = top} end\n");
  (void)flyball.place.file("base.toml", "policy = \"fixed\"\n[parameters]\nrange_m = 9.0\n");
  const std::string tune = "tune " + short_world(flyball, "near") + " --seeds 1001 --out ";
  const auto preset = flyball.run(tune + "p --policy base.toml --try max_speed_m_s=1,4");
  ASSERT_EQ(preset.exit_code, 0) << preset.errors;
  const std::string tuned = flyball.place.content("p/tuned.toml");
  EXPECT_NE(tuned.find("range_m = 9"), std::string::npos) << tuned;
  EXPECT_NE(tuned.find("max_speed_m_s = 4"), std::string::npos) << tuned;
  const auto script = flyball.run(tune + "s --policy limit.lua --try top=1,4");
  ASSERT_EQ(script.exit_code, 0) << script.errors;
  EXPECT_NE(flyball.place.content("s/tuned.toml").find("top = 4"), std::string::npos);
}

TEST(CliFlights, tuning_writes_the_setting_that_took_the_least_energy) {
  const FlyballProgram flyball;
  const auto tuned = flyball.run("tune " + short_world(flyball, "near") +
                                 " --try max_speed_m_s=1,4 --seeds 1001..1002 --out t --json");
  ASSERT_EQ(tuned.exit_code, 0) << tuned.errors;
  const auto ranked = nlohmann::json::parse(tuned.output)["candidates"];
  ASSERT_EQ(ranked.size(), 2U);
  EXPECT_LT(ranked[0]["mean_energy_j"], ranked[1]["mean_energy_j"]);
  EXPECT_EQ(ranked[0]["parameters"]["max_speed_m_s"], 4.0);
  const std::string preset = flyball.place.content("t/tuned.toml");
  EXPECT_NE(preset.find("max_speed_m_s = 4"), std::string::npos) << preset;
  EXPECT_NE(preset.find("1001"), std::string::npos) << "it says what it was tuned on";
}

}  // namespace

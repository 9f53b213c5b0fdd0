// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop

#include "flyball_program.h"
#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace {

/// Flights of a few seconds that the host flies in less than one.
constexpr const char* few_metres =
    " --set world.generator=empty --set name=short --set world.goal_distance_m=5 --set "
    "camera.width_px=32 --set camera.height_px=18 --out o ";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ManyFlights, take_seeds_and_policies_from_their_own_options_only) {
  const FlyballProgram flyball;
  const std::string fixed = " delivery_forest --policies fixed_fine";
  for (const std::string& command :
       {"compare" + fixed, "sweep" + fixed + " --over map.range_m=5,7", "drift" + fixed,
        std::string{"tournament --worlds delivery_forest --policies fixed_fine"},
        std::string{"tune delivery_forest --try resolution_m=0.3"}}) {
    const auto seed = flyball.run(command + " --set seed=7");
    EXPECT_EQ(seed.exit_code, 2) << command;
    EXPECT_TRUE(has(seed.errors, "--set seed=7 has an option of its own; give --seeds"))
        << seed.errors;
    const auto spaced = flyball.run(command + " --set '\tseed =7'");
    EXPECT_TRUE(has(spaced.errors, "has an option of its own; give --seeds")) << spaced.errors;
    const auto policy = flyball.run(command + " --set governor.policy=two_level");
    EXPECT_EQ(policy.exit_code, 2) << command;
    EXPECT_TRUE(has(policy.errors, "give --polic")) << policy.errors;
    EXPECT_TRUE(flyball.place.is_empty()) << command;
  }
}

TEST(ManyFlights, vary_no_setting_that_all_have) {
  const auto refused = FlyballProgram{}.run(
      "sweep delivery_forest --policies fixed --over map.range_m=5,7 --set 'map.range_m = 5'");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused.errors, "is one of --over, too; leave it out")) << refused.errors;
}

TEST(ManyFlights, know_a_name_by_itself_without_the_space_before_it) {
  const FlyballProgram flyball;
  for (const char* arguments :
       {"compare delivery_forest --policies 'two_level, two_level'",
        "tournament --worlds delivery_forest --policies 'two_level, two_level '"}) {
    const auto twice = flyball.run(arguments);
    EXPECT_EQ(twice.exit_code, 2);
    EXPECT_TRUE(has(twice.errors, "--policies has \"two_level\" twice")) << twice.errors;
  }
  const auto worlds =
      flyball.run("tournament --worlds 'delivery_forest, delivery_forest' --policies two_level");
  EXPECT_TRUE(has(worlds.errors, "--worlds has two whose name is")) << worlds.errors;
  const auto pairs = flyball.run(
      "tournament --worlds delivery_forest --policies 'fixed_fine, two_level, fixed_coarse' "
      "--pairs 'two_level:fixed_fine, two_level:nosuch'");
  EXPECT_TRUE(has(pairs.errors, "--pairs has \"two_level:nosuch\"")) << pairs.errors;
  const auto blank = flyball.run("compare delivery_forest --policies 'two_level, '");
  EXPECT_TRUE(has(blank.errors, "--policies: is empty")) << blank.errors;
}

TEST(ManyFlights, name_every_mistake_once_before_they_fly) {
  const FlyballProgram flyball;
  const std::string policies = " --policies two_levl,fixed_fin --seeds 1..3";
  for (const std::string& command :
       {"compare delivery_forest" + policies, "drift delivery_forest" + policies,
        "sweep delivery_forest --over map.range_m=5,7" + policies,
        "tournament --worlds delivery_forest,scanning_farm" + policies}) {
    const auto refused = flyball.run(command);
    EXPECT_EQ(refused.exit_code, 2) << command;
    EXPECT_TRUE(has(refused.errors, "did you mean two_level?")) << refused.errors;
    EXPECT_TRUE(has(refused.errors, "did you mean fixed_fine?")) << command << refused.errors;
    EXPECT_EQ(std::count(refused.errors.begin(), refused.errors.end(), '\n'), 2) << refused.errors;
    EXPECT_TRUE(flyball.place.is_empty()) << command;
  }
  const auto worlds =
      flyball.run("tournament --worlds delivery_forst,scaning_farm --policies two_level");
  EXPECT_TRUE(has(worlds.errors, "did you mean delivery_forest?")) << worlds.errors;
  EXPECT_TRUE(has(worlds.errors, "did you mean scanning_farm?")) << worlds.errors;
}

TEST(ManyFlights, name_every_mistake_of_their_own_options) {
  const FlyballProgram flyball;
  const std::string contest =
      " --policies two_level,fixed_fine,two_level,./fixed_fine.toml --seeds 3..1 --set seed=7";
  for (const std::string& command :
       {"compare delivery_forest" + contest, "drift delivery_forest" + contest,
        "sweep delivery_forest --over map.range_m=5,7" + contest,
        "tournament --worlds delivery_forest" + contest +
            " --pairs two_level:nosuch,two_level:two_level"}) {
    const auto refused = flyball.run(command);
    EXPECT_EQ(refused.exit_code, 2) << command;
    for (const char* mistake :
         {"--policies has \"two_level\" twice",
          "\"fixed_fine\" and \"./fixed_fine.toml\", whose flights", "--seeds 3..1 ends before",
          "--set seed=7 has an option of its own"}) {
      EXPECT_TRUE(has(refused.errors, mistake)) << mistake << "\n" << refused.errors;
    }
    const bool has_pairs = has(command, "--pairs");
    EXPECT_EQ(has(refused.errors, "--pairs has \"two_level:nosuch\""), has_pairs);
    EXPECT_EQ(has(refused.errors, "--pairs has \"two_level:two_level\""), has_pairs);
    EXPECT_TRUE(flyball.place.is_empty()) << command;
  }
  const auto tuned = flyball.run(
      "tune delivery_forest --try resolution_m=x --seeds 3..1 --policy nosuch.lua --preset a.lua "
      "--set seed=7");
  EXPECT_EQ(tuned.exit_code, 2);
  EXPECT_GE(std::count(tuned.errors.begin(), tuned.errors.end(), '\n'), 4) << tuned.errors;
}

TEST(ManyFlights, say_once_why_all_were_refused_and_by_whom) {
  const FlyballProgram flyball;
  const auto refused = flyball.run(
      "compare delivery_forest --policies fixed_fine,two_level --seeds 1,2 --set "
      "vehicle.payload_kg=20 --out o");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errors.rfind("flyball: vehicle.payload_kg = 20 is too heavy", 0), 0U)
      << refused.errors;
  EXPECT_EQ(std::count(refused.errors.begin(), refused.errors.end(), '\n'), 1) << refused.errors;
}

TEST(ManyFlights, say_which_setting_their_policy_overrules) {
  const FlyballProgram flyball;
  const std::string sentence =
      "policy fixed_fine sets map.resolution_m itself, so --over map.resolution_m changes nothing; "
      "policy fixed leaves it to the scenario\n";
  const auto swept =
      flyball.run("sweep delivery_forest" + std::string{few_metres} +
                  "--seeds 1 --over map.resolution_m=0.15,0.3 --policies fixed_fine,fixed");
  ASSERT_EQ(swept.exit_code, 0) << swept.errors;
  EXPECT_TRUE(has(swept.errors, sentence)) << swept.errors;
  EXPECT_FALSE(has(swept.errors, "policy fixed sets"));
  const auto flown = flyball.run("run delivery_forest" + std::string{few_metres} +
                                 "--set map.resolution_m=0.3 --policy fixed_fine");
  EXPECT_EQ(flown.errors.rfind("flyball: policy fixed_fine sets map.resolution_m itself, so ", 0),
            0U)
      << flown.errors;
  const auto same = flyball.run("compare delivery_forest" + std::string{few_metres} +
                                "--set map.resolution_m=0.15 --policies fixed_fine");
  EXPECT_FALSE(has(same.errors, "changes nothing")) << "it is the policy's own";
}

TEST(ManyFlights, say_that_a_policy_failed_and_do_not_choose_it) {
  const FlyballProgram flyball;
  (void)flyball.place.file("bad.lua", "function decide(seen)\n  error('enough')\nend\n");
  const std::string sentence = "policy ./bad.lua was replaced by safe settings in ";
  const auto swept = flyball.run("sweep delivery_forest" + std::string{few_metres} +
                                 "--seeds 1 --over vehicle.payload_kg=0.2 --policies ./bad.lua");
  EXPECT_TRUE(has(swept.output, sentence)) << swept.output << swept.errors;
  const auto drifted = flyball.run("drift delivery_forest" + std::string{few_metres} +
                                   "--at 1 --policies ./bad.lua");
  EXPECT_TRUE(has(drifted.output, sentence)) << drifted.output << drifted.errors;
  const auto run = flyball.run(
      "run delivery_forest --policy ./bad.lua --set "
      "world.generator=empty --set world.goal_distance_m=5 --out r");
  EXPECT_TRUE(has(flyball.place.content("r/report.html"), sentence)) << run.errors;
  const auto asked = flyball.run("replay r --policy ./bad.lua");
  EXPECT_TRUE(has(asked.output, sentence)) << asked.output << asked.errors;
}

TEST(ManyFlights, that_failed_count_for_no_energy_of_a_drift) {
  const FlyballProgram flyball;
  const std::string command = "drift delivery_forest" + std::string{few_metres} +
                              "--policies fixed_fine --at 0.5 --set mission.time_limit_s=1";
  const auto table = flyball.run(command);
  EXPECT_EQ(table.exit_code, 0) << table.errors;
  EXPECT_TRUE(has(table.output, "0/1        0           -\n")) << table.output;
  EXPECT_TRUE(has(table.errors, "event heat flies on jetson_tx2_passive, because "))
      << table.errors;
  const auto json = flyball.run(command + " --json");
  EXPECT_TRUE(has(json.output, "\"energy_mean_j\": null")) << json.output;
}

TEST(ManyFlights, show_the_knobs_of_each_policy_on_one_page_also_of_flights_from_the_store) {
  const FlyballProgram flyball;
  const std::string command =
      "compare delivery_forest" + std::string{few_metres} + "--policies fixed_fine,two_level";
  for (const char* whence : {"flown", "stored"}) {
    const auto run = flyball.run(command);
    ASSERT_EQ(run.exit_code, 0) << run.errors;
    const std::string page = flyball.place.content("o/report.html");
    const std::string mark = R"("knobs":[{"name":"map.resolution_m")";
    const std::size_t first = page.find(mark);
    ASSERT_NE(first, std::string::npos) << whence;
    EXPECT_NE(page.find(mark, first + 1), std::string::npos) << whence;
  }
}

TEST(ManyFlights, are_tuned_for_a_policy_that_flew_them_itself) {
  const FlyballProgram flyball;
  (void)flyball.place.file("some.lua", R"(
    parameters = {
      {name = "n", default = 1, min = 0, max = 9, description = "Fails at 2."},
    }
    local n
    function start(given)
      n = given.n
    end
    function decide(seen)
      if n == 2 then
        error("enough")
      end
      return {["map.resolution_m"] = 0.15}
    end
  )");
  const auto tuned = flyball.run("tune delivery_forest" + std::string{few_metres} +
                                 "--seeds 1001 --policy ./some.lua --try n=2,1");
  EXPECT_EQ(tuned.exit_code, 0) << tuned.errors;
  EXPECT_TRUE(has(tuned.output, "0/1      -          n=2")) << tuned.output;
  EXPECT_TRUE(has(tuned.output, "policy ./some.lua was replaced by safe settings in "));
  EXPECT_TRUE(has(flyball.place.content("o/tuned.toml"), "n = 1")) << "which is not the first";
}

TEST(ManyFlights, of_a_tournament_leave_other_records_and_worlds_alone) {
  const FlyballProgram flyball;
  const std::string settings =
      " --set world.generator=empty --set world.goal_distance_m=5 --set camera.width_px=32 --set "
      "camera.height_px=18 --out o";
  const auto flown = flyball.run("run delivery_forest --policy fixed --seed 1" + settings +
                                 "/delivery_forest/runs/fixed/seed_1");
  ASSERT_EQ(flown.exit_code, 0) << flown.errors;
  const std::string record = "o/delivery_forest/runs/fixed/seed_1/mission.toml";
  ASSERT_TRUE(std::filesystem::exists(flyball.place.path(record)));
  const auto first =
      flyball.run("tournament --policies fixed --seeds 1 --worlds delivery_forest" + settings);
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  EXPECT_TRUE(std::filesystem::exists(flyball.place.path(record)));
  for (const char* world : {"a", "b"}) {
    std::filesystem::create_directory(flyball.place.path(world));
    (void)flyball.place.file(std::string{world} + "/w.toml",
                             "name = \"" + std::string{world} + "\"\n");
  }
  const auto held = flyball.run(
      "tournament --keep-records --policies fixed --seeds 1 --worlds "
      "delivery_forest,a/w.toml,b/w.toml" +
      settings);
  ASSERT_EQ(held.exit_code, 0) << held.errors;
  for (const char* name : {"w", "w_2"}) {
    EXPECT_TRUE(std::filesystem::exists(
        flyball.place.path(std::string{"o/flights/"} + name + "/runs/fixed/seed_1/mission.toml")))
        << name;
  }
}

TEST(ManyFlights, take_one_list_after_an_option_and_their_scenario_after_that) {
  const auto refused =
      FlyballProgram{}.run("compare --policies fixed_fine,nosuch --seeds 1 delivery_forst");
  EXPECT_TRUE(has(refused.errors, "did you mean delivery_forest?")) << refused.errors;
}

}  // namespace

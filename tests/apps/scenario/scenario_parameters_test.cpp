// SPDX-License-Identifier: BSD-3-Clause

#include "scenario/scenario_parameters.h"

#include "flyball/kernels/localizer.h"

#include "scenario/kernel_choice.h"
#include "scratch_folder.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Errors = std::vector<Error>;

std::variant<LoadedScenario, Errors> loaded(const std::string& toml,
                                            const std::vector<std::string>& settings = {}) {
  const ScratchFolder scratch;
  return load_scenario(scratch.file("mine.toml", toml), settings);
}

std::string said(const std::string& toml, const std::vector<std::string>& settings = {}) {
  const auto result = loaded(toml, settings);
  std::string text;
  if (const auto* errors = std::get_if<Errors>(&result)) {
    for (const Error& error : *errors) {
      text += error.message + "\n";
    }
  }
  return text;
}

constexpr const char* fast_map = "[kernels]\nmapper = \"flyball\"\n";

TEST(ScenarioParameters, a_mappers_own_settings_come_from_the_file_and_the_command_line) {
  const auto result = loaded(
      "[kernels]\nmapper = \"flyball\"\n[kernels.mapper_parameters]\nfront_end = \"exact\"\n",
      {"kernels.mapper_parameters.cost_of=octomap", "kernels.mapper_parameters.finest_m=0.1",
       "map.resolution_m=0.2"});
  ASSERT_TRUE(std::holds_alternative<LoadedScenario>(result));
  const auto& [scenario, entries] = std::get<LoadedScenario>(result);
  EXPECT_EQ(std::get<std::string>(scenario.kernels.mapper_parameters.at("front_end")), "exact");
  EXPECT_EQ(std::get<double>(scenario.kernels.mapper_parameters.at("finest_m")), 0.1);
  EXPECT_EQ(mapper_cost(scenario.kernels), "octomap");
  const auto entry = std::find_if(entries.begin(), entries.end(), [](const ConfigEntry& e) {
    return e.key == "kernels.mapper_parameters.front_end";
  });
  ASSERT_NE(entry, entries.end());
  EXPECT_EQ(entry->value, "\"exact\"");
  EXPECT_EQ(entry->origin, "mine.toml:4");
}

TEST(ScenarioParameters, a_files_settings_go_when_their_kernel_or_world_is_exchanged) {
  const std::string file =
      "[world]\ngenerator = \"forest\"\nwidth_m = 30.0\n"
      "[kernels]\ndetector = \"hog\"\n[kernels.detector_parameters]\nthreshold = 0.2\n";
  const auto result =
      loaded(file, {"kernels.detector=haar", "world.generator=empty", "world.goal_distance_m=44"});
  ASSERT_TRUE(std::holds_alternative<LoadedScenario>(result)) << said(file);
  const Scenario& exchanged = std::get<LoadedScenario>(result).scenario;
  EXPECT_EQ(exchanged.kernels.detector_parameters.count("threshold"), 0U);
  EXPECT_EQ(std::get<double>(exchanged.world.parameters.at("goal_distance_m")), 44.0);
  const auto kept =
      loaded(file, {"kernels.detector=\"hog\"", "kernels.detector_parameters.level_step=1.2"});
  const Scenario& same = std::get<LoadedScenario>(kept).scenario;
  EXPECT_EQ(std::get<double>(same.kernels.detector_parameters.at("level_step")), 1.2);
  EXPECT_EQ(std::get<double>(same.kernels.detector_parameters.at("threshold")), 0.2);
}

TEST(ScenarioParameters, settings_of_the_command_line_must_fit_what_it_exchanges) {
  const std::string errors =
      said("[kernels]\ndetector = \"hog\"\n",
           {"kernels.detector=haar", "kernels.detector_parameters.threshold=1.2"});
  EXPECT_NE(errors.find("threshold"), std::string::npos) << errors;
}

TEST(ScenarioParameters, what_is_written_reads_back) {
  const auto first = loaded(fast_map, {"kernels.mapper_parameters.most_traversals=1.5e6"});
  const std::string written = to_toml(std::get<LoadedScenario>(first).scenario);
  const auto again = loaded(written);
  ASSERT_TRUE(std::holds_alternative<LoadedScenario>(again)) << said(written);
  EXPECT_EQ(to_toml(std::get<LoadedScenario>(again).scenario), written);
  EXPECT_NE(written.find("mapper_parameters.most_traversals"), std::string::npos) << written;
}

TEST(ScenarioParameters, every_wrong_one_is_reported_at_once) {
  const std::string text =
      said(fast_map,
           {"kernels.mapper_parameters.front_and=exact", "kernels.mapper_parameters.cost_of=crayon",
            "kernels.mapper_parameters.finest_m=fine",
            "kernels.mapper_parameters.most_traversals=-1", "map.range_m=1"});
  for (const char* sentence :
       {"\"kernels.mapper_parameters.front_and\" (--set); did you mean "
        "kernels.mapper_parameters.front_end?",
        "cost_of: \"crayon\" is none of: flyball, octomap",
        "kernels.mapper_parameters.finest_m = fine (--set) must be a number in m",
        "most_traversals: -1 is not within 0 to", "map.range_m = 1 (--set) must be at least 2"}) {
    EXPECT_NE(text.find(sentence), std::string::npos) << sentence << "\nis missing from\n" << text;
  }
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5) << text;
}

TEST(ScenarioParameters, a_localizer_has_its_own_too) {
  const std::vector<std::string> slam{"kernels.localizer=visual_slam",
                                      "kernels.localizer_parameters.weak_corner=7"};
  const auto result = loaded("", slam);
  ASSERT_TRUE(std::holds_alternative<LoadedScenario>(result));
  const KernelSettings& kernels = std::get<LoadedScenario>(result).scenario.kernels;
  EXPECT_EQ(std::get<double>(kernels.localizer_parameters.at("weak_corner")), 7.0);
  EXPECT_EQ(std::get<double>(kernels.localizer_parameters.at("strong_corner")), 5.0);
  EXPECT_TRUE(make_kernel<Localizer>(Plugins{}, kernels));
  EXPECT_EQ(said("", {slam[0], "kernels.localizer_parameters.weak_corner=0"}),
            "localizer \"visual_slam\", weak_corner: 0 is not within 1 to 100\n");
}

TEST(ScenarioParameters, of_an_unknown_mapper_the_name_is_the_one_error) {
  const std::string text = said("", {"kernels.mapper=crayon", "kernels.mapper_parameters.x=1"});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_NE(text.find("no mapper \"crayon\""), std::string::npos) << text;
}

TEST(ScenarioParameters, another_mapper_has_other_parameters) {
  EXPECT_NE(said("", {"kernels.mapper_parameters.front_end=exact"}).find("no setting"),
            std::string::npos);
}

TEST(ScenarioParameters, a_resolution_that_the_mapper_does_not_map_at_is_refused) {
  EXPECT_EQ(said(fast_map, {"map.resolution_m=0.6"}), "");
  EXPECT_EQ(said(fast_map, {"map.resolution_m=0.8"}),
            "map.resolution_m = 0.8 (--set) must be one of 0.15, 0.3, 0.6, 1.2, the cells of "
            "mapper \"flyball\"\n");
  EXPECT_EQ(said("", {"map.resolution_m=0.8"}), "") << "stock maps at any";
}

TEST(ScenarioParameters, a_range_that_is_too_long_for_the_cells_is_refused) {
  const std::string text = said(fast_map, {"kernels.mapper_parameters.finest_m=0.05",
                                           "map.resolution_m=0.2", "map.range_m=20"});
  EXPECT_NE(text.find("mapper \"flyball\" refuses: map.range_m 20"), std::string::npos) << text;
}

TEST(ScenarioParameters, without_cost_of_a_mapper_is_charged_under_its_own_name) {
  KernelSettings kernels;
  EXPECT_EQ(mapper_cost(kernels), "octomap");
  kernels.mapper = "flyball";
  EXPECT_EQ(mapper_cost(kernels), "flyball");
  kernels.mapper_parameters["cost_of"] = std::string{"octomap"};
  EXPECT_EQ(mapper_cost(kernels), "octomap");
}

TEST(ScenarioParameters, are_those_of_every_family) {
  const auto result = loaded("[kernels]\nplanner = \"rrt\"\nplanner_parameters.goal_bias = 0.2\n",
                             {"kernels.path_tracker_parameters.position_gain_1_s=1.5",
                              "kernels.tracker_parameters.threshold=0.4"});
  ASSERT_TRUE(std::holds_alternative<LoadedScenario>(result));
  const Scenario& scenario = std::get<LoadedScenario>(result).scenario;
  EXPECT_EQ(std::get<double>(scenario.kernels.planner_parameters.at("goal_bias")), 0.2);
  EXPECT_EQ(std::get<double>(scenario.kernels.path_tracker_parameters.at("position_gain_1_s")),
            1.5);
  EXPECT_EQ(std::get<double>(scenario.kernels.tracker_parameters.at("threshold")), 0.4);
  EXPECT_EQ(family_choices().size(), 11U);
}

TEST(ScenarioParameters, make_every_kernel_of_every_family) {
  for (const FamilyChoice& family : family_choices()) {
    for (const std::string& name : family.names(Plugins{})) {
      KernelSettings kernels;
      kernels.*family.kernel = name;
      const auto kernel = make_kernel(family, Plugins{}, kernels, model_finder({}));
      // What a machine lacks is said, and nothing else is wrong with the defaults.
      EXPECT_TRUE(kernel || kernel.error().code == ErrorCode::not_found)
          << family.owner(kernels) << ": " << kernel.error().message;
      (kernels.*family.parameters)["no_such"] = 1.0;
      const auto refused = make_kernel(family, Plugins{}, kernels, no_models);
      ASSERT_FALSE(refused.ok());
      EXPECT_NE(refused.error().message.find(family.owner(kernels)), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone

#include "flyball/scenario/scenario.h"

#include "flyball/scenario/files.h"

#include "scenario/scenario_fields.h"
#include "scratch_folder.h"
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Errors = std::vector<Error>;

std::string joined(const Errors& errors) {
  std::string text;
  for (const Error& error : errors) {
    text += error.message + "\n";
  }
  return text;
}

/// The scenario that a text is read as; a failure of the test when it is none.
Scenario read(const std::string& toml, const std::vector<std::string>& settings = {}) {
  const ScratchFolder scratch;
  const auto loaded = load_scenario(scratch.file("mine.toml", toml), settings);
  const auto* errors = std::get_if<Errors>(&loaded);
  EXPECT_EQ(errors, nullptr) << joined(*errors);
  return errors == nullptr ? std::get<LoadedScenario>(loaded).scenario : Scenario{};
}

Errors errors_of(const std::string& toml, const std::vector<std::string>& settings = {}) {
  const ScratchFolder scratch;
  auto loaded = load_scenario(scratch.file("mine.toml", toml), settings);
  const auto* errors = std::get_if<Errors>(&loaded);
  return errors == nullptr ? Errors{} : *errors;
}

TEST(Scenario, an_empty_file_means_the_defaults) {
  EXPECT_EQ(to_toml(read("")), to_toml(read("name = \"unnamed\"\n[map]\nrange_m = 7\n")));
}

TEST(Scenario, every_violation_is_reported_at_once_with_its_line) {
  const std::string said = joined(errors_of(R"(seed = -3
[vehicle]
payload_kg = -0.5
[map]
range_cm = 700
rate_hz = "fast"
[mision]
time_limit_s = 5
[kernels]
mapper = "octomapp"
slam_load = 1
[planner]
budget = 1.5
)"));
  for (const char* sentence :
       {"seed = -3 (mine.toml:1) must be a whole number from 0 to 2^63 - 1",
        "vehicle.payload_kg = -0.5 (mine.toml:3) must be at least 0 kg and at most 20 kg",
        "\"map.range_cm\" (mine.toml:5); did you mean map.range_m, in m?",
        "(mine.toml:6) must be a number in Hz",
        "\"mision.time_limit_s\" (mine.toml:8); did you mean mission.time_limit_s?",
        "no mapper \"octomapp\" (mine.toml:10); did you mean octomap?",
        "kernels.slam_load = 1 (mine.toml:11) must be true or false",
        "planner.budget = 1.5 (mine.toml:13) must be a whole number"}) {
    EXPECT_NE(said.find(sentence), std::string::npos) << sentence << "\nis missing from\n" << said;
  }
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 8) << said;
}

TEST(Scenario, what_it_names_must_exist) {
  const std::string said = joined(
      errors_of("", {"governor.policy=just_in_tme", "platform.name=jetson", "world.generator=frest",
                     "vehicle.airframe=a/b.toml", "mission.workload=tour"}));
  for (const char* sentence :
       {"no policy \"just_in_tme\" (--set); try: flyball list policies",
        "no platform \"jetson\" (--set); try: flyball list platforms",
        "no world \"frest\" (--set); did you mean forest? try: flyball list worlds",
        "no file \"a/b.toml\" to read the airframe from; give a path to a .toml file",
        "no workload \"tour\" (--set); try: flyball list workloads"}) {
    EXPECT_NE(said.find(sentence), std::string::npos) << sentence << "\nis missing from\n" << said;
  }
}

TEST(Scenario, the_operating_point_must_be_one_of_the_platform) {
  const std::string said =
      joined(errors_of("", {"platform.cores=64", "platform.frequency_hz=1e9"}));
  EXPECT_NE(said.find("platform.cores = 64 (--set) must be at most 4"), std::string::npos) << said;
  EXPECT_NE(said.find("platform.frequency_hz = 1e+09 (--set) is no clock of jetson_tx2"),
            std::string::npos)
      << said;
}

TEST(Scenario, settings_of_the_command_line_replace_those_of_the_file) {
  const Scenario scenario = read("[map]\nrange_m = 5\n[governor]\npolicy = \"fixed_fine\"\n",
                                 {"map.range_m=6", "map.range_m = 6.5", "governor.policy=two_level",
                                  "kernels.slam_load=false", "seed=77", "name=night-flight"});
  EXPECT_EQ(scenario.map.range_m, 6.5);
  EXPECT_EQ(scenario.governor.policy, "two_level");
  EXPECT_FALSE(scenario.kernels.slam_load);
  EXPECT_EQ(scenario.seed, 77U);
  EXPECT_EQ(scenario.name, "night-flight");
}

TEST(Scenario, a_setting_without_a_value_is_refused) {
  EXPECT_EQ(joined(errors_of("", {"map.range_m"})),
            "--set map.range_m is not KEY=VALUE; for example: --set map.range_m=5\n");
}

TEST(Scenario, a_setting_cannot_smuggle_in_a_second_line) {
  EXPECT_EQ(errors_of("", {"map.range_m=5\nseed=3"}).size(), 1U);
}

TEST(Scenario, numbers_that_are_none_are_refused) {
  for (const char* value : {"nan", "inf", "-inf", "[7]", "1979-05-27"}) {
    EXPECT_EQ(errors_of(std::string{"[map]\nrange_m = "} + value).size(), 1U) << value;
  }
}

TEST(Scenario, broken_toml_is_named_with_its_line) {
  const std::string said = joined(errors_of("[map]\nrange_m = = 3\n"));
  EXPECT_EQ(said.rfind("mine.toml:2: this is not TOML: ", 0), 0U) << said;
}

TEST(Scenario, texts_that_toml_plus_plus_must_not_see_are_named_with_their_line) {
  for (const char* text : {"[map]\nrange_m\xcc\x9e = 3\n", "[map]\n[=]\n"}) {
    const std::string said = joined(errors_of(text));
    EXPECT_EQ(said.rfind("mine.toml:2: this is not TOML: ", 0), 0U) << said;
  }
  const auto read = load_scenario("delivery_open", {"map.range_m=3\xcc\x9e"});
  EXPECT_NE(joined(std::get<Errors>(read)).find("must be a number"), std::string::npos);
}

TEST(Scenario, a_missing_file_is_named_with_the_way_out) {
  const auto by_name = std::get<Errors>(load_scenario("delivery_moon", {}));
  EXPECT_EQ(
      joined(by_name),
      "no scenario \"delivery_moon\"; did you mean delivery_open? try: flyball list scenarios\n");
  const auto by_path = std::get<Errors>(load_scenario("no/such.toml", {}));
  EXPECT_NE(joined(by_path).find("no file \"no/such.toml\""), std::string::npos);
}

TEST(Scenario, worlds_declare_their_own_parameters) {
  const Scenario scenario =
      read("[world]\ngenerator = \"forest\"\nwidth_m = 30\n", {"world.min_gap_m=3"});
  EXPECT_EQ(std::get<double>(scenario.world.parameters.at("width_m")), 30.0);
  EXPECT_EQ(std::get<double>(scenario.world.parameters.at("min_gap_m")), 3.0);
  EXPECT_EQ(std::get<double>(scenario.world.parameters.at("goal_distance_m")), 150.0)
      << "its default";

  const std::string said = joined(
      errors_of("[world]\ngenerator = \"forest\"\nwidth_cm = 3000\ngoal_distance_m = \"far\"\n"
                "min_gap_m = 99\ndensity = 0.01\n"));
  for (const char* sentence :
       {"\"world.width_cm\" (mine.toml:3); did you mean world.width_m, in m?",
        "world.goal_distance_m = \"far\" (mine.toml:4) must be a number in m", "min_gap_m",
        "\"world.density\" (mine.toml:6); did you mean world.density_1_m2, in 1/m^2?"}) {
    EXPECT_NE(said.find(sentence), std::string::npos) << sentence << "\nis missing from\n" << said;
  }
}

TEST(Scenario, what_is_written_reads_back_to_the_same_values) {
  const Scenario scenario =
      read("", {"world.generator=forest", "world.density_1_m2=0.0123456789012345678",
                "vehicle.wind_east_m_s=-0.1", "governor.period_s=0.3",
                "vehicle.physics_step_s=0.0015", "seed=9007199254740993",
                "camera.horizontal_field_rad=1.0471975511965976", "platform.frequency_hz=806.4e6"});
  const std::string written = to_toml(scenario);
  const Scenario again = read(written);
  EXPECT_EQ(to_toml(again), written);
  EXPECT_EQ(again.world.parameters, scenario.world.parameters);
  EXPECT_EQ(again.seed, 9007199254740993U) << "is no double";
  EXPECT_EQ(again.camera.horizontal_field_rad, scenario.camera.horizontal_field_rad);
}

TEST(Scenario, texts_with_quotes_and_control_characters_survive) {
  EXPECT_EQ(toml_text("a\"b\\c\n"), "\"a\\\"b\\\\c\\u000a\"");
}

TEST(Scenario, each_entry_tells_its_origin) {
  const ScratchFolder scratch;
  const auto loaded =
      load_scenario(scratch.file("mine.toml", "\n[map]\nrange_m = 5\n"), {"map.rate_hz=10"});
  const auto& entries = std::get<LoadedScenario>(loaded).entries;
  const auto entry = [&entries](const std::string& key) {
    return *std::find_if(entries.begin(), entries.end(),
                         [&](const ConfigEntry& e) { return e.key == key; });
  };
  EXPECT_EQ(entry("map.range_m").origin, "mine.toml:3");
  EXPECT_EQ(entry("map.range_m").value, "5");
  EXPECT_EQ(entry("map.range_m").fallback, "7");
  EXPECT_EQ(entry("map.rate_hz").origin, "--set");
  EXPECT_EQ(entry("map.resolution_m").origin, "default");
}

TEST(Scenario, each_setting_has_one_place_and_its_default_is_legal) {
  Scenario scenario;
  std::set<std::string> keys;
  std::set<const void*> places;
  for (const ScenarioField& field : scenario_fields()) {
    EXPECT_TRUE(keys.insert(field.key).second) << field.key;
    EXPECT_TRUE(
        places.insert(std::visit([&](auto at) -> const void* { return at(scenario); }, field.place))
            .second)
        << field.key;
    EXPECT_FALSE(field.description.empty()) << field.key;
  }
  EXPECT_TRUE(errors_of(to_toml(scenario)).empty()) << joined(errors_of(to_toml(scenario)));
}

TEST(Scenario, its_acceleration_and_brake_lag_are_those_of_the_guard) {
  Scenario scenario;
  scenario.mission.max_acceleration_m_s2 = 3.5;
  scenario.vehicle.brake_lag_s = 0.3;
  const GuardSettings guard = guard_settings(flight_settings(scenario));
  EXPECT_EQ(guard.max_deceleration_m_s2, 3.5);
  EXPECT_EQ(guard.brake_lag, from_seconds(0.3));
}

TEST(Scenario, every_shipped_one_loads) {
  const std::vector<std::string> names = shipped("scenarios");
  EXPECT_GE(names.size(), 3U);
  for (const std::string& name : names) {
    const auto loaded = load_scenario(name, {});
    const auto* errors = std::get_if<Errors>(&loaded);
    ASSERT_EQ(errors, nullptr) << joined(*errors);
    EXPECT_EQ(std::get<LoadedScenario>(loaded).scenario.name, name);
  }
}

}  // namespace
}  // namespace flyball

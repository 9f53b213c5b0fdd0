// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/pictures.h"

#include "flyball_program.h"
#include <algorithm>
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>
#include <octomap/octomap.h>

namespace {

/// Bad input: exit code 2, one line for each thing that is wrong, no result, nothing written.
class Cli : public testing::Test {
 protected:
  void expect_refused(const std::string& arguments,
                      const std::string& sentence,
                      int lines = 1) const {
    const FlyballProgram::Outcome outcome = flyball.run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.errors;
    EXPECT_NE(outcome.errors.find(sentence), std::string::npos) << arguments << "\n"
                                                                << outcome.errors;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), lines)
        << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    EXPECT_TRUE(flyball.place.is_empty()) << arguments;
  }
  FlyballProgram flyball;
};

TEST_F(Cli, refuses_an_unknown_scenario) {
  expect_refused("run delivery_moon", "no scenario \"delivery_moon\"; did you mean");
  expect_refused("run missing/file.toml", "no file \"missing/file.toml\"");
  expect_refused("compare missing/file.toml --policies fixed_fine",
                 "no file \"missing/file.toml\"");
  expect_refused("config delivery_moon", "flyball list scenarios");
}

TEST_F(Cli, refuses_wrong_settings_all_at_once) {
  expect_refused(
      "run delivery_forest --set vehicle.payload_kg=-1 --set map.range_cm=500 --set "
      "planner.budjet=9",
      "vehicle.payload_kg = -1 (--set) must be at least 0 kg", 3);
  expect_refused("run delivery_forest --set vehicle.payloadkg=1",
                 "no setting \"vehicle.payloadkg\" (--set); did you mean vehicle.payload_kg?");
}

TEST_F(Cli, refuses_an_unknown_policy) {
  expect_refused("run delivery_forest --policy just_in_tme", "no policy \"just_in_tme\"");
  expect_refused("compare delivery_forest --policies fixed_fine,just_in_tme",
                 "try: flyball list policies");
}

TEST_F(Cli, refuses_wishes_for_a_computer_that_is_modeled) {
  expect_refused("run delivery_forest --fifo 20", "--fifo is of no use to a modeled computer");
  expect_refused("run delivery_forest --set-clocks --executor virtual",
                 "--set-clocks is of no use to a modeled computer; add --executor realtime");
  const auto other = flyball.run("run delivery_forest --executor sundial");
  EXPECT_EQ(other.exit_code, 2) << other.errors;
}

TEST_F(Cli, refuses_bad_seeds) {
  expect_refused("run delivery_forest --seed -1", "seed = -1");
  expect_refused("run delivery_forest --seed one", "seed = one");
  for (const char* seeds : {"5..1", "1..", "a..b", "''", "1,,2", "1..99999999", "-1..3", "1.5"}) {
    expect_refused(std::string{"compare delivery_forest --policies fixed_fine --seeds="} + seeds,
                   "--seeds");
  }
}

TEST_F(Cli, refuses_an_option_with_nothing_in_it) {
  expect_refused("run delivery_forest --policy ''", "--policy: is empty");
  expect_refused("run delivery_forest --seed ''", "--seed: is empty");
  expect_refused("run delivery_forest --out ''", "--out: is empty");
  expect_refused("compare delivery_forest --policies ''", "--policies: is empty");
  expect_refused("run ''", "no scenario \"\"; try: flyball list scenarios");
}

TEST_F(Cli, refuses_an_output_folder_that_cannot_be_written) {
  expect_refused("run delivery_forest --out /dev/null/flights",
                 "cannot write \"/dev/null/flights\"");
  expect_refused("compare delivery_forest --policies fixed_fine --out /proc/flights",
                 "cannot write \"/proc/flights\"");
  expect_refused("run delivery_forest --out " + FlyballProgram::binary() + "/flights",
                 "Not a directory; choose another place with --out");
}

TEST_F(Cli, checks_both_policies_of_a_combination) {
  const FlyballProgram::Outcome outcome = flyball.run("policy check fixed_fine_schedutil_10ms");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output << outcome.errors;
  EXPECT_EQ(outcome.output,
            "fixed_fine keeps the contract of a policy\n"
            "schedutil_10ms keeps the contract of a policy\n");
  (void)flyball.place.file("both.toml", "application = \"fixed_fine\"\nclock = \"nosuch\"\n");
  const FlyballProgram::Outcome half = flyball.run("policy check ./both.toml");
  EXPECT_EQ(half.exit_code, 2);
  EXPECT_NE(half.errors.find("\"nosuch\""), std::string::npos) << half.errors;
}

TEST_F(Cli, checks_a_policy_with_the_knobs_of_its_mission) {
  expect_refused("policy check fixed_fine --scenario nosuch", "no scenario \"nosuch\"");
  expect_refused("policy check fixed_fine --set knobs.camera_rate=true", "--scenario");
  (void)flyball.place.file("slow.lua",
                           "function decide(seen)\n  return {[\"camera.rate_hz\"] = 5}\nend\n");
  const FlyballProgram::Outcome bare = flyball.run("policy check ./slow.lua");
  EXPECT_EQ(bare.exit_code, 1);
  EXPECT_NE(bare.output.find("a knob that does not exist: \"camera.rate_hz\""), std::string::npos)
      << bare.output << bare.errors;
  const FlyballProgram::Outcome there = flyball.run(
      "policy check ./slow.lua --scenario delivery_forest --set knobs.camera_rate=true");
  EXPECT_EQ(there.exit_code, 0) << there.output << there.errors;
}

TEST_F(Cli, names_every_parameter_that_a_policy_does_not_take) {
  (void)flyball.place.file("wrong.toml",
                           "policy = \"density\"\n[parameters]\nfine = 0.2\ncoarse_m = 99.0\n");
  const FlyballProgram::Outcome outcome = flyball.run("policy check ./wrong.toml");
  EXPECT_NE(outcome.exit_code, 0);
  const std::string told = outcome.output + outcome.errors;
  EXPECT_NE(told.find("\"fine\""), std::string::npos) << told;
  EXPECT_NE(told.find("99"), std::string::npos) << told;
}

TEST_F(Cli, refuses_a_policy_twice) {
  expect_refused("compare delivery_forest --policies a/one.lua,b/one.toml",
                 "--policies has \"a/one.lua\" and \"b/one.toml\", whose flights would have the "
                 "same name; rename one of them");
  expect_refused("run delivery_forest --policy nosuch.lua",
                 "no file \"nosuch.lua\" to read the policy from");
  expect_refused("compare delivery_forest --policies fixed_fine,fixed_fine", "name each once");
  expect_refused("tournament --worlds delivery_forest --policies fixed_fine,fixed_fine",
                 "name each once");
}

TEST_F(Cli, refuses_pairs_of_policies_that_do_not_fly) {
  const std::string two = "tournament --worlds delivery_forest --policies fixed_fine,two_level ";
  for (const char* pair : {"fixed_fine:two_levels", "fixed_fine", "fixed_fine:", ":two_level",
                           "two_level:two_level"}) {
    expect_refused(two + "--pairs " + pair, "give two of --policies with a colon between");
  }
}

TEST_F(Cli, refuses_to_leave_out_parts_that_a_policy_has_not) {
  const std::string line = "tournament --worlds delivery_forest --out t ";
  expect_refused(line + "--ablate fixed_fine", "--ablate fixed_fine has no parameter \"without\"");
  expect_refused(line + "--ablate nobody", "--ablate: no policy \"nobody\"");
  expect_refused(line, "give --policies A,B,C, or --ablate");
  expect_refused(line + "--policies two_level --pairs fixed_best:two_level",
                 "give two of --policies with a colon between");
}

TEST_F(Cli, refuses_a_world_that_cannot_be_made) {
  expect_refused("run delivery_building_079 --set world.file=nowhere.bt --out deep/out",
                 "nowhere.bt");
  expect_refused(
      "compare delivery_building_079 --set world.file=nowhere.bt --policies "
      "fixed_fine,fixed_coarse",
      "nowhere.bt");
}

TEST_F(Cli, refuses_what_is_no_command) {
  expect_refused("fly delivery_forest", "try: flyball --help");
  expect_refused("run", "SCENARIO is required; try: flyball run --help");
  expect_refused("map from", "RECORDING is required; try: flyball map from --help");
  expect_refused("run delivery_forest --fast", "--fast");
  expect_refused("compare delivery_forest", "--policies");
  expect_refused("compare delivery_forest --policies fixed_fine --jobs 0",
                 "--jobs: Value 0 not in range 1 to 1024");
  expect_refused("list planets", "nothing to list under \"planets\"; there are: scenarios,");
  expect_refused("graph tour", "no workload \"tour\"; try: flyball list workloads");
  expect_refused("graph package_delivery --format png", "--format png is neither text nor dot");
}

TEST_F(Cli, refuses_a_library_of_kernels_that_is_none) {
  for (const char* command :
       {"run delivery_forest", "compare delivery_forest --policies fixed_fine",
        "tournament --worlds delivery_forest --policies fixed_fine", "config delivery_forest",
        "bound delivery_forest", "list kernels", "replay nowhere", "explain nowhere --at 1",
        "detect nowhere.png", "localize nowhere", "map from nowhere --out map.bt",
        "policy check fixed_fine", "graph package_delivery"}) {
    expect_refused(std::string{command} + " --kernels ./libmine.so",
                   "--kernels: library \"./libmine.so\" is not there");
  }
}

TEST_F(Cli, looks_for_people_with_a_detector_of_a_library) {
  const std::string grey =
      flyball.place.file("grey.pgm", "P5\n64 128\n255\n" + std::string(64 * 128, 'a'));
  const auto unknown = flyball.run("detect " + grey + " --detector blind");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.errors.find("no detector \"blind\""), std::string::npos) << unknown.errors;
  const auto seen = flyball.run("detect " + grey +
                                " --detector blind --kernels " FLYBALL_TEST_KERNELS "/libblind.so");
  EXPECT_EQ(seen.exit_code, 0) << seen.errors;
  EXPECT_NE(seen.output.find("grey.pgm: 0 people"), std::string::npos) << seen.output;
}

TEST_F(Cli, names_the_option_that_a_wrong_value_came_from) {
  expect_refused("run delivery_open --policy just", "no policy \"just\" (--policy);");
  expect_refused("run delivery_open --seed one", "seed = one (--seed) must be a whole number");
  expect_refused("bound delivery_open --seed one", "seed = one (--seed) must be a whole number");
  expect_refused("compare delivery_open --policies just", "no policy \"just\" (--policies);");
  expect_refused("run delivery_open --set governor.policy=just", "no policy \"just\" (--set);");
  const std::string mine = flyball.place.file("mine.toml", "[governor]\npolicy = \"just\"\n");
  const auto filed = flyball.run("run " + mine + " --seed 2");
  EXPECT_NE(filed.errors.find("mine.toml:2);"), std::string::npos) << filed.errors;
}

TEST_F(Cli, lists_everything_that_can_be_named) {
  const std::pair<const char*, const char*> lists[] = {
      {"scenarios", "delivery_forest "},
      {"workloads", "package_delivery\n"},
      {"kernels", "mapper           octomap\n"},
      {"policies", "two_level "},
      {"platforms", "jetson_tx2 "},
      {"worlds", "  goal_distance_m "},
      {"boards", "; choose it with --board generic_x86.\n"},
      {"airframes", "MAVBench (MICRO 2018).\n"},
      {"knobs", "map.resolution_m "}};
  for (const auto& [kind, line] : lists) {
    const FlyballProgram::Outcome outcome = flyball.run(std::string{"list "} + kind);
    EXPECT_EQ(outcome.exit_code, 0) << kind;
    EXPECT_NE(outcome.output.find(line), std::string::npos) << kind << "\n" << outcome.output;
    EXPECT_EQ(outcome.errors, "") << kind;
  }
}

TEST_F(Cli, prints_every_setting_with_its_origin) {
  const FlyballProgram::Outcome outcome =
      flyball.run("config delivery_forest --set map.rate_hz=10");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("delivery_forest.toml:"), std::string::npos);
  EXPECT_NE(outcome.output.find("world.density_1_m2"), std::string::npos);
  EXPECT_NE(outcome.output.find("--set"), std::string::npos);
}

TEST_F(Cli, prints_a_workload_as_text_and_for_graphviz) {
  const FlyballProgram::Outcome text = flyball.run("graph package_delivery");
  EXPECT_EQ(text.exit_code, 0) << text.errors;
  EXPECT_NE(text.output, "");
  const FlyballProgram::Outcome dot = flyball.run("graph package_delivery --format dot");
  EXPECT_EQ(dot.output.rfind("digraph", 0), 0U) << dot.output;
}

TEST_F(Cli, lists_its_commands_when_it_is_given_none) {
  const FlyballProgram::Outcome outcome = flyball.run("");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.errors, "");
  for (const char* command : {"run", "compare", "tournament", "sweep", "tune", "drift", "bound",
                              "list", "graph", "config", "policy", "replay", "explain", "map",
                              "detect", "models", "fit", "localize", "version"}) {
    EXPECT_NE(outcome.output.find(std::string{"\n  "} + command + " "), std::string::npos)
        << command << " is not in\n"
        << outcome.output;
  }
}

TEST_F(Cli, knows_no_command_of_another_name) {
  for (const char* words : {"nosuch", "nosuch --help", "nosuch delivery_forest"}) {
    const FlyballProgram::Outcome outcome = flyball.run(words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_EQ(outcome.output, "") << words;
    EXPECT_EQ(outcome.errors, "flyball: no sub-command \"nosuch\"; try: flyball --help\n") << words;
  }
}

TEST_F(Cli, says_when_its_output_cannot_be_written) {
  for (const char* command :
       {"", "--help", "run --help", "version", "list scenarios", "list workloads", "list kernels",
        "list policies", "list platforms", "list worlds", "list airframes", "list knobs",
        "graph package_delivery", "config delivery_forest", "policy check two_level", "models",
        "bound delivery_open"}) {
    const FlyballProgram::Outcome full = flyball.run_into("> /dev/full", command);
    EXPECT_EQ(full.exit_code, 2) << command;
    EXPECT_EQ(full.errors,
              "flyball: cannot write the result to standard output: No space left on device; send "
              "it to another place\n")
        << command;
    EXPECT_EQ(flyball.run_into(">&-", command).exit_code, 2) << command;
  }
  EXPECT_TRUE(flyball.place.is_empty());
}

TEST_F(Cli, prints_its_version_and_help) {
  EXPECT_EQ(flyball.run("version").output.rfind("flyball ", 0), 0U);
  EXPECT_EQ(flyball.run("--version").output, flyball.run("version").output);
  EXPECT_EQ(flyball.run("version").output, flyball.run("version").output)
      << "the build stays the same";
  const FlyballProgram::Outcome help = flyball.run("--help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.output.find("compare"), std::string::npos);
}

/// A PNG file of 160 x 160 grey pixels.
std::string grey_png() {
  flyball::ColourImage image;
  image.camera = {160, 160, 0.0, 0.0, 0.0};
  image.rgb.assign(std::size_t{3} * 160 * 160, 120);
  return *flyball::png_of(image);
}

TEST_F(Cli, detect_of_a_folder_names_what_it_cannot_read_and_counts) {
  (void)flyball.place.file("a.png", grey_png());
  (void)flyball.place.file("b.jpg", "no picture");
  (void)flyball.place.file("c.png", grey_png());
  const auto outcome = flyball.run("detect . --detector hog");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
  EXPECT_EQ(outcome.errors, "flyball: \"./b.jpg\" cannot be read as a picture\n");
  EXPECT_NE(
      outcome.output.find("2 pictures, 0 with people, 0 people in all; 1 could not be read\n"),
      std::string::npos)
      << outcome.output;
  const auto json = flyball.run("detect . --detector hog --json");
  EXPECT_EQ(json.exit_code, 1);
  EXPECT_NE(json.output.find("{\"totals\":{\"frames\":2,\"with_people\":0,\"people\":0,"
                             "\"unreadable\":1}}\n"),
            std::string::npos)
      << json.output;
}

TEST_F(Cli, detect_looks_for_no_camera_where_a_file_is_no_video) {
  (void)flyball.place.file("a.avi", "RIFFxxxxAVI LISTgarbage");
  ASSERT_EQ(setenv("LD_DEBUG", "files", 1), 0);
  const auto outcome = flyball.run("detect a.avi");
  unsetenv("LD_DEBUG");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("libopencv_videoio"), std::string::npos);
  EXPECT_EQ(outcome.errors.find("libgphoto2_port/"), std::string::npos)
      << "libraries for cameras on the USB bus were loaded";
}

TEST_F(Cli, world_draws_a_plan_and_says_how_far_a_place_reaches) {
  (void)flyball.place.file("hall.obj",
                           "v -1 -4 0\nv 11 -4 0\nv 11 4 0\nv -1 4 0\nf 1 2 3 4\n"
                           "v 5.05 -2 0\nv 5.05 2 0\nv 5.05 2 3\nv 5.05 -2 3\nf 5 6 7 8\n");
  const auto other = flyball.run("world hall.obj --picture plan.jpg");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.errors.find("--picture \"plan.jpg\" must end in .png"), std::string::npos);
  const auto outcome = flyball.run("world hall.obj --picture plan.png");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("-1.00 to 11"), std::string::npos) << outcome.output;
  EXPECT_EQ(flyball.place.content("plan.png").substr(1, 3), "PNG");
}

TEST_F(Cli, world_refuses_what_it_cannot_draw) {
  expect_refused("world nowhere.bt --picture plan.png", "no mesh file \"nowhere.bt\"");
  expect_refused("world hall.obj --up x", "--up");
  for (const char* option : {"--height", "--ground", "--cell", "--metres-per-unit"}) {
    expect_refused(std::string{"world hall.obj "} + option + " nan", "nan is no number");
  }
}

// They would be read for ever.
TEST_F(Cli, refuses_devices_where_files_are_wanted) {
  const std::string zero = "/dev/zero";
  expect_refused("world " + zero, "no mesh file");
  expect_refused("map info " + zero, "no map file");
  expect_refused("run delivery_open --start-map " + zero, "no map file");
  const ScratchFolder devices;
  std::filesystem::create_symlink(zero, devices.path("rgb.txt"));
  expect_refused("localize " + devices.path(), "rgb.txt");
  std::filesystem::create_symlink(zero, devices.path("trace.jsonl"));
  expect_refused("replay " + devices.path(), "trace.jsonl; give the folder of a run");
}

TEST_F(Cli, refuses_a_lens_and_a_depth_that_are_none) {
  expect_refused("localize . --intrinsics 80,80,nan,36", "--intrinsics must be numbers of pixels");
  expect_refused("localize . --intrinsics 1e300,80,48,36", "--intrinsics must be numbers");
  expect_refused("localize . --depth-factor inf", "--depth-factor inf must be from");
  expect_refused("localize . --depth-factor 1e-300", "--depth-factor 0.000 must be from");
  expect_refused("localize . --uncertain-above nan", "nan is no number");
}

TEST_F(Cli, map_export_keeps_log_odds) {
  octomap::OcTree tree{0.1};
  for (int i = 0; i < 40; ++i) {
    tree.updateNode(0.1 * i + 0.05, 0.05, 0.05, 0.013F * static_cast<float>(i) - 0.2F);
  }
  ASSERT_TRUE(tree.write(flyball.place.path("a.ot")));
  const auto outcome = flyball.run("map export a.ot b.ot");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::unique_ptr<octomap::AbstractOcTree> read{
      octomap::AbstractOcTree::read(flyball.place.path("b.ot"))};
  const auto* copy = dynamic_cast<octomap::OcTree*>(read.get());
  ASSERT_NE(copy, nullptr);
  ASSERT_EQ(copy->getNumLeafNodes(), tree.getNumLeafNodes());
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const auto* node = copy->search(leaf.getKey());
    ASSERT_NE(node, nullptr);
    EXPECT_EQ(node->getLogOdds(), leaf->getLogOdds());
  }
}

}  // namespace

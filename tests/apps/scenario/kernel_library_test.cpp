// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/detector.h"
#include "flyball/records/report.h"
#include "flyball/scenario/scenario.h"

#include "scratch_folder.h"
#include <filesystem>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::string library(const std::string& name) {
  return FLYBALL_TEST_KERNELS "/lib" + name + ".so";
}

Plugins with_blind() {
  auto plugins = Plugins{}.with_library(library("blind"));
  EXPECT_TRUE(plugins.ok()) << plugins.error().message;
  return *plugins;
}

void expect_refused(const Plugins& plugins, const std::string& path, const std::string& why) {
  const auto before = plugins.names<Detector>();
  const auto loaded = plugins.with_library(path);
  ASSERT_FALSE(loaded.ok()) << path;
  EXPECT_NE(loaded.error().message.find("library \"" + path + "\" "), std::string::npos)
      << loaded.error().message;
  EXPECT_NE(loaded.error().message.find(why), std::string::npos) << loaded.error().message;
  EXPECT_EQ(plugins.names<Detector>(), before);
}

TEST(KernelLibrary, adds_names_that_scenarios_may_use) {
  const Plugins plugins = with_blind();
  ASSERT_NE(plugins.make<Detector>("blind"), nullptr);
  Work work;
  const auto seen = plugins.make<Detector>("blind")->detect(ColourImage{}, 1.0, work);
  ASSERT_TRUE(seen.ok());
  EXPECT_TRUE(seen->empty());
  const auto loaded = load_scenario("photography_park", {"kernels.detector=blind"}, plugins);
  EXPECT_TRUE(std::holds_alternative<LoadedScenario>(loaded));
}

TEST(KernelLibrary, is_unknown_to_missions_without_it) {
  const Plugins plugins = with_blind();
  EXPECT_EQ(Plugins{}.make<Detector>("blind"), nullptr);
  const auto loaded = load_scenario("photography_park", {"kernels.detector=blind"});
  EXPECT_TRUE(std::holds_alternative<std::vector<Error>>(loaded));
  EXPECT_TRUE(Plugins{}.with_library(library("blind_too")).ok()) << "brings the same name";
  expect_refused(plugins, library("blind_too"), "cannot be added: \"blind\" is taken");
}

TEST(KernelLibrary, is_added_once_whatever_path_leads_to_it) {
  const ScratchFolder scratch;
  const Plugins plugins = with_blind();
  ASSERT_EQ(plugins.libraries().size(), 1U);
  std::filesystem::create_symlink(library("blind"), scratch.path("libblind.so"));
  const auto again = plugins.with_library(scratch.path("libblind.so"));
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->libraries(), plugins.libraries());
}

TEST(KernelLibrary, belongs_to_the_mission) {
  Scenario scenario;
  const std::string line = "\n# Flown with --kernels: libblind.so\n";
  EXPECT_EQ(mission_file(scenario).find(line), std::string::npos);
  scenario.plugins = with_blind();
  EXPECT_NE(mission_file(scenario).find(line), std::string::npos);
}

TEST(KernelLibrary, that_is_none_is_refused_in_a_sentence) {
  const ScratchFolder scratch;
  expect_refused({}, scratch.path("gone.so"), "give a path to a file");
  expect_refused({}, scratch.path(), "give a path to a file");
  expect_refused({}, scratch.file("libtext.so", "not ELF"), "cannot be loaded: ");
  expect_refused({}, library("second_hog"), "cannot be added: \"hog\" is taken");
  expect_refused({}, library("empty_handed"), "adds nothing");
  expect_refused({}, library("sulking"), "throws: nothing works");
  std::filesystem::copy_file(library("blind"), scratch.path("libmine.so"));
  expect_refused({}, scratch.path("libmine.so"),
                 "exports no function flyball_plugin_mine; write "
                 "FLYBALL_PLUGIN(mine) in it");
}

}  // namespace
}  // namespace flyball

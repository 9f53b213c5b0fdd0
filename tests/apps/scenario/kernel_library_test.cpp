// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/kernel_library.h"

#include "flyball/kernels/detector.h"
#include "flyball/records/report.h"
#include "flyball/scenario/plugins.h"
#include "flyball/simulation/mission.h"

#include "scratch_folder.h"
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::string library(const std::string& name) {
  return FLYBALL_TEST_KERNELS "/lib" + name + ".so";
}

void expect_refused(const std::string& path, const std::string& why) {
  const auto before = all_plugins().names<Detector>();
  const Status loaded = load_kernels(path);
  ASSERT_FALSE(loaded.ok()) << path;
  EXPECT_NE(loaded.error().message.find("library \"" + path + "\" "), std::string::npos)
      << loaded.error().message;
  EXPECT_NE(loaded.error().message.find(why), std::string::npos) << loaded.error().message;
  EXPECT_EQ(all_plugins().names<Detector>(), before);
}

TEST(KernelLibrary, adds_names_that_scenarios_may_use) {
  ASSERT_TRUE(load_kernels(library("blind")).ok());
  ASSERT_NE(all_plugins().make<Detector>("blind"), nullptr);
  Work work;
  const auto seen = all_plugins().make<Detector>("blind")->detect(ColourImage{}, 1.0, work);
  ASSERT_TRUE(seen.ok());
  EXPECT_TRUE(seen->empty());
  const auto loaded = load_scenario("photography_park", {"kernels.detector=blind"});
  EXPECT_TRUE(std::holds_alternative<LoadedScenario>(loaded));
}

TEST(KernelLibrary, is_loaded_once_whatever_path_leads_to_it) {
  const ScratchFolder scratch;
  ASSERT_TRUE(load_kernels(library("blind")).ok());
  const std::size_t count = loaded_kernel_libraries().size();
  std::filesystem::create_symlink(library("blind"), scratch.path("libblind.so"));
  EXPECT_TRUE(load_kernels(scratch.path("libblind.so")).ok());
  EXPECT_EQ(loaded_kernel_libraries().size(), count);
}

TEST(KernelLibrary, belongs_to_the_mission) {
  ASSERT_TRUE(load_kernels(library("blind")).ok());
  EXPECT_NE(mission_file(Scenario{}).find("\n# Flown with --kernels: libblind.so\n"),
            std::string::npos);
}

TEST(KernelLibrary, that_is_none_is_refused_in_a_sentence) {
  const ScratchFolder scratch;
  expect_refused(scratch.path("gone.so"), "give a path to a file");
  expect_refused(scratch.path(), "give a path to a file");
  expect_refused(scratch.file("libtext.so", "not ELF"), "cannot be loaded: ");
  expect_refused(library("second_hog"), "cannot be added: \"hog\" is taken");
  expect_refused(library("empty_handed"), "adds nothing");
  expect_refused(library("sulking"), "throws: nothing works");
  std::filesystem::copy_file(library("blind"), scratch.path("libmine.so"));
  expect_refused(scratch.path("libmine.so"),
                 "exports no function flyball_plugin_mine; write "
                 "FLYBALL_PLUGIN(mine) in it");
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/mission_files.h"

#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(MissionFiles, no_output_takes_the_place_of_a_file_that_is_read) {
  const ScratchFolder folder;
  Scenario scenario;
  scenario.platform.name = folder.file("plat.toml", "like = \"jetson_tx2\"\nname = \"plat\"\n");
  scenario.governor.policy = folder.file("rule.lua", "");
  scenario.world.parameters["file"] = folder.file("place.bt", "");
  const std::string own = folder.file("own.toml", "");
  EXPECT_TRUE(keep_inputs(scenario, {own, ""}, {"", folder.path("new")}).ok());
  for (const std::string& read :
       {scenario.platform.name, scenario.governor.policy, folder.path("place.bt"), own}) {
    const Status lost = keep_inputs(scenario, {own, ""}, {folder.path("new"), read});
    ASSERT_FALSE(lost.ok()) << read;
    EXPECT_EQ(lost.error().message, "the flight reads \"" + read +
                                        "\" and would overwrite it; choose another place for "
                                        "what it writes");
  }
}

TEST(MissionFiles, what_stands_in_them_is_part_of_the_mission) {
  const ScratchFolder folder;
  Scenario scenario;
  scenario.world.parameters["file"] = folder.file("place.bt", "a");
  const std::string before = data_fingerprint(scenario);
  (void)folder.file("place.bt", "b");
  EXPECT_NE(data_fingerprint(scenario), before);
}

}  // namespace
}  // namespace flyball

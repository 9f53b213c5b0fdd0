// SPDX-License-Identifier: BSD-3-Clause
//
// One rule as a preset, a script and a library flies one and the same mission.
#ifdef FLYBALL_EXAMPLES

#include "scratch_folder.h"
#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Summary flown_with(const std::string& policy) {
  Scenario scenario;
  scenario.name = "short_forest";
  scenario.world.generator = "forest";
  scenario.world.parameters = {{"goal_distance_m", 20.0}, {"width_m", 20.0}};
  scenario.governor.policy = policy;
  scenario.mission.time_limit_s = 240.0;
  scenario.camera.width_px = 64;
  scenario.camera.height_px = 36;
  return kit::flown(scenario).summary;
}

TEST(PolicyFlights, of_one_rule_in_three_kinds_of_file_have_one_trace) {
  const Summary preset = flown_with(FLYBALL_EXAMPLES "/density_switch.toml");
  EXPECT_GE(preset.knob_changes, 3U) << "it switches to and fro";
  EXPECT_EQ(0U, preset.policy_faults);
  EXPECT_EQ(preset.trace_hash, flown_with(FLYBALL_EXAMPLE_LIBRARY).trace_hash);
#ifdef FLYBALL_HAS_LUA
  EXPECT_EQ(preset.trace_hash, flown_with(FLYBALL_EXAMPLES "/density_switch.lua").trace_hash);
#endif
}

#ifdef FLYBALL_HAS_LUA
TEST(PolicyFlights, of_a_rule_that_fails_are_flown_with_safe_settings_and_say_why) {
  const ScratchFolder scratch;
  const Summary summary =
      flown_with(scratch.file("tired.lua", "function decide(seen)\n  error('no more')\nend\n"));
  EXPECT_EQ(summary.status, MissionStatus::succeeded);
  EXPECT_EQ(summary.policy_faults, summary.decisions);
  EXPECT_NE(summary.policy_trouble.find("tired.lua:2: no more"), std::string::npos)
      << summary.policy_trouble;
}
#endif

}  // namespace
}  // namespace flyball

#endif

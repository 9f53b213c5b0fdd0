// SPDX-License-Identifier: BSD-3-Clause
//
// One rule as a preset, a script and a library flies one and the same mission.
#ifdef FLYBALL_EXAMPLES

#include "../apps/short_delivery.h"

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

}  // namespace
}  // namespace flyball

#endif

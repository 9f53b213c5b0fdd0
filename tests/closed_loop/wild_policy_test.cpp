// SPDX-License-Identifier: BSD-3-Clause
//
// The guard's promise: whatever a policy says costs time, never a collision.
#ifdef FLYBALL_HAS_LUA

#include "../apps/short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Scenario short_forest(std::uint64_t seed, const std::string& policy) {
  Scenario scenario;
  scenario.name = "short_forest";
  scenario.seed = seed;
  scenario.world.generator = "forest";
  scenario.world.parameters = {{"goal_distance_m", 20.0}, {"width_m", 20.0}};
  scenario.governor.policy = policy;
  scenario.mission.time_limit_s = 240.0;
  scenario.camera.width_px = 64;
  scenario.camera.height_px = 36;
  return scenario;
}

TEST(WildPolicy, loses_time_but_touches_nothing) {
  std::uint64_t faults = 0;
  std::uint64_t changes = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Summary summary =
        kit::flown(short_forest(seed, FLYBALL_CLOSED_LOOP_TESTS "/wild.lua")).summary;
    EXPECT_NE(MissionFailure::collision, summary.failure) << seed;
    EXPECT_GT(summary.min_clearance_m, 0.0) << seed;
    faults += summary.policy_faults;
    changes += summary.knob_changes;
  }
  EXPECT_GT(faults, 0U) << "not wild enough";
  EXPECT_GT(changes, 100U) << "not wild enough";
}

TEST(WildPolicy, each_fault_is_an_event_in_one_sentence_with_file_and_line) {
  const MissionRecord record = kit::flown(short_forest(2, FLYBALL_CLOSED_LOOP_TESTS "/wild.lua"));
  std::size_t falls = 0;
  std::size_t named = 0;
  for (const auto& row : record.trace->rows()) {
    if (row.channel == "event") {
      const auto& what = std::get<std::string>(row.fields.front().value);
      falls += what.rfind("fallback safe_static: ", 0) == 0 ? 1 : 0;
      named += what.find("wild.lua:") != std::string::npos ? 1 : 0;
    }
  }
  EXPECT_GT(falls, 0U);
  EXPECT_GT(named, 0U);
}

}  // namespace
}  // namespace flyball

#endif

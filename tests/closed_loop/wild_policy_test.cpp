// SPDX-License-Identifier: BSD-3-Clause
//
// What the guard ensures: a policy may cost time, but never a collision.
#ifdef FLYBALL_HAS_LUA

#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Two half minutes among trees: extreme maps take the host long. Many more: see wild.lua.
std::vector<MissionRecord> wild_flights() {
  std::vector<MissionRecord> all;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Scenario scenario;
    scenario.name = "short_forest";
    scenario.seed = seed;
    scenario.world.generator = "forest";
    scenario.world.parameters = {{"goal_distance_m", 20.0}, {"width_m", 20.0}};
    scenario.governor.policy = FLYBALL_CLOSED_LOOP_TESTS "/wild.lua";
    scenario.mission.time_limit_s = 25.0;
    scenario.camera.width_px = 32;
    scenario.camera.height_px = 18;
    all.push_back(kit::flown(scenario));
  }
  return all;
}

TEST(WildPolicy, loses_time_but_touches_nothing_and_each_fault_is_named) {
  std::uint64_t faults = 0;
  std::uint64_t changes = 0;
  std::size_t falls = 0;
  std::size_t named = 0;
  for (const MissionRecord& record : wild_flights()) {
    EXPECT_NE(MissionFailure::collision, record.summary.failure) << record.summary.seed;
    EXPECT_GT(record.summary.min_clearance_m, 0.0) << record.summary.seed;
    faults += record.summary.policy_faults;
    changes += record.summary.knob_changes;
    for (const auto& row : record.trace->rows()) {
      if (row.channel == "event") {
        const auto& what = std::get<std::string>(row.fields.front().value);
        falls += what.rfind("fallback safe_static: ", 0) == 0 ? 1 : 0;
        named += what.find("wild.lua:") != std::string::npos ? 1 : 0;
      }
    }
  }
  EXPECT_GT(faults, 0U) << "not wild enough";
  EXPECT_GT(changes, 50U) << "not wild enough";
  EXPECT_GT(falls, 0U);
  EXPECT_GT(named, 0U) << "with file and line";
}

}  // namespace
}  // namespace flyball

#endif

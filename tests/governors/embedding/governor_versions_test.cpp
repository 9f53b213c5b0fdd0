// SPDX-License-Identifier: BSD-3-Clause
//
// Callers whose header is older or newer than the library.
#include "governed_loop.h"
#include "sized_memory.h"
#include <cstddef>

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

TEST(OlderCaller, opens_and_decides_with_the_first_version_of_each_structure) {
  GovernedLoop loop;
  SizedMemory knob{loop.cell_knob(), offsetof(FlyballGovernorKnob, min_dwell_s)};
  ASSERT_EQ(flyball_governor_ok, flyball_governor_add_knob(loop.governor, knob.get()))
      << loop.error();
  SizedMemory stage{GovernedLoop::stage("mapping"), offsetof(FlyballGovernorStage, deadline_s)};
  ASSERT_EQ(flyball_governor_ok, flyball_governor_add_stage(loop.governor, stage.get()));
  SizedMemory settings{loop.settings("density"), offsetof(FlyballGovernorSettings, seed)};
  ASSERT_EQ(flyball_governor_ok, flyball_governor_open(loop.governor, settings.get()))
      << loop.error();
  loop.observe("phase", flyball_governor_cruise);
  SizedMemory decision{FlyballGovernorDecision{}, offsetof(FlyballGovernorDecision, decided)};
  ASSERT_EQ(flyball_governor_ok, flyball_governor_decide(loop.governor, 0.0, decision.get()));
  EXPECT_STREQ("density", decision.get()->reason);
  EXPECT_EQ((std::vector<double>{0.80}), loop.applied);
  SizedMemory entry{FlyballGovernorEntry{}, offsetof(FlyballGovernorEntry, is_known)};
  ASSERT_EQ(flyball_governor_ok, flyball_governor_list(loop.governor, 0, entry.get()));
  EXPECT_STREQ("phase", entry.get()->name);
}

TEST(OlderCaller, is_not_read_or_written_beyond_what_he_knows) {
  GovernedLoop loop;
  // Behind what the caller knows lies something else of his.
  FlyballGovernorKnob knob = loop.cell_knob();
  knob.struct_size = offsetof(FlyballGovernorKnob, min_dwell_s);
  knob.min_dwell_s = -1.0;
  ASSERT_EQ(flyball_governor_ok, loop.add(knob)) << loop.error();
  ASSERT_EQ(flyball_governor_ok, loop.open(loop.settings("density")));
  FlyballGovernorDecision decision{};
  decision.struct_size = offsetof(FlyballGovernorDecision, decided);
  decision.decided[0] = 7.0;
  ASSERT_EQ(flyball_governor_ok, flyball_governor_decide(loop.governor, 0.0, &decision));
  EXPECT_EQ(7.0, decision.decided[0]);
  EXPECT_EQ(offsetof(FlyballGovernorDecision, decided), decision.struct_size);
}

TEST(NewerCaller, is_understood_as_far_as_the_library_goes) {
  struct Newer {
    FlyballGovernorKnob known;
    double more[4];
  };
  GovernedLoop loop;
  Newer newer{loop.cell_knob(), {1.0, 2.0, 3.0, 4.0}};
  newer.known.struct_size = sizeof newer;
  ASSERT_EQ(flyball_governor_ok, flyball_governor_add_knob(loop.governor, &newer.known))
      << loop.error();
  EXPECT_EQ(0.15, loop.list().at("map.resolution_m").value);
}

TEST(OldestCaller, must_know_what_cannot_be_absent) {
  GovernedLoop loop;
  SizedMemory knob{loop.cell_knob(), offsetof(FlyballGovernorKnob, min_dwell_s) - 1};
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_add_knob(loop.governor, knob.get()));
}

}  // namespace
}  // namespace flyball::kit

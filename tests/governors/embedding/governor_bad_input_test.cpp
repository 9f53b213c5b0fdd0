// SPDX-License-Identifier: BSD-3-Clause
//
// A caller's mistakes: each gets a code and a sentence, and the governor goes on.
#include "governed_loop.h"
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Why a knob like the usual one, but for a change, is not added.
std::string refused_knob(const std::function<void(FlyballGovernorKnob&)>& change) {
  GovernedLoop loop;
  FlyballGovernorKnob knob = loop.cell_knob();
  change(knob);
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(knob));
  const std::string error = loop.error();
  EXPECT_EQ(0U, loop.list().count("map.resolution_m"));
  return error;
}

TEST(BadInput, a_governor_that_is_null) {
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_add_knob(nullptr, nullptr));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_add_stage(nullptr, nullptr));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_open(nullptr, nullptr));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_begin(nullptr, 0, 0.0));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_end(nullptr, 0, 0.0, nullptr, 0));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_observe(nullptr, "phase", 1.0));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_decide(nullptr, 0.0, nullptr));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_granted(nullptr, "x.y", 1.0));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_list(nullptr, 0, nullptr));
  EXPECT_STREQ("the governor is NULL", flyball_governor_last_error(nullptr));
  flyball_governor_close(nullptr);
}

TEST(BadInput, structures_that_are_null_or_of_no_size) {
  GovernedLoop loop;
  EXPECT_STREQ("", flyball_governor_last_error(loop.governor));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_add_knob(loop.governor, nullptr));
  EXPECT_EQ("the FlyballGovernorKnob is NULL", loop.error());
  FlyballGovernorKnob knob = loop.cell_knob();
  knob.struct_size = 0;
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(knob));
  EXPECT_EQ("the FlyballGovernorKnob has a struct_size of 0; set it to sizeof(FlyballGovernorKnob)",
            loop.error());
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_add_stage(loop.governor, nullptr));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_open(loop.governor, nullptr));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_list(loop.governor, 0, nullptr));
  loop.open_density();
  FlyballGovernorDecision decision{};
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_decide(loop.governor, 0.0, &decision));
  EXPECT_TRUE(loop.lines.empty()) << "nothing was decided";
}

TEST(BadInput, knobs_that_cannot_be) {
  EXPECT_EQ("a knob needs a name", refused_knob([](auto& knob) { knob.name = nullptr; }));
  EXPECT_EQ("a knob needs a name", refused_knob([](auto& knob) { knob.name = ""; }));
  EXPECT_EQ("knob \"cells\" needs a name of two parts, as in map.range_m",
            refused_knob([](auto& knob) { knob.name = "cells"; }));
  EXPECT_EQ("a knob's name has a space or a control character: a.b [31m",
            refused_knob([](auto& knob) { knob.name = "a.b\033[31m"; }))
      << "and no terminal is steered";
  const std::string name = "a." + std::string(62, 'b');
  EXPECT_NE(std::string::npos,
            refused_knob([&](auto& knob) { knob.name = name.c_str(); }).find("more than 63"));
  const auto needs_texts =
      "knob \"map.resolution_m\" needs a unit (\"1\" where there is none) and "
      "a description";
  EXPECT_EQ(needs_texts, refused_knob([](auto& knob) { knob.unit = nullptr; }));
  EXPECT_EQ(needs_texts, refused_knob([](auto& knob) { knob.description = nullptr; }));
  EXPECT_NE("", refused_knob([](auto& knob) { knob.unit = ""; }));
}

TEST(BadInput, values_of_a_knob_that_cannot_be) {
  EXPECT_EQ("knob \"map.resolution_m\" has 3 legal values, but legal is NULL",
            refused_knob([](auto& knob) { knob.legal = nullptr; }));
  const double descending[] = {0.8, 0.4, 0.15};
  EXPECT_NE("", refused_knob([&](auto& knob) { knob.legal = descending; }));
  const double broken[] = {0.15, nan, 0.8};
  EXPECT_NE("", refused_knob([&](auto& knob) { knob.legal = broken; }));
  EXPECT_EQ("knob \"map.resolution_m\" cannot be 0.3 m at first; legal: 0.15, 0.4, 0.8",
            refused_knob([](auto& knob) { knob.start = 0.3; }));
  EXPECT_NE("", refused_knob([](auto& knob) { knob.start = nan; }));
  EXPECT_NE("", refused_knob([](auto& knob) { knob.min_dwell_s = -1.0; }));
  EXPECT_NE("", refused_knob([](auto& knob) { knob.min_dwell_s = nan; }));
  EXPECT_NE("", refused_knob([](auto& knob) { knob.follows = "map.unknown"; }));
  const auto limits = [](double min, double max) {
    return refused_knob([=](auto& knob) {
      knob.legal_count = 0;
      knob.min = min;
      knob.max = max;
    });
  };
  EXPECT_NE("", limits(1.0, 0.1));
  EXPECT_NE("", limits(0.1, infinite));
  EXPECT_NE("", limits(nan, 1.0));
}

TEST(BadInput, a_knob_twice_and_one_too_many) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(loop.cell_knob()));
  EXPECT_EQ("knob \"map.resolution_m\" was added already", loop.error());
  for (int i = 1; i < flyball_governor_capacity; ++i) {
    const std::string name = "my.knob_" + std::to_string(i);
    FlyballGovernorKnob knob = loop.cell_knob();
    knob.name = name.c_str();
    ASSERT_EQ(flyball_governor_ok, loop.add(knob)) << loop.error();
  }
  FlyballGovernorKnob knob = loop.cell_knob();
  knob.name = "one.more";
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(knob));
  EXPECT_EQ("knob \"one.more\" is one too many: a governor has at most 16", loop.error());
  EXPECT_EQ(flyball_governor_ok, loop.open(loop.settings("density"))) << loop.error();
}

TEST(BadInput, a_knob_that_follows_one_that_follows) {
  GovernedLoop loop;
  FlyballGovernorKnob knob = loop.cell_knob();
  ASSERT_EQ(flyball_governor_ok, loop.add(knob));
  knob.name = "map.range_m";
  knob.follows = "map.resolution_m";
  ASSERT_EQ(flyball_governor_ok, loop.add(knob)) << loop.error();
  knob.name = "map.height_m";
  knob.follows = "map.range_m";
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(knob));
  EXPECT_EQ(
      "knob \"map.height_m\" follows \"map.range_m\", which follows \"map.resolution_m\" itself; "
      "follow that one",
      loop.error());
}

TEST(BadInput, a_record_that_throws) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  FlyballGovernorSettings settings = loop.settings("density");
  settings.record = [](void*, const char*) { throw std::runtime_error{"the disk is full"}; };
  ASSERT_EQ(flyball_governor_ok, loop.open(settings));
  loop.observe("phase", flyball_governor_cruise);
  EXPECT_EQ(0.80, loop.decide(0.0).in_force[0]) << "all else is done";
  EXPECT_EQ(flyball_governor_failed, loop.code);
  EXPECT_EQ("the record's callback threw an exception", loop.error());
}

TEST(BadInput, stages_that_cannot_be) {
  GovernedLoop loop;
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(GovernedLoop::stage(nullptr)));
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(GovernedLoop::stage("my stage")));
  FlyballGovernorStage stage = GovernedLoop::stage("mapping");
  stage.work_count = 2;
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(stage));
  EXPECT_EQ("stage \"mapping\" counts 2 things, but work is NULL", loop.error());
  const char* const work[] = {"cells", nullptr};
  stage.work = work;
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(stage));
  stage.work_count = 1;
  stage.deadline_s = nan;
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(stage));
  stage.deadline_s = -1.0;
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(stage));
  stage.deadline_s = 0.1;
  EXPECT_EQ(flyball_governor_ok, loop.add(stage));
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(stage));
  EXPECT_EQ("stage \"mapping\" was added already", loop.error());
}

TEST(BadInput, calls_before_it_is_open_and_additions_afterwards) {
  GovernedLoop loop;
  EXPECT_EQ(flyball_governor_invalid_input, loop.open(loop.settings("density")));
  EXPECT_EQ("there is nothing to govern; call flyball_governor_add_knob first", loop.error());
  EXPECT_EQ(flyball_governor_invalid_input, loop.observe("phase", 1.0));
  EXPECT_EQ("flyball_governor_observe: call flyball_governor_open first", loop.error());
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_begin(loop.governor, 0, 0.0));
  EXPECT_EQ("flyball_governor_begin: call flyball_governor_open first", loop.error());
  EXPECT_EQ(flyball_governor_invalid_input,
            flyball_governor_end(loop.governor, 0, 0.0, nullptr, 0));
  EXPECT_EQ("flyball_governor_end: call flyball_governor_open first", loop.error());
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_granted(loop.governor, "a.b", 0.0));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_decide(loop.governor, 0.0, nullptr));
  ASSERT_EQ(flyball_governor_ok, loop.open_density());
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(loop.clock_knob()));
  EXPECT_EQ("flyball_governor_add_knob: this governor is open already; call it before",
            loop.error());
  EXPECT_EQ(flyball_governor_invalid_input, loop.add(GovernedLoop::stage("late")));
  EXPECT_EQ(flyball_governor_invalid_input, loop.open(loop.settings("density")));
  EXPECT_EQ(0.80, loop.decide(0.0).in_force[0]);
}

TEST(BadInput, can_be_mended_and_opened_again) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  EXPECT_EQ(flyball_governor_not_found, loop.open(loop.settings("dense")));
  EXPECT_EQ(flyball_governor_ok, loop.open(loop.settings("density")));
}

TEST(BadInput, settings_that_cannot_be) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  FlyballGovernorSettings settings = loop.settings("density");
  settings.min_dwell_s = -1.0;
  EXPECT_EQ(flyball_governor_invalid_input, loop.open(settings));
  settings.min_dwell_s = 0.0;
  settings.first_latency_s = nan;
  EXPECT_EQ(flyball_governor_invalid_input, loop.open(settings));
  settings.first_latency_s = 0.0;
  settings.reaction_s = infinite;
  EXPECT_EQ(flyball_governor_invalid_input, loop.open(settings));
  EXPECT_EQ("min_dwell_s, first_latency_s and reaction_s must be finite and not negative",
            loop.error());
}

TEST(BadInput, times_that_cannot_be) {
  GovernedLoop loop;
  loop.open_density();
  for (const double now_s : {nan, infinite, -infinite, 1e300, -100.0}) {
    loop.decide(now_s);
    EXPECT_EQ(flyball_governor_invalid_input, loop.code) << now_s;
  }
  EXPECT_TRUE(loop.lines.empty());
  loop.decide(5.0);
  loop.decide(4.0);
  EXPECT_EQ(flyball_governor_invalid_input, loop.code);
  EXPECT_EQ("the time went back from 5.000000000 s to 4.000000000 s; a governor needs one clock",
            loop.error());
  loop.decide(5.0);
  EXPECT_EQ(flyball_governor_ok, loop.code);
}

TEST(BadInput, stages_that_do_not_exist_or_end_before_they_begin) {
  GovernedLoop loop;
  loop.add(GovernedLoop::stage("mapping"));
  loop.open_density();
  EXPECT_EQ(flyball_governor_not_found, flyball_governor_begin(loop.governor, 1, 0.0));
  EXPECT_EQ("there is no stage 1; 1 were added", loop.error());
  EXPECT_EQ(flyball_governor_not_found,
            flyball_governor_end(loop.governor, 4294967295U, 0.0, nullptr, 0));
  EXPECT_EQ(flyball_governor_invalid_input,
            flyball_governor_end(loop.governor, 0, 0.0, nullptr, 0));
  EXPECT_EQ("stage \"mapping\" ends, but it has not begun", loop.error());
}

TEST(BadInput, counts_that_cannot_be) {
  GovernedLoop loop;
  const char* const work[] = {"cells"};
  FlyballGovernorStage stage = GovernedLoop::stage("mapping");
  stage.work = work;
  stage.work_count = 1;
  loop.add(stage);
  loop.open_density();
  flyball_governor_begin(loop.governor, 0, 0.0);
  const double negative = -1.0;
  EXPECT_EQ(flyball_governor_invalid_input,
            flyball_governor_end(loop.governor, 0, 0.0, nullptr, 1));
  EXPECT_EQ(flyball_governor_invalid_input,
            flyball_governor_end(loop.governor, 0, 0.0, &negative, 1));
  EXPECT_EQ(flyball_governor_invalid_input, flyball_governor_end(loop.governor, 0, 0.0, &nan, 1));
  EXPECT_EQ(flyball_governor_ok, flyball_governor_end(loop.governor, 0, 0.1, nullptr, 0));
}

TEST(BadInput, grants_that_cannot_be) {
  GovernedLoop loop;
  loop.open_density();
  EXPECT_EQ(flyball_governor_not_found, flyball_governor_granted(loop.governor, "map.cells", 1.0));
  EXPECT_EQ("there is no knob \"map.cells\"; it was never added", loop.error());
  EXPECT_EQ(flyball_governor_not_found, flyball_governor_granted(loop.governor, nullptr, 1.0));
  EXPECT_EQ(flyball_governor_invalid_input,
            flyball_governor_granted(loop.governor, "map.resolution_m", nan));
}

TEST(BadInput, a_list_has_an_end) {
  GovernedLoop loop;
  FlyballGovernorEntry entry{};
  entry.struct_size = sizeof entry;
  EXPECT_EQ(flyball_governor_not_found, flyball_governor_list(loop.governor, 58, &entry));
  EXPECT_EQ("the list has no entry 58", loop.error());
}

}  // namespace
}  // namespace flyball::kit

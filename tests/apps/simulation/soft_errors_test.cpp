// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop

#include "simulation/soft_errors.h"

#include "flyball/simulation/mission.h"

#include "short_delivery.h"
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Scenario hit(const std::string& topic, double draw, const std::string& variable = "any") {
  Scenario scenario = kit::short_delivery();
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["cost_of"] = "octomap";
  scenario.governor.policy = "fixed_fine";
  scenario.map.resolution_m = 0.6;
  ComputerEvent flip;
  flip.kind = "bit_flip";
  flip.at_s = 4.0;
  flip.topic = topic;
  flip.variable = variable;
  flip.draw = draw;
  scenario.events = {flip};
  return scenario;
}

std::string event_with(const MissionRecord& record, const std::string& beginning) {
  for (const MemoryRecorder::Row& row : record.trace->rows()) {
    if (row.channel == "event") {
      const auto& what = std::get<std::string>(row.fields.front().value);
      if (what.rfind(beginning, 0) == 0) {
        return what;
      }
    }
  }
  return "";
}

TEST(SoftErrors, one_bit_of_one_number_flips_and_the_record_says_which) {
  const MissionRecord record = kit::flown(hit("setpoint", 1.0, "vx"));
  EXPECT_EQ(record.summary.quality.at("bit_flips"), 1.0);
  const std::string what = event_with(record, "bit_flip in setpoint, bit ");
  EXPECT_NE(what.find(" of vx: "), std::string::npos) << what;
  EXPECT_NE(what.find(" became "), std::string::npos) << what;
}

TEST(SoftErrors, that_end_before_a_message_comes_hit_none) {
  Scenario scenario = hit("setpoint", 1.0);
  scenario.events.front().topic = "plan.response";  // None so early.
  scenario.events.front().at_s = 0.0;
  scenario.events.front().until_s = 0.5;
  EXPECT_EQ(kit::flown(scenario).summary.quality.at("bit_flips"), 0.0);
}

TEST(SoftErrors, draws_differ_and_the_same_draw_repeats) {
  const MissionRecord one = kit::flown(hit("setpoint", 1.0));
  const MissionRecord same = kit::flown(hit("setpoint", 1.0));
  const MissionRecord other = kit::flown(hit("setpoint", 2.0));
  EXPECT_EQ(one.summary.trace_hash, same.summary.trace_hash);
  EXPECT_NE(event_with(one, "bit_flip"), event_with(other, "bit_flip"));
}

TEST(SoftErrors, reach_every_stage) {
  for (const char* topic : {"cloud", "clearance", "plan.response", "path", "pose"}) {
    const MissionRecord record = kit::flown(hit(topic, 3.0));
    EXPECT_EQ(record.summary.quality.at("bit_flips"), 1.0) << topic;
    EXPECT_NE(event_with(record, std::string{"bit_flip in "} + topic), "") << topic;
  }
}

/// The highest bit of the exponent: the number becomes a huge or a tiny one.
bool is_gross(const std::string& what) {
  return what.find(", bit 62 of ") != std::string::npos;
}

TEST(SoftErrors, a_detector_refuses_what_no_vehicle_can_mean) {
  std::string what;
  for (int draw = 1; draw <= 400 && !is_gross(what); ++draw) {
    Scenario scenario = hit("setpoint", draw, "z");
    scenario.faults.detector = "both";
    scenario.mission.time_limit_s = 4.2;  // Ends soon after the flip.
    const MissionRecord record = kit::flown(scenario);
    what = event_with(record, "bit_flip");
    if (is_gross(what)) {
      EXPECT_EQ(record.summary.quality.at("refused_messages"), 1.0) << what;
    }
  }
  EXPECT_TRUE(is_gross(what)) << what;
}

TEST(SoftErrors, detectors_leave_a_flight_without_errors_as_it_is) {
  Scenario quiet = hit("setpoint", 1.0);
  quiet.events.clear();
  const MissionRecord bare = kit::flown(quiet);
  quiet.faults.detector = "both";
  const MissionRecord guarded = kit::flown(quiet);
  EXPECT_EQ(guarded.summary.quality.at("refused_messages"), 0.0);
  EXPECT_EQ(guarded.summary.trace_hash, bare.summary.trace_hash);
}

TEST(SoftErrors, a_topic_that_cannot_be_hit_is_refused_with_those_that_can) {
  const auto record = fly(hit("map_revision", 1.0), {});
  ASSERT_FALSE(record);
  EXPECT_NE(record.error().message.find("events.1.topic = \"map_revision\""), std::string::npos)
      << record.error().message;
  EXPECT_NE(record.error().message.find("setpoint"), std::string::npos);
}

}  // namespace
}  // namespace flyball

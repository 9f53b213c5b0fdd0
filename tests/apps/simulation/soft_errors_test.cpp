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

TEST(SoftErrors, a_detector_refuses_what_no_vehicle_can_mean) {
  // Of draws that make a set-point's place wrong by metres some are refused, and undisturbed
  // flights lose nothing.
  double refused = 0.0;
  for (const double draw : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0}) {
    Scenario scenario = hit("setpoint", draw, "x");
    scenario.faults.detector = "both";
    refused += kit::flown(scenario).summary.quality.at("refused_messages");
  }
  EXPECT_GE(refused, 1.0);
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

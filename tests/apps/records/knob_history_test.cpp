// SPDX-License-Identifier: BSD-3-Clause

#include "records/knob_history.h"

#include "flyball/flight/governing/choice_text.h"
#include "flyball/records/report.h"

#include "made_flights.h"
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

KnobSpec range_knob() {
  return {"map.range_m", "m", "points", {}, 2.0, 25.0, 7.0, "how far depth is integrated"};
}

KnobSpec planner_knob() {
  KnobSpec spec{"planner.kind", "kind", "plan", {0.0, 1.0}, 0.0, 1.0, 0.0, "which planner works"};
  spec.labels = {"rrt_connect", "bit_star"};
  return spec;
}

MissionRecord record_with_knobs() {
  MissionRecord record = made_record("a", 1);
  record.knobs = KnobSettings{{range_knob(), planner_knob()}};
  return record;
}

void decide(MissionRecord& record, double at_s, const std::string& knob, double value) {
  record.trace->record(MissionTime{from_seconds(at_s)}, "decision",
                       {{"knob", knob}, {"value", value}, {"before", 0.0}});
}

TEST(KnobHistory, a_knob_has_its_start_and_each_change) {
  MissionRecord record = record_with_knobs();
  decide(record, 0.5, "map.range_m", 20.0);
  decide(record, 1.0, "planner.kind", 1.0);
  decide(record, 1.25, "map.range_m", 7.8195210751926822);
  const Json range = knobs_json(record)[0];
  EXPECT_EQ(range["name"], "map.range_m");
  EXPECT_EQ(range["unit"], "m");
  EXPECT_EQ(range["t"], (std::vector<double>{0.0, 0.5, 1.25}));
  EXPECT_EQ(range["v"], (std::vector<double>{7.0, 20.0, 7.81952}));
  EXPECT_EQ(range["changes"], 2);
}

TEST(KnobHistory, a_knob_that_nobody_turned_has_its_start_only) {
  const Json planner = knobs_json(record_with_knobs())[1];
  EXPECT_EQ(planner["v"], (std::vector<double>{0.0}));
  EXPECT_EQ(planner["changes"], 0);
}

TEST(KnobHistory, what_is_legal_is_a_range_or_the_values_with_what_they_stand_for) {
  const Json knobs = knobs_json(record_with_knobs());
  EXPECT_EQ(knobs[0]["min"], 2.0);
  EXPECT_EQ(knobs[0]["max"], 25.0);
  EXPECT_FALSE(knobs[0].contains("legal"));
  EXPECT_FALSE(knobs[0].contains("labels"));
  EXPECT_EQ(knobs[1]["legal"], (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(knobs[1]["labels"], (std::vector<std::string>{"rrt_connect", "bit_star"}));
}

TEST(KnobHistory, the_policys_first_setting_replaces_the_default_at_take_off) {
  MissionRecord record = record_with_knobs();
  decide(record, 0.0, "map.range_m", 20.0);
  const Json range = knobs_json(record)[0];
  EXPECT_EQ(range["t"], (std::vector<double>{0.0}));
  EXPECT_EQ(range["v"], (std::vector<double>{20.0}));
  EXPECT_EQ(range["changes"], 0);
}

TEST(KnobHistory, very_many_changes_become_their_outline) {
  MissionRecord record = record_with_knobs();
  constexpr int changes = 100'000;
  for (int i = 1; i <= changes; ++i) {  // To and fro, with one peak and one dip of 1 ms.
    const double value = i == 50'001 ? 25.0 : i == 70'001 ? 2.0 : i % 2 == 0 ? 10.0 : 12.0;
    decide(record, 1e-3 * i, "map.range_m", value);
  }
  const Json range = knobs_json(record)[0];
  const auto t = range["t"].get<std::vector<double>>();
  const auto v = range["v"].get<std::vector<double>>();
  EXPECT_EQ(range["changes"], changes);
  ASSERT_EQ(t.size(), v.size());
  EXPECT_LT(t.size(), 10'000U);
  EXPECT_TRUE(std::is_sorted(t.begin(), t.end()));
  EXPECT_EQ(t.front(), 0.0);
  EXPECT_EQ(t.back(), 100.0);
  EXPECT_EQ(v.back(), 10.0);
  const auto peak = std::find(v.begin(), v.end(), 25.0) - v.begin();
  ASSERT_LT(peak, static_cast<std::ptrdiff_t>(v.size()));
  EXPECT_EQ(t[static_cast<std::size_t>(peak)], 50.001);
  EXPECT_EQ(std::count(v.begin(), v.end(), 2.0), 1);
}

TEST(KnobHistory, the_fallback_has_each_step_with_its_reason) {
  MissionRecord record = record_with_knobs();
  const auto note = [&record](double at_s, const std::string& what) {
    record.trace->record(MissionTime{from_seconds(at_s)}, "event", {{"what", what}});
  };
  note(0.5, "plan wanted: new goal");
  note(1.0, fallback_text(Fallback::hover, "6 deadlines: missed"));
  note(1.5, fallback_text(Fallback::none, ""));
  EXPECT_EQ(fallback_json(*record.trace),
            Json::parse(R"([[1.0, "hover", "6 deadlines: missed"], [1.5, "none", ""]])"));
}

TEST(KnobHistory, a_picture_has_knobs_and_fallback_where_there_are_some) {
  MissionRecord record = made_record("a", 1);
  EXPECT_FALSE(Json::parse(picture_of(record).json).contains("knobs"));
  EXPECT_FALSE(Json::parse(picture_of(record).json).contains("fallback"));
  record = record_with_knobs();
  record.trace->record(MissionTime{}, "event",
                       {{"what", fallback_text(Fallback::table, "no input")}});
  const Json picture = Json::parse(picture_of(record).json);
  EXPECT_EQ(picture["knobs"].size(), 2U);
  EXPECT_EQ(picture["fallback"].size(), 1U);
}

}  // namespace
}  // namespace flyball

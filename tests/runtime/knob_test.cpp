// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/knob.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

KnobSpec resolution() {
  KnobSpec knob;
  knob.name = "map.resolution_m";
  knob.unit = "m";
  knob.owner = "mapper";
  knob.legal = {0.15, 0.30, 0.60};
  knob.fallback = 0.15;
  return knob;
}

KnobSpec range() {
  KnobSpec knob;
  knob.name = "map.range_m";
  knob.unit = "m";
  knob.min = 2.0;
  knob.max = 20.0;
  knob.fallback = 7.0;
  return knob;
}

TEST(KnobSpec, the_nearest_legal_value_is_the_smaller_of_two_equally_near) {
  KnobSpec knob = resolution();
  knob.legal = {1.0, 2.0, 4.0};
  EXPECT_EQ(knob.nearest(-9.0), 1.0);
  EXPECT_EQ(knob.nearest(1.5), 1.0);
  EXPECT_EQ(knob.nearest(1.6), 2.0);
  EXPECT_EQ(knob.nearest(3.0), 2.0);
  EXPECT_EQ(knob.nearest(1e300), 4.0);
}

TEST(KnobSpec, a_range_is_clamped) {
  EXPECT_EQ(range().nearest(1.0), 2.0);
  EXPECT_EQ(range().nearest(3.25), 3.25);
  EXPECT_EQ(range().nearest(21.0), 20.0);
}

TEST(KnobSpec, knows_what_is_legal) {
  EXPECT_TRUE(resolution().is_legal(0.3));
  EXPECT_FALSE(resolution().is_legal(0.2));
  EXPECT_TRUE(range().is_legal(2.0));
  EXPECT_TRUE(range().is_legal(20.0));
  for (const KnobSpec& knob : {resolution(), range()}) {
    EXPECT_FALSE(knob.is_legal(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(knob.is_legal(std::numeric_limits<double>::infinity()));
  }
}

/// What is wrong with the declaration; empty: nothing.
template <class Change>
std::string fault(KnobSpec spec, Change&& change) {
  spec.unit = spec.owner = spec.description = "m";
  if (!spec.legal.empty()) {
    spec.min = spec.legal.front();
    spec.max = spec.legal.back();
  }
  change(spec);
  const Status status = check_declaration(spec);
  return status ? "" : status.error().message;
}

TEST(KnobSpec, a_sound_declaration_passes) {
  EXPECT_EQ(fault(resolution(), [](KnobSpec&) {}), "");
  EXPECT_EQ(fault(range(), [](KnobSpec&) {}), "");
  EXPECT_EQ(fault(resolution(), [](KnobSpec& k) { k.labels = {"a", "b", "c"}; }), "");
}

TEST(KnobSpec, a_declaration_that_is_wrong_is_refused_with_the_reason) {
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  for (const char* name : {"", "range", ".range", "map."}) {
    says(fault(range(), [name](KnobSpec& k) { k.name = name; }), "a name of two parts");
  }
  says(fault(range(), [](KnobSpec& k) { k.description = ""; }), "a description");
  says(fault(range(), [](KnobSpec& k) { k.min = 30.0; }), "finite limits");
  says(fault(range(), [](KnobSpec& k) { k.max = std::nan(""); }), "finite limits");
  says(fault(resolution(), [](KnobSpec& k) { k.legal = {0.3, 0.15, 0.6}; }), "ascending");
  says(fault(resolution(), [](KnobSpec& k) { k.legal.push_back(9.0); }), "within them");
  says(fault(range(), [](KnobSpec& k) { k.fallback = 1.0; }), "cannot be 1 m at first");
  says(fault(resolution(), [](KnobSpec& k) { k.labels = {"a"}; }), "1 labels for 3 legal values");
}

TEST(KnobSettings, name_what_a_value_stands_for) {
  KnobSpec kind = resolution();
  kind.labels = {"fine", "medium", "coarse"};
  KnobSettings knobs{{kind}};
  const Status set = knobs.set(kind.name, 7.0);
  ASSERT_FALSE(set.ok());
  EXPECT_NE(set.error().message.find("0.15 (fine), 0.3 (medium)"), std::string::npos)
      << set.error().message;
}

TEST(KnobSettings, start_at_their_defaults_and_keep_what_is_set) {
  KnobSettings knobs{{resolution(), range()}};
  EXPECT_EQ(knobs.value("map.resolution_m"), 0.15);
  EXPECT_TRUE(knobs.set("map.resolution_m", 0.6).ok());
  EXPECT_EQ(knobs.value("map.resolution_m"), 0.6);
  EXPECT_EQ(knobs.value("map.range_m"), 7.0);
  EXPECT_EQ(knobs.spec("map.range_m")->max, 20.0);
  EXPECT_EQ(knobs.spec("map.colour"), nullptr);
}

TEST(KnobSettings, a_copy_answers_for_its_own_specs) {
  KnobSettings copy;
  {
    const KnobSettings knobs{{resolution(), range()}};
    copy = knobs;
  }
  EXPECT_TRUE(copy.set("map.range_m", 3.0).ok());
  EXPECT_EQ(copy.value("map.range_m"), 3.0);
}

TEST(KnobSettings, a_refused_value_changes_nothing_and_names_the_way_out) {
  KnobSettings knobs{{resolution(), range()}};
  const Status illegal = knobs.set("map.resolution_m", 0.2);
  ASSERT_FALSE(illegal.ok());
  EXPECT_EQ(illegal.error().code, ErrorCode::invalid_input);
  EXPECT_EQ(illegal.error().message,
            "knob map.resolution_m cannot be 0.2 m; legal: 0.15, 0.3, 0.6");
  EXPECT_EQ(knobs.value("map.resolution_m"), 0.15);
  EXPECT_EQ(knobs.set("map.range_m", 99.0).error().message,
            "knob map.range_m cannot be 99 m; legal: 2 to 20");
  const Status unknown = knobs.set("map.colour", 1.0);
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::not_found);
  EXPECT_EQ(unknown.error().message, "no knob \"map.colour\"; try: flyball list knobs");
}

TEST(KnobSettingsDeathTest, impossible_specs_are_found_at_once) {
  KnobSpec off = range();
  off.fallback = 1.0;
  EXPECT_DEATH(KnobSettings({off}), "default 1 is not legal");
  EXPECT_DEATH(KnobSettings({range(), range()}), "two knobs \"map.range_m\"");
  EXPECT_DEATH((void)KnobSettings{}.value("x"), "no knob \"x\"");
}

}  // namespace
}  // namespace flyball

// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/observation_fields.h"

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(ObservationFields, carry_an_observation_over_bit_for_bit) {
  Observation seen;
  seen.phase = MissionPhase::land;
  seen.speed_m_s = 0.1 + 0.2;
  seen.known_free_m = -0.0;
  seen.distance_to_goal_m = std::numeric_limits<double>::infinity();
  seen.map_revision = (1ULL << 53U) - 1;
  seen.latency = Duration{123456789};
  seen.latency_bound = Duration{86399999999999};
  seen.map_age = Duration{987654321};
  seen.deadline_misses = std::numeric_limits<std::uint32_t>::max();
  seen.cores = -1;
  seen.frequency = Hertz{2.0352e9};
  seen.rotor_power = Watts{251.7};
  seen.progress_unit = ProgressUnit::second;
  seen.progress = 17.25;
  seen.cpu_power = Watts{1.0};
  seen.gpu_power = Watts{2.0};
  seen.memory_power = Watts{3.0};
  seen.soc_power = Watts{4.0};
  for (std::size_t i = 0; i < stage_count; ++i) {
    const double x = 1.0 + static_cast<double>(i);
    seen.stages[i] = {Duration{7 + static_cast<std::int64_t>(i)}, x, 0.5 * x};
  }
  Observation copy;
  for (const ObservationField& field : observation_fields()) {
    field.set(copy, field.get(seen));
  }
  for (const ObservationField& field : observation_fields()) {
    EXPECT_EQ(field.get(seen), field.get(copy)) << field.name;
  }
  EXPECT_TRUE(std::signbit(copy.known_free_m));
  EXPECT_EQ(seen.latency, copy.latency);
  EXPECT_EQ(seen.latency_bound, copy.latency_bound);
  EXPECT_EQ(seen.map_age, copy.map_age);
  EXPECT_EQ(seen.progress_unit, copy.progress_unit);
  EXPECT_EQ(seen.progress, copy.progress);
  EXPECT_EQ(seen.soc_power.value(), copy.soc_power.value());
  for (std::size_t i = 0; i < stage_count; ++i) {
    EXPECT_EQ(seen.stages[i].latency, copy.stages[i].latency) << i;
    EXPECT_EQ(seen.stages[i].load, copy.stages[i].load) << i;
    EXPECT_EQ(seen.stages[i].gigacycles, copy.stages[i].gigacycles) << i;
  }
  EXPECT_EQ(seen.map_revision, copy.map_revision);
  EXPECT_EQ(seen.deadline_misses, copy.deadline_misses);
}

TEST(ObservationFields, bring_back_every_nanosecond) {
  Observation seen;
  Observation copy;
  for (std::int64_t ns = 1; ns < 1'000'000'000'000; ns = ns * 3 + 7) {
    seen.latency = Duration{ns};
    for (const ObservationField& field : observation_fields()) {
      field.set(copy, field.get(seen));
    }
    EXPECT_EQ(ns, copy.latency.count());
  }
}

TEST(ObservationFields, have_names_of_their_own) {
  std::set<std::string> names;
  for (const ObservationField& field : observation_fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
  }
}

TEST(ObservationFields, take_nonsense_of_a_damaged_record_without_harm) {
  for (const double value : {std::nan(""), 1e300, -1e300, -1.0, 200.0}) {
    Observation seen;
    for (const ObservationField& field : observation_fields()) {
      field.set(seen, value);
    }
    EXPECT_LE(static_cast<int>(seen.phase), 3) << value;
    EXPECT_LE(static_cast<int>(seen.progress_unit), 4);
  }
}

TEST(ObservationFields, say_what_they_are_and_in_which_unit) {
  for (const ObservationField& field : observation_fields()) {
    ASSERT_NE(nullptr, field.unit) << field.name;
    ASSERT_NE(nullptr, field.description) << field.name;
    EXPECT_STRNE("", field.unit) << field.name;
    EXPECT_STRNE("", field.description) << field.name;
  }
}

}  // namespace
}  // namespace flyball

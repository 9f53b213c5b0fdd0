// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/thermal.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

ThermalModel sink() {
  return {40.0, 8.0, 540.0, {{80.0, 2.0, Hertz{1.4e9}}, {83.0, 2.0, Hertz{0.9e9}}}};
}

TEST(ThermalState, begins_at_rest_under_the_power_before) {
  EXPECT_DOUBLE_EQ(ThermalState(sink(), Watts{2.0}).temperature_c(), 56.0);
}

TEST(ThermalState, follows_the_closed_form_in_steps_of_any_length) {
  ThermalState fine{sink(), Watts{0.0}};
  ThermalState coarse{sink(), Watts{0.0}};
  for (int i = 0; i < 1000; ++i) {
    fine.step(Watts{5.0}, 0.54);
  }
  coarse.step(Watts{5.0}, 540.0);
  const double expected_c = 40.0 + 40.0 * (1.0 - std::exp(-1.0));
  EXPECT_NEAR(fine.temperature_c(), expected_c, 1e-9);
  EXPECT_NEAR(coarse.temperature_c(), expected_c, 1e-9);
}

TEST(ThermalState, rests_where_resistance_times_power_says) {
  ThermalState state{sink(), Watts{0.0}};
  state.step(Watts{4.0}, 1e6);
  EXPECT_NEAR(state.temperature_c(), 72.0, 1e-9);
}

TEST(ThermalState, less_wind_keeps_the_heat_capacity) {
  ThermalState state{sink(), Watts{0.0}};
  state.set_cooling(40.0, 16.0);
  EXPECT_DOUBLE_EQ(state.model().time_constant_s, 1080.0);
  EXPECT_DOUBLE_EQ(state.temperature_c(), 40.0) << "it does not jump";
}

TEST(ThermalState, a_trip_caps_the_clock_until_it_is_cooler_by_the_hysteresis) {
  ThermalState state{sink(), Watts{0.0}};
  EXPECT_FALSE(state.cap());
  state.set_temperature(79.9);
  EXPECT_FALSE(state.cap());
  state.set_temperature(80.0);
  ASSERT_TRUE(state.cap());
  EXPECT_EQ(state.cap()->value(), 1.4e9);
  state.set_temperature(78.1);
  EXPECT_TRUE(state.cap()) << "within the hysteresis";
  state.set_temperature(77.9);
  EXPECT_FALSE(state.cap());
}

TEST(ThermalState, says_where_clocks_are_lost_first_whether_or_not_they_are) {
  ThermalState state{sink(), Watts{0.0}};
  EXPECT_EQ(state.first_trip_c(), 80.0);
  state.set_temperature(81.0);
  EXPECT_EQ(state.first_trip_c(), 80.0);
  ThermalModel endless = sink();
  endless.trips.clear();
  EXPECT_FALSE(ThermalState(endless, Watts{0.0}).first_trip_c());
}

TEST(ThermalState, the_lowest_cap_of_the_active_trips_counts) {
  ThermalState state{sink(), Watts{0.0}};
  state.set_temperature(84.0);
  EXPECT_EQ(state.cap()->value(), 0.9e9);
  state.set_temperature(80.5);
  EXPECT_EQ(state.cap()->value(), 1.4e9) << "the second trip is left, the first is not";
}

TEST(ThermalState, remembers_its_hottest_moment) {
  ThermalState state{sink(), Watts{2.0}};
  state.step(Watts{6.0}, 300.0);
  const double top_c = state.temperature_c();
  state.step(Watts{0.0}, 300.0);
  EXPECT_LT(state.temperature_c(), top_c);
  EXPECT_DOUBLE_EQ(state.hottest_c(), top_c);
}

}  // namespace
}  // namespace flyball

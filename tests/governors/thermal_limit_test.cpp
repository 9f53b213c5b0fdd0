// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/thermal_limit.h"

#include "flyball/governors/policy_conformance.h"
#include "flyball/runtime/thermal.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double trip_c = 80.0;
constexpr double guard_k = 0.5;  // As the instrument has it.
const std::vector<double> clocks_hz{0.3456e9, 0.8064e9, 1.2672e9, 1.4208e9,
                                    1.5744e9, 1.728e9,  1.8816e9, 2.0352e9};

PowerCost computer() {
  return *conformance_board().power;
}

ThermalModel sink() {
  return {40.0, 8.0, 540.0, {{trip_c, 2.0, Hertz{1.4208e9}}}};
}

/// A computer with the power that the instrument believes in, and a thermometer with steps.
struct Bench {
  explicit Bench(double start_c, double step_k = 0.0) : sensor_step_k{step_k} {
    state.set_temperature(start_c);
  }

  Observation seen() const {
    Observation one;
    one.now = now;
    one.frequency = Hertz{clock_hz};
    one.busy_cores = busy_cores;
    one.trip_c = trip_c;
    const double t_c = state.temperature_c();
    one.temperature_c = sensor_step_k > 0.0 ? sensor_step_k * std::floor(t_c / sensor_step_k) : t_c;
    return one;
  }
  [[nodiscard]] Watts power() const { return computer().power(Hertz{clock_hz}, busy_cores); }
  void draw(double seconds, ThermalLimit& limit, bool obeys) {
    constexpr double dt_s = 0.25;
    for (double t_s = 0.0; t_s < seconds; t_s += dt_s) {
      limit.learn(seen());
      clock_hz = obeys ? limit.most_clock_hz(clocks_hz) : clock_hz;
      state.step(power(), dt_s);
      now += from_seconds(dt_s);
    }
  }

  ThermalState state{sink(), Watts{0.0}};
  MissionTime now{};
  double clock_hz{2.0352e9};
  double busy_cores{2.9};  // 6.5 W: 92 C in the long run.
  double sensor_step_k{};
};

/// Some load of every kind, so that each of the three numbers shows.
void teach(Bench& bench, ThermalLimit& limit) {
  for (int i = 0; i < 12; ++i) {
    bench.clock_hz = clocks_hz[static_cast<std::size_t>(5 * i) % clocks_hz.size()];
    bench.draw(60.0, limit, false);
  }
}

TEST(ThermalLimit, is_none_where_nobody_tells_a_trip) {
  ThermalLimit limit{computer()};
  Observation silent;
  silent.temperature_c = 120.0;
  silent.frequency = Hertz{2e9};
  limit.learn(silent);
  EXPECT_EQ(limit.most_clock_hz(clocks_hz), clocks_hz.back());
}

TEST(ThermalLimit, the_power_of_the_clock_ends_a_minute_later_at_the_limit) {
  Bench bench{70.0};
  ThermalLimit limit{computer()};
  teach(bench, limit);
  bench.busy_cores = 3.5;
  bench.draw(120.0, limit, false);  // The load is a mean of the last while.
  bench.state.set_temperature(78.0);
  limit.learn(bench.seen());
  std::vector<double> fine_hz;
  for (double hz = 0.3e9; hz < 2.0352e9; hz += 1e6) {
    fine_hz.push_back(hz);
  }
  bench.clock_hz = limit.most_clock_hz(fine_hz);
  ASSERT_LT(bench.clock_hz, fine_hz.back());
  const double rest_c = 40.0 + 8.0 * bench.power().value();  // T_air + R P.
  EXPECT_NEAR(rest_c + (78.0 - rest_c) * std::exp(-60.0 / 540.0), trip_c - guard_k, 0.1);
}

TEST(ThermalLimit, who_obeys_never_trips_and_ends_close_to_the_limit) {
  for (const double start_c : {40.0, 70.0, 79.0, 79.7, 79.9}) {
    Bench bench{start_c};
    ThermalLimit limit{computer()};
    bench.draw(3600.0, limit, true);
    EXPECT_LT(bench.state.hottest_c(), trip_c) << start_c;
    EXPECT_GT(bench.state.temperature_c(), trip_c - guard_k - 0.5) << start_c;
    EXPECT_GT(bench.clock_hz, 1.4208e9) << "the trip itself would leave less";
  }
}

TEST(ThermalLimit, nor_with_a_thermometer_of_half_degrees) {
  for (const double start_c : {40.0, 70.0, 79.0}) {
    Bench bench{start_c, 0.5};
    ThermalLimit limit{computer()};
    bench.draw(3600.0, limit, true);
    EXPECT_LT(bench.state.hottest_c(), trip_c) << start_c;
    EXPECT_GT(bench.state.temperature_c(), trip_c - guard_k - 1.5) << start_c;
  }
}

TEST(ThermalLimit, before_it_has_learned_it_is_careful_close_to_the_trip_only) {
  const auto first_hz = [](double start_c) {
    Bench bench{start_c};
    ThermalLimit limit{computer()};
    limit.learn(bench.seen());
    return limit.most_clock_hz(clocks_hz);
  };
  EXPECT_EQ(first_hz(60.0), clocks_hz.back());
  EXPECT_LT(first_hz(79.9), 1.8816e9);
}

TEST(ThermalLimit, a_clock_that_was_lowered_stays_so_for_a_while) {
  Bench bench{79.0};
  ThermalLimit limit{computer()};
  int changes = 0;
  double last_hz = bench.clock_hz;
  for (int i = 0; i < 600; ++i) {
    bench.busy_cores = i % 2 == 0 ? 2.6 : 3.2;  // A detector comes and goes.
    bench.draw(1.0, limit, true);
    changes += bench.clock_hz != last_hz ? 1 : 0;
    last_hz = bench.clock_hz;
  }
  EXPECT_LE(changes, 600 / 20) << "every 20 s at most";
  EXPECT_LT(bench.state.hottest_c(), trip_c);
}

TEST(ThermalLimit, a_cold_computer_may_have_its_top_clock) {
  Bench bench{40.0};
  ThermalLimit limit{computer()};
  bench.draw(60.0, limit, true);
  EXPECT_EQ(bench.clock_hz, clocks_hz.back());
}

TEST(ThermalLimit, learns_that_the_sink_got_worse) {
  Bench bench{70.0};
  ThermalLimit limit{computer()};
  bench.draw(600.0, limit, true);
  bench.state.set_cooling(45.0, 8.0);
  bench.draw(3600.0, limit, true);
  EXPECT_LT(bench.state.temperature_c(), trip_c);
  EXPECT_LT(bench.clock_hz, 1.8816e9) << "4.3 W for ever instead of 4.9";
}

TEST(ThermalLimit, nonsense_is_as_if_nobody_told) {
  for (const double x : {std::nan(""), 1e300, -1.0}) {
    ThermalLimit limit{computer()};
    Observation seen = Bench{90.0}.seen();  // Else it would be told to go slower.
    seen.trip_c = x;
    limit.learn(seen);
    EXPECT_EQ(limit.most_clock_hz(clocks_hz), clocks_hz.back()) << x;
    seen = Bench{90.0}.seen();
    seen.temperature_c = x == -1.0 ? -1e300 : x;
    limit.learn(seen);
    EXPECT_EQ(limit.most_clock_hz(clocks_hz), clocks_hz.back()) << x;
  }
}

}  // namespace
}  // namespace flyball

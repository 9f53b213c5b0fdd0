// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/latency_bound.h"
#include "flyball/governors/latency_model.h"
#include "flyball/governors/latency_worth.h"
#include "flyball/governors/policy_conformance.h"
#include "flyball/governors/power_model.h"
#include "flyball/governors/thermal_limit.h"

#include "counting_new.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Instruments, allocate_nothing_after_construction) {
  LatencyModels models;
  models.add({});
  LatencyBound bound{3, {}};
  RotorPower rotors;
  ThermalLimit heat{*conformance_board().power};
  Observation warm;
  warm.trip_c = 80.0;
  warm.frequency = Hertz{2e9};
  const std::vector<double> clocks_hz{1e9, 2e9};
  double sum = 0.0;
  const std::size_t before = allocation_count();
  for (int i = 0; i < 100; ++i) {
    const MissionTime now{std::chrono::milliseconds{100 * i}};
    const LatencyFeatures at{100.0 + i, Hertz{1e9}};
    const Duration predicted = from_seconds(models.predict_s(0, at));
    bound.issue(static_cast<std::size_t>(i % 3), now, predicted);
    if (i % 2 == 0) {
      bound.settle(now + predicted);
    }
    models.learn(0, at, 2 * predicted);
    rotors.learn(0.1 * i, Watts{300.0});
    warm.now = now;
    warm.temperature_c = 60.0 + 0.2 * i;
    heat.learn(warm);
    sum += 1e-9 * heat.most_clock_hz(clocks_hz);
    sum += watts_per_second(6.0, to_seconds(predicted), 3.0, rotors.power(3.0).value(), 0.0);
  }
  const std::size_t after = allocation_count();
  EXPECT_EQ(after, before);
  EXPECT_GT(sum, 0.0);
}

}  // namespace
}  // namespace flyball

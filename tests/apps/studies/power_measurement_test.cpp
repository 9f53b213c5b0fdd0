// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/power_measurement.h"

#include "flyball/runtime/realtime/cpus.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

PowerMeasurement quick() {
  PowerMeasurement how;
  how.cpus = {usable_cpus().front()};
  how.settling = 1ms;
  how.period = 1ms;
  how.readings = 4;
  return how;
}

TEST(PowerMeasurement, reads_the_mean_at_each_clock_idle_and_busy) {
  PowerMeasurement how = quick();
  how.clocks = {Hertz{1e9}, Hertz{2e9}};
  double clock_hz = 0.0;
  double reading = 0.0;
  how.set = [&](Hertz clock) {
    clock_hz = clock.value();
    return Status{Done{}};
  };
  how.meter = [&] { return Watts{1e-9 * clock_hz + 0.001 * reading++}; };
  const auto samples = measure_power(how);
  ASSERT_TRUE(samples);
  ASSERT_EQ(samples->size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const MeasuredPower& one = (*samples)[i];
    EXPECT_EQ(one.clock.value(), i < 2 ? 1e9 : 2e9);
    EXPECT_EQ(one.busy_cores, static_cast<double>(i % 2));
    const double first = 4.0 * static_cast<double>(i);
    EXPECT_NEAR(one.power.value(), (i < 2 ? 1.0 : 2.0) + 0.001 * (first + 1.5), 1e-12);
  }
}

TEST(PowerMeasurement, says_which_core_it_cannot_use) {
  PowerMeasurement how = quick();
  how.clocks = {Hertz{1e9}};
  how.meter = [] { return Watts{1.0}; };
  how.cpus = {1000000};
  const auto refused = measure_power(how);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("1000000"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace flyball
